// SPDX-License-Identifier: MIT
#ifndef SIVID_TESTS_DIAGNOSIS_LAGGED_INPUT_HPP
#define SIVID_TESTS_DIAGNOSIS_LAGGED_INPUT_HPP

#include <sivid/measurement/signal.hpp>

#include <algorithm>
#include <cmath>

namespace diagnosis_support {

/// d at a time, where d' = (u - d)/tau from `begin` on, in plain numbers but without steps: piece
/// by piece in closed form.
inline double lagged(sivid::sampled_signal const& u, double begin, bool rests, double tau,
                     double time) {
    double d = rests ? 0 : u.approximate(begin);
    for (double t = begin; t < time;) {
        double const next = std::min(time, u.next_knot(t));
        auto const k = u.piece(t);
        double const here = u.approximate_on(k, t);
        double const slope = next > t ? (u.approximate_on(k, next) - here) / (next - t) : 0;
        double const gone = std::exp(-(next - t) / tau);
        d = here + slope * (next - t) - slope * tau + (d - here + slope * tau) * gone;
        t = next;
    }
    return d;
}

} // namespace diagnosis_support

#endif
