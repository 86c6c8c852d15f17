// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_OUTLIERS_FEWEST_OUTLIERS_HPP
#define SIVID_PAVING_OUTLIERS_FEWEST_OUTLIERS_HPP

#include <sivid/paving/verdict.hpp>

#include <cstddef>
#include <vector>

namespace sivid {

/// A whole number that is proved to lie between two.
struct proved_count {
    std::size_t least = 0;
    std::size_t most = 0;
    [[nodiscard]] bool exact() const { return least == most; }
};

/// How many measurements the best parameter violates.
struct fewest_outliers {
    proved_count total;              ///< all experiments together
    std::vector<proved_count> alone; ///< by experiment, each with the parameter best for it
    stop_reason reason = stop_reason::decided; ///< why `total` is not exact; decided where it is
};

} // namespace sivid

#endif
