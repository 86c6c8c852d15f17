// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_INFLATION_OBSERVER_EFFORT_HPP
#define SIVID_PAVING_INFLATION_OBSERVER_EFFORT_HPP

#include <cstddef>
#include <functional>

namespace sivid {

/// What a refutation by observers may spend; what is proved until then counts.
struct observer_effort {
    std::size_t boxes = 3000; ///< of parameters: unlike the time, the same on every machine
    double seconds = 10;
    std::function<bool()> go_on{}; ///< false ends the search; may be empty
    bool only_verdict = false;     ///< stop as soon as something above 1 is proved
};

} // namespace sivid

#endif
