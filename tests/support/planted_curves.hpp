// SPDX-License-Identifier: MIT
// Small problems whose equations have a curve of a moving quantity, with the truth that made them.
#ifndef SIVID_TESTS_SUPPORT_PLANTED_CURVES_HPP
#define SIVID_TESTS_SUPPORT_PLANTED_CURVES_HPP

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/random.hpp"

#include <sivid/measurement/signal.hpp>
#include <sivid/model/problem.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace support {

using namespace sivid;

/// A swing under a force that is a curve of its speed, and a growth by Monod's law: by classic
/// Runge-Kutta in short steps.
struct planted_curve {
    identification_problem problem;
    std::vector<double> truth, start;
};
template <class X>
std::vector<X> swing(std::vector<X> const& x, std::vector<X> const& p, std::vector<X> const& u) {
    using std::atan, std::sin;
    return {x[1], u[0] - p[3] * x[0] - p[0] * sin(p[1] * atan(p[2] * x[1]))};
}
template <class X>
std::vector<X> growth(std::vector<X> const& x, std::vector<X> const& p, std::vector<X> const& u) {
    auto const grown = p[0] * x[1] / (p[1] + x[1]) * x[0];
    return {grown - p[3] * x[0], u[0] + 0.3 - p[2] * grown};
}

inline planted_curve plant_curve(draws& d, bool swings) {
    planted_curve result;
    result.problem.model =
        model_of({2, 4, 1}, [&](auto const&, auto const& x, auto const& p, auto const& u) {
            return swings ? swing(x, p, u) : growth(x, p, u);
        });
    result.problem.choice = {all_constants(4), {}};
    std::vector<interval> prior;
    for (double const middle : swings ? std::vector<double>{1.0, 1.4, 2.0, 3.0}
                                      : std::vector<double>{0.8, 0.5, 1.3, 0.2}) {
        prior.push_back(interval(middle * d.uniform(0.75, 0.95), middle * d.uniform(1.05, 1.25)));
        result.truth.push_back(d.below(4) == 0
                                   ? prior.back().lower()
                                   : d.uniform(prior.back().lower(), prior.back().upper()));
    }
    result.problem.prior = box(std::move(prior));
    int const runs = 1 + static_cast<int>(d.below(2));
    for (int s = 0; s < runs; ++s) {
        experiment e;
        e.name = numbered('e', static_cast<std::size_t>(s));
        e.begin = d.coin() ? 0.0 : d.uniform(-3, 3);
        result.start = swings ? std::vector<double>{d.uniform(-0.5, 0.5), d.uniform(-0.5, 0.5)}
                              : std::vector<double>{d.uniform(0.2, 1), d.uniform(0.5, 2)};
        bool const known = d.coin();
        double const off = known ? 0.0 : 0.05;
        e.initial = {interval(result.start[0] - off, result.start[0] + off),
                     interval(result.start[1] - off, result.start[1] + off)};
        std::vector<double> times, values;
        constexpr int knots = 12;
        for (int k = 0; k < knots; ++k) {
            times.push_back(e.begin + 0.25 * k);
            values.push_back(swings ? d.uniform(-2, 2) : d.uniform(0, 0.5));
        }
        e.inputs.emplace_back(sampled_signal(times, values, interpolation::hold));
        auto x = result.start;
        double const bound = 0.01;
        for (int k = 0; k < knots; ++k) {
            std::vector<double> const u{values[static_cast<std::size_t>(k)]};
            for (int i = 0; i < 50; ++i) {
                double const h = 0.005;
                auto const f = [&](std::vector<double> const& y) {
                    return swings ? swing(y, result.truth, u) : growth(y, result.truth, u);
                };
                auto const moved = [&](std::vector<double> const& by, double step) {
                    return std::vector<double>{x[0] + step * by[0], x[1] + step * by[1]};
                };
                auto const a = f(x), b = f(moved(a, h / 2)), c = f(moved(b, h / 2)),
                           g = f(moved(c, h));
                for (std::size_t j = 0; j < 2; ++j)
                    x[j] += h / 6 * (a[j] + 2 * b[j] + 2 * c[j] + g[j]);
            }
            for (std::size_t y = 0; y < 2; ++y) {
                double const noise = d.uniform(-1, 1) * (bound - 1e-6);
                e.measurements.push_back({e.begin + 0.25 * (k + 1), y,
                                          interval(x[y] + noise - bound, x[y] + noise + bound)});
            }
        }
        result.problem.experiments.push_back(std::move(e));
    }
    return result;
}

/// visit(problem with its truth, draws that go on), for so many seeds.
template <class Visit>
void each_planted_curve(std::uint64_t count, Visit const& visit) {
    for (std::uint64_t seed = 1; seed <= count; ++seed) {
        draws d(seed);
        auto const p = plant_curve(d, d.coin());
        CAPTURE(seed);
        visit(p, d);
    }
}

} // namespace support

#endif
