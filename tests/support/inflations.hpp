// SPDX-License-Identifier: MIT
// The inflation of planted problems at a point, by reference simulation.
#ifndef SIVID_TESTS_SUPPORT_INFLATIONS_HPP
#define SIVID_TESTS_SUPPORT_INFLATIONS_HPP

#include "support/problems.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

namespace support {

/// The largest over the experiments of the (q+1)-th largest |y - m| / e.
inline double inflation_of(planted_problem const& planted, std::vector<double> const& p,
                           std::vector<std::vector<double>> const& starts) {
    double worst = 0;
    for (std::size_t e = 0; e < starts.size(); ++e) {
        auto const y = planted.simulate(e, p, starts[e]);
        auto const samples = sivid::sorted(planted.problem.experiments[e].measurements);
        std::vector<double> misfits;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            auto const& b = samples[i].bound;
            double const m = 0.5 * (b.lower() + b.upper());
            misfits.push_back(std::abs(static_cast<double>(y[i]) - m) /
                              (0.5 * (b.upper() - b.lower())));
        }
        std::sort(misfits.begin(), misfits.end(), std::greater<>());
        auto const q = planted.problem.experiments[e].outliers;
        if (q < misfits.size()) worst = std::max(worst, misfits[q]);
    }
    return worst;
}

/// Divides all bounds' widths: an inflation about so many times larger.
inline planted_problem tightened(planted_problem planted, double factor) {
    for (auto& e : planted.problem.experiments) {
        for (auto& m : e.measurements) {
            double const middle = 0.5 * (m.bound.lower() + m.bound.upper());
            m.bound = around(middle, 0.5 * (m.bound.upper() - m.bound.lower()) / factor);
        }
    }
    return planted;
}

/// x' = -p x from 1, measured at 1 and 2 as m1 and m2 with half width e.
inline sivid::identification_problem decay(interval const& prior, double m1, double m2, double e) {
    sivid::identification_problem problem;
    problem.model = model_of({1, 1}, [](auto const&, auto const& x, auto const& p, auto const&) {
        return std::vector{-(p[0] * x[0])};
    });
    problem.choice.unknown = {"p0"};
    problem.prior = box{prior};
    sivid::experiment x;
    x.name = "E";
    x.initial = box{interval(1.0)};
    x.measurements = {{1, 0, around(m1, e)}, {2, 0, around(m2, e)}};
    problem.experiments = {x};
    return problem;
}
/// Its inflation: the maximum of two curves, one falling and one rising from their crossing on.
inline double decay_inflation(interval const& prior, double m1, double m2, double e) {
    double best = HUGE_VAL;
    for (int k = 0; k <= 2'000'000; ++k) {
        double const p = prior.lower() + (prior.upper() - prior.lower()) * k / 2e6;
        best =
            std::min(best, std::max(std::abs(std::exp(-p) - m1), std::abs(std::exp(-2 * p) - m2)));
    }
    return best / e;
}

} // namespace support

#endif
