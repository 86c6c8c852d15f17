// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_RANKING_MEASUREMENT_GROUP_HPP
#define SIVID_DECISION_RANKING_MEASUREMENT_GROUP_HPP

#include <sivid/measurement/record.hpp>

#include <cstddef>
#include <limits>
#include <optional>

namespace sivid {

/// Measurements that could be left out together: those of a channel, of an experiment, or between
/// two times.
struct measurement_group {
    std::optional<std::size_t> experiment, channel; ///< nothing: all of them
    /// In the model's unit of time.
    double from = -std::numeric_limits<double>::infinity();
    double to = std::numeric_limits<double>::infinity(); ///< itself not unless infinite

    [[nodiscard]] bool holds(std::size_t e, measurement const& m) const {
        return (!experiment || *experiment == e) && (!channel || *channel == m.channel) &&
               m.time >= from && m.time < to;
    }
};

} // namespace sivid

#endif
