// SPDX-License-Identifier: MIT
// Reference trajectories: Fehlberg 7(8) of Boost.Odeint in extended precision, error per step
// 1e-17. The tests that use it allow for a global error of `reference_error` relative to 1 + |x|,
// which `tube.test.cpp` checks against closed forms.
#ifndef SIVID_TESTS_SUPPORT_REFERENCE_HPP
#define SIVID_TESTS_SUPPORT_REFERENCE_HPP

#include <sivid/measurement/signal.hpp>
#include <sivid/number/interval.hpp>

#include <boost/numeric/odeint/integrate/integrate_adaptive.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
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
inline extended sampled(sivid::sampled_signal const& s, extended t, double start) {
    auto const& times = s.times();
    auto const& values = s.values();
    std::size_t k = 0;
    while (k + 1 < times.size() && times[k + 1] <= start) ++k;
    if (s.kind() == sivid::interpolation::hold || times.size() == 1) return values[k];
    k = std::min(k, times.size() - 2);
    extended const slope = (static_cast<extended>(values[k + 1]) - values[k]) /
                           (static_cast<extended>(times[k + 1]) - times[k]);
    return values[k] + slope * (t - times[k]);
}

/// The method for smooth right-hand sides. Its error estimate sees the ends of a step only: it
/// passes over kinks.
using fehlberg78 = boost::numeric::odeint::runge_kutta_fehlberg78<extended_state, extended,
                                                                  extended_state, extended>;
/// The method for kinks: its error estimate sees all stages.
using dormand_prince =
    boost::numeric::odeint::runge_kutta_dopri5<extended_state, extended, extended_state, extended>;

/// A trajectory that leaves this is lost: it blows up, or nobody asks where it goes. Its states
/// from then on are infinite.
inline constexpr extended lost = 1e9L;

/// States at the `times` (increasing, none before `from`).
/// @param rate     (t, x, p, u) -> vector
/// @param longest  step, for kinks in x that the error estimate must not pass over
template <class Method = fehlberg78, class Rate>
std::vector<extended_state> reference_states(Rate const& rate, extended_state x,
                                             extended_state const& p, double from,
                                             std::vector<double> const& times,
                                             std::vector<sivid::sampled_signal> const& inputs = {},
                                             extended tolerance = 1e-17L, double longest = 1e300) {
    namespace odeint = boost::numeric::odeint;
    double start = from;
    auto const rhs = [&](extended_state const& state, extended_state& dxdt, extended t) {
        extended_state u;
        for (auto const& s : inputs) u.push_back(sampled(s, t, start));
        dxdt = rate(t, state, p, u);
    };
    struct gone {};
    auto const watch = [](extended_state const& state, extended) {
        for (auto const value : state) {
            if (!(std::fabs(value) < lost)) throw gone();
        }
    };
    std::vector<extended_state> result;
    double t = from;
    try {
        for (double const target : times) {
            while (t < target) {
                double to = std::min(target, t + longest);
                for (auto const& s : inputs) to = std::min(to, s.next_knot(t));
                start = t;
                odeint::integrate_adaptive(odeint::make_controlled(tolerance, tolerance, Method{}),
                                           rhs, x, static_cast<extended>(t),
                                           static_cast<extended>(to),
                                           static_cast<extended>((to - t) / 16), watch);
                t = to;
            }
            result.push_back(x);
        }
    } catch (gone const&) {
        constexpr auto far = std::numeric_limits<extended>::infinity();
        result.resize(times.size(), extended_state(x.size(), far));
    }
    return result;
}

inline extended_state extend(std::vector<double> const& x) { return {x.begin(), x.end()}; }

} // namespace support

#endif
