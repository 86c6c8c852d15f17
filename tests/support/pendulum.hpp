// SPDX-License-Identifier: MIT
// A pendulum whose speed nobody measures, with records of its angle.
#ifndef SIVID_TESTS_SUPPORT_PENDULUM_HPP
#define SIVID_TESTS_SUPPORT_PENDULUM_HPP

#include "support/random.hpp"

#include <sivid/model/model.hpp>
#include <sivid/model/problem.hpp>

#include <cmath>
#include <utility>
#include <vector>

namespace support {

/// A pendulum whose angle is measured, pushed about; its speed is not.
struct pendulum {
    static constexpr auto name = "pendulum";
    static constexpr auto states = sivid::states({{"angle", "rad", 10}, {"speed", "rad/s", 30}});
    static constexpr auto inputs = sivid::no_inputs;
    static constexpr auto channels = sivid::channels({{"angle", "rad"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants(
            {{"k", "1/s^2", 9_dec}, {"d", "1/s", 0.3_dec}, {"F", "1/s^2", 4_dec}});
    }();
    template <class T>
    sivid::vec<T, 2> rate(T const& t, sivid::vec<T, 2> const& x, sivid::vec<T, 3> const& c,
                          sivid::vec<T, 0> const&) const {
        using std::sin;
        return {x[1], -(c[0] * sin(x[0])) - c[1] * x[1] + c[2] * sin(T(2.5) * t)};
    }
    template <class T>
    sivid::vec<T, 1> observe(T const&, sivid::vec<T, 2> const& x, sivid::vec<T, 3> const&,
                             sivid::vec<T, 0> const&) const {
        return {x[0]};
    }
};

inline constexpr double pendulum_truth[] = {9, 0.3, 4};

/// @param seconds  of record, 50 samples each
/// @param spread   of the prior about the truth
/// @param start    of the starts about theirs
inline sivid::identification_problem swinging(double seconds, double spread, unsigned seed,
                                              double start = 0) {
    draws d(seed);
    sivid::experiment e;
    e.name = "swing";
    e.initial = {sivid::interval(0.5 - start, 0.5 + start), sivid::interval(-start, start)};
    double x = 0.5, v = 0;
    constexpr int steps = 20;
    double const h = 0.02 / steps, bound = 0.005;
    auto const rate = [](double t, double angle, double speed) {
        return -pendulum_truth[0] * std::sin(angle) - pendulum_truth[1] * speed +
               pendulum_truth[2] * std::sin(2.5 * t);
    };
    for (int k = 0; k < static_cast<int>(50 * seconds); ++k) {
        for (int s = 0; s < steps; ++s) { // Runge and Kutta
            double const t = 0.02 * k + h * s;
            double const a1 = rate(t, x, v), x2 = x + h / 2 * v, v2 = v + h / 2 * a1;
            double const a2 = rate(t + h / 2, x2, v2), x3 = x + h / 2 * v2, v3 = v + h / 2 * a2;
            double const a3 = rate(t + h / 2, x3, v3), x4 = x + h * v3, v4 = v + h * a3;
            double const a4 = rate(t + h, x4, v4);
            x += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
            v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
        }
        double const y = x + d.uniform(-0.99, 0.99) * bound;
        e.measurements.push_back({0.02 * (k + 1), 0, sivid::interval(y - bound, y + bound)});
    }
    std::vector<sivid::interval> prior;
    for (double const c : pendulum_truth)
        prior.push_back(sivid::interval(c * (1 - spread), c * (1 + spread)));
    return {
        sivid::record_model<pendulum>(), {{"k", "d", "F"}, {}}, sivid::box(std::move(prior)), {e}};
}

} // namespace support

#endif
