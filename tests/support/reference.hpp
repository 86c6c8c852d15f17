// SPDX-License-Identifier: MIT
// Reference trajectories: Fehlberg 7(8) of Boost.Odeint in extended precision, error per step
// 1e-17. The tests that use it allow for a global error of `reference_error` relative to 1 + |x|,
// which `tube.test.cpp` checks against closed forms.
#ifndef SIVID_TESTS_SUPPORT_REFERENCE_HPP
#define SIVID_TESTS_SUPPORT_REFERENCE_HPP

#include "support/rates.hpp"

#include <sivid/measurement/signal.hpp>
#include <sivid/number/interval.hpp>

#include <cmath>
#include <vector>

namespace support {

using extended = long double;
using extended_state = std::vector<extended>;

inline constexpr double reference_error = 1e-14;
/// The same across kinks by `dormand_prince` to 1e-14 a step: its steps end beside a kink, not at
/// it, and the error of the crossing stays.
inline constexpr double kinked_reference_error = 1e-10;

/// x within the interval, allowing for the error of the reference.
inline bool encloses_reference(sivid::interval const& e, extended x,
                               double error = reference_error) {
    extended const room = static_cast<extended>(error) * (1 + std::fabs(x));
    return static_cast<extended>(e.lower()) <= x + room &&
           x - room <= static_cast<extended>(e.upper());
}

/// A sampled input by its definition; `start` is a time of the piece, not its right end.
extended sampled(sivid::sampled_signal const& s, extended t, double start);

using extended_rate = rate_on<extended>;

/// The method for smooth right-hand sides. Its error estimate sees the ends of a step only: it
/// passes over kinks.
struct fehlberg78;
/// The method for kinks: its error estimate sees all stages.
struct dormand_prince;

/// States at the `times` (increasing, none before `from`).
/// @param longest  step, for kinks in x that the error estimate must not pass over
template <class Method = fehlberg78>
std::vector<extended_state> reference_states(extended_rate const& rate, extended_state x,
                                             extended_state const& p, double from,
                                             std::vector<double> const& times,
                                             std::vector<sivid::sampled_signal> const& inputs = {},
                                             extended tolerance = 1e-17L, double longest = 1e300);

inline extended_state extend(std::vector<double> const& x) { return {x.begin(), x.end()}; }

} // namespace support

#endif
