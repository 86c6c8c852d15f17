// SPDX-License-Identifier: MIT
#include "support/reference.hpp"

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

namespace {
/// A trajectory that leaves this is lost: it blows up, or nobody asks where it goes. Its states
/// from then on are infinite.
constexpr extended lost = 1e9L;

} // namespace

struct fehlberg78 {
    using stepper = boost::numeric::odeint::runge_kutta_fehlberg78<extended_state, extended,
                                                                   extended_state, extended>;
};
struct dormand_prince {
    using stepper = boost::numeric::odeint::runge_kutta_dopri5<extended_state, extended,
                                                               extended_state, extended>;
};

extended sampled(sivid::sampled_signal const& s, extended t, double start) {
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

template <class Method>
std::vector<extended_state>
reference_states(extended_rate const& rate, extended_state x, extended_state const& p, double from,
                 std::vector<double> const& times, std::vector<sivid::sampled_signal> const& inputs,
                 extended tolerance, double longest) {
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
                odeint::integrate_adaptive(
                    odeint::make_controlled(tolerance, tolerance, typename Method::stepper{}), rhs,
                    x, static_cast<extended>(t), static_cast<extended>(to),
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

template std::vector<extended_state>
reference_states<fehlberg78>(extended_rate const&, extended_state, extended_state const&, double,
                             std::vector<double> const&, std::vector<sivid::sampled_signal> const&,
                             extended, double);
template std::vector<extended_state>
reference_states<dormand_prince>(extended_rate const&, extended_state, extended_state const&,
                                 double, std::vector<double> const&,
                                 std::vector<sivid::sampled_signal> const&, extended, double);

} // namespace support
