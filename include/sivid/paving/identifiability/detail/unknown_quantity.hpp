// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_IDENTIFIABILITY_DETAIL_UNKNOWN_QUANTITY_HPP
#define SIVID_PAVING_IDENTIFIABILITY_DETAIL_UNKNOWN_QUANTITY_HPP

#include <sivid/number/interval_traits.hpp>

#include <cstddef>
#include <optional>
#include <string>

namespace sivid {

/// Something that the data are to determine: a parameter, or the start of a state in an experiment.
struct unknown_quantity {
    std::string name;                      ///< of the parameter, or "<state>(<experiment>)"
    std::size_t index = 0;                 ///< of the parameter or state
    std::optional<std::size_t> experiment; ///< of a start
    interval prior;

    /// Its prior does not touch 0, so that relative changes make sense.
    [[nodiscard]] bool relative() const { return !interval_traits<interval>::contains(prior, 0); }
};

} // namespace sivid

#endif
