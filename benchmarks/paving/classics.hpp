// SPDX-License-Identifier: MIT
// Estimation problems of the literature on bounded errors, posed as they were published.
#ifndef SIVID_BENCHMARKS_PAVING_CLASSICS_HPP
#define SIVID_BENCHMARKS_PAVING_CLASSICS_HPP

#include <sivid/model/model.hpp>
#include <sivid/model/problem.hpp>

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace paving_benchmark {

/// Two compartments that exchange, the first of which also excretes; the second is measured:
///     x1' = -(p1 + p3) x1 + p2 x2    x2' = p1 x1 - p2 x2    y = x2
/// Since x2'' + (p1 + p2 + p3) x2' + p2 p3 x2 = 0, p2 and p3 may be exchanged.
/// @ref  Kieffer and Walter, Int. J. Adapt. Control Signal Process. 25 (2011)
struct two_compartments {
    static constexpr auto name = "two compartments";
    static constexpr auto states = sivid::states({{"x1", "1", 10}, {"x2", "1", 10}});
    static constexpr auto inputs = sivid::no_inputs;
    static constexpr auto channels = sivid::channels({{"y", "1"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants(
            {{"p1", "1/s", 0.6_dec}, {"p2", "1/s", 0.15_dec}, {"p3", "1/s", 0.35_dec}});
    }();
    template <class T>
    sivid::states_of<two_compartments, T>
    rate(T const& /*t*/, sivid::states_of<two_compartments, T> const& x,
         sivid::constants_of<two_compartments, T> const& c,
         sivid::inputs_of<two_compartments, T> const& /*u*/) const {
        auto const& [p1, p2, p3] = c;
        return {p2 * x[1] - (p1 + p3) * x[0], p1 * x[0] - p2 * x[1]};
    }
    template <class T>
    sivid::channels_of<two_compartments, T>
    observe(T const& /*t*/, sivid::states_of<two_compartments, T> const& x,
            sivid::constants_of<two_compartments, T> const& /*c*/,
            sivid::inputs_of<two_compartments, T> const& /*u*/) const {
        return {x[1]};
    }
};

/// A sum of two exponentials, y = p1 exp(-p2 t) + p3 exp(-p4 t), as a differential equation.
/// @ref  Milanese and Vicino, Automatica 27 (1991); Jaulin and Walter, Automatica 29 (1993)
struct two_exponentials {
    static constexpr auto name = "two exponentials";
    static constexpr auto states = sivid::states({{"x1", "1", 2}, {"x2", "1", 2}});
    static constexpr auto inputs = sivid::no_inputs;
    static constexpr auto channels = sivid::channels({{"y", "1"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"p1", "1", 20_dec},
                                 {"p2", "1/s", 0.4_dec},
                                 {"p3", "1", -8_dec},
                                 {"p4", "1/s", 0.1_dec}});
    }();
    template <class T>
    sivid::states_of<two_exponentials, T>
    rate(T const& /*t*/, sivid::states_of<two_exponentials, T> const& x,
         sivid::constants_of<two_exponentials, T> const& c,
         sivid::inputs_of<two_exponentials, T> const& /*u*/) const {
        return {-(c[1] * x[0]), -(c[3] * x[1])};
    }
    template <class T>
    sivid::channels_of<two_exponentials, T>
    observe(T const& /*t*/, sivid::states_of<two_exponentials, T> const& x,
            sivid::constants_of<two_exponentials, T> const& c,
            sivid::inputs_of<two_exponentials, T> const& /*u*/) const {
        return {c[0] * x[0] + c[2] * x[1]};
    }
};

/// Prey and predator, x1' = (1 - p1 x2) x1, x2' = (p2 x1 - 1) x2; the prey is counted.
/// @ref  the model of Jaulin, Automatica 38 (2002), and of Raissi, Ramdani and Candau,
///   Automatica 40 (2004)
struct lotka_volterra {
    static constexpr auto name = "Lotka-Volterra";
    static constexpr auto states = sivid::states({{"x1", "1", 1000}, {"x2", "1", 1000}});
    static constexpr auto inputs = sivid::no_inputs;
    static constexpr auto channels = sivid::channels({{"y", "1"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"p1", "1/s", 0.01_dec}, {"p2", "1/s", 0.02_dec}});
    }();
    template <class T>
    sivid::states_of<lotka_volterra, T>
    rate(T const& /*t*/, sivid::states_of<lotka_volterra, T> const& x,
         sivid::constants_of<lotka_volterra, T> const& c,
         sivid::inputs_of<lotka_volterra, T> const& /*u*/) const {
        return {(1 - c[0] * x[1]) * x[0], (c[1] * x[0] - 1) * x[1]};
    }
    template <class T>
    sivid::channels_of<lotka_volterra, T>
    observe(T const& /*t*/, sivid::states_of<lotka_volterra, T> const& x,
            sivid::constants_of<lotka_volterra, T> const& /*c*/,
            sivid::inputs_of<lotka_volterra, T> const& /*u*/) const {
        return {x[0]};
    }
};

/// A problem with the parameters that made its data.
struct classic {
    sivid::identification_problem problem;
    std::vector<double> truth;
};

/// [x - r, x + r], rounded outward.
inline sivid::interval around(double x, double r) {
    using traits = sivid::interval_traits<sivid::interval>;
    return traits::add(traits::point(x), traits::bounds(-r, r));
}

template <class Model>
classic posed(sivid::box prior, sivid::box initial, std::vector<double> truth) {
    classic c;
    c.problem.model = sivid::record_model<Model>();
    for (auto const& q : c.problem.model.about.constants)
        c.problem.choice.unknown.push_back(q.name);
    c.problem.prior = std::move(prior);
    c.problem.experiments.emplace_back();
    c.problem.experiments[0].name = c.problem.model.about.name;
    c.problem.experiments[0].initial = std::move(initial);
    c.truth = std::move(truth);
    return c;
}

/// The data are the solution of the truth, rounded to two decimals.
/// @param unknown_start  x2(0) in [0, 0.1] instead of 0
inline classic two_compartments_problem(bool unknown_start = false) {
    using sivid::interval;
    interval const rate(0.01, 1);
    auto c = posed<two_compartments>({rate, rate, rate},
                                     {interval(1), unknown_start ? interval(0, 0.1) : interval(0)},
                                     {0.6, 0.15, 0.35});
    double time = 0;
    for (double const y : {0.36, 0.47, 0.49, 0.48, 0.46, 0.44, 0.42, 0.40, 0.38, 0.36, 0.35, 0.33,
                           0.31, 0.30, 0.28}) {
        c.problem.experiments[0].measurements.push_back({++time, 0, around(y, 0.005)});
    }
    return c;
}

/// The data are those of the truth, rounded to three digits; the errors are within 0.1 + 5 %.
inline classic two_exponentials_problem() {
    using sivid::interval;
    auto c = posed<two_exponentials>(
        {interval(2, 60), interval(0, 1), interval(-30, -1), interval(0, 0.5)},
        {interval(1), interval(1)}, {20, 0.4, -8, 0.1});
    struct sample {
        double time, value;
    };
    for (auto const& [t, y] : {sample{0.75, 7.39},
                               {1.5, 4.09},
                               {2.25, 1.74},
                               {3, 0.097},
                               {6, -2.57},
                               {9, -2.71},
                               {13, -2.07},
                               {17, -1.44},
                               {21, -0.98},
                               {25, -0.66}}) {
        double const error = 0.1 + 0.05 * std::fabs(y);
        c.problem.experiments[0].measurements.push_back({t, 0, around(y, error)});
    }
    return c;
}

/// From (50, 50) over a little more than one period; counts every 0.2 s with errors that are
/// uniform within +/- 1, drawn from `seed`. The prior has corners where the populations explode.
inline classic lotka_volterra_problem(unsigned seed = 1) {
    using sivid::interval;
    auto c = posed<lotka_volterra>({interval(0, 0.1), interval(0, 0.1)},
                                   {interval(50), interval(50)}, {0.01, 0.02});
    // Runge-Kutta with 1000 steps between samples: errors far below those of the counts.
    constexpr double h = 0.0002;
    double x = 50, y = 50;
    auto const go = [&](double& a, double& b, double step, double at_x, double at_y) {
        a = x + step * (1 - 0.01 * at_y) * at_x;
        b = y + step * (0.02 * at_x - 1) * at_y;
    };
    std::mt19937_64 random(seed);
    for (int k = 1; k <= 35; ++k) {
        for (int n = 0; n < 1000; ++n) {
            double ax, ay, bx, by, cx, cy, dx, dy;
            go(ax, ay, h / 2, x, y);
            go(bx, by, h / 2, ax, ay);
            go(cx, cy, h, bx, by);
            go(dx, dy, h, cx, cy);
            x = (-x + ax + 2 * bx + cx) / 3 + (dx - x) / 6;
            y = (-y + ay + 2 * by + cy) / 3 + (dy - y) / 6;
        }
        double const error = static_cast<double>(random() >> 11) * 0x1p-52 - 1;
        c.problem.experiments[0].measurements.push_back({0.2 * k, 0, around(x + 0.99 * error, 1)});
    }
    return c;
}

} // namespace paving_benchmark

#endif
