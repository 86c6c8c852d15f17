// SPDX-License-Identifier: MIT
// The classical Runge-Kutta method of fourth order. Steps end at every kink of the inputs (shifted
// by the delay, where the dead band begins and ends) and at every time somebody asks for, so that
// neither delays nor latencies need interpolation.
#ifndef WITHHELD_SIMULATE_HPP
#define WITHHELD_SIMULATE_HPP

#include "craft.hpp"

#include <vector>

namespace withheld {

/// The step for data that are written; the step for fits is the caller's.
inline constexpr double careful_step = 5e-4;

/// The states at increasing times, from t = 0.
std::vector<state> states_at(world const& w, channels const& initial,
                             std::vector<double> const& times, double max_step);

/// What the sensors show at increasing times.
std::vector<channels> readings(world const& w, channels const& initial,
                               std::vector<double> const& times, double max_step);

} // namespace withheld

#endif
