// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_PREDICTION_OPTIONS_HPP
#define SIVID_DECISION_PREDICTION_OPTIONS_HPP

#include <sivid/paving/run_options.hpp>

#include <cstddef>
#include <functional>

namespace sivid {

/// How hard motions are predicted and requirements tried.
struct prediction_options {
    double seconds = 10;
    std::size_t parts = 20'000; ///< at most so many
    std::size_t cells = 120;    ///< of the grid in time, at least; `verify` refines it
    /// Tubes may be wider than what is reached by this share.
    double excess = 0.02;
    run_options run{};
    std::function<bool()> keep_going{}; ///< false ends the work; what is proved stays proved
};

} // namespace sivid

#endif
