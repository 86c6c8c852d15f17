// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STATIC_DETAIL_STATIC_SAMPLES_HPP
#define SIVID_PAVING_STATIC_DETAIL_STATIC_SAMPLES_HPP

#include <sivid/paving/static_problem.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace sivid {

/// The measurements of a static problem in flat arrays, channel after channel, each in the order of
/// the record. Their numbers here are what lists of measurements mean.
struct static_samples {
    using index = std::uint32_t;

    std::vector<double> time, lower, upper;
    std::vector<index> end; ///< by channel: the number after its last measurement

    /// @given  a valid problem
    /// @throws std::invalid_argument for more than 2^32 - 2 measurements
    /// @cost  O(measurements), 24 bytes each
    explicit static_samples(static_problem const& problem)
        : end(problem.model.about.channels.size(), 0) {
        auto const& all = problem.measurements;
        if (all.size() >= std::numeric_limits<index>::max()) {
            throw std::invalid_argument("static problem: too many measurements");
        }
        for (auto const& m : all) ++end[m.channel];
        std::partial_sum(end.begin(), end.end(), end.begin());
        auto place = end; // of the next one, from the end of each channel
        time.resize(all.size());
        lower.resize(all.size());
        upper.resize(all.size());
        for (auto m = all.rbegin(); m != all.rend(); ++m) {
            auto const k = --place[m->channel];
            time[k] = m->time;
            lower[k] = m->bound.lower();
            upper[k] = m->bound.upper();
        }
    }

    [[nodiscard]] std::size_t size() const { return time.size(); }
    [[nodiscard]] std::size_t channel(index k) const {
        std::size_t c = 0;
        while (k >= end[c]) ++c;
        return c;
    }
    [[nodiscard]] std::vector<index> all() const {
        std::vector<index> result(size());
        std::iota(result.begin(), result.end(), index{0});
        return result;
    }
};

} // namespace sivid

#endif
