// SPDX-License-Identifier: MIT
#include "support/problems.hpp"

#include "support/real_functions.hpp"

#include <string>
#include <vector>

namespace support {

planted_problem plant(draws& d, shape const& s, planted_rate const& rate, box const& prior,
                      std::vector<double> const& start, planting const& how) {
    planted_problem result;
    auto& problem = result.problem;
    problem.model = model_of(s, rate.on<sivid::expression>());
    problem.choice.unknown = all_constants(s.constants);
    problem.prior = prior;
    for (auto const& side : prior) result.truth.push_back(d.uniform(side.lower(), side.upper()));
    std::vector<std::vector<double>> times(how.experiments);
    std::vector<std::vector<std::size_t>> channels(how.experiments);
    for (std::size_t e = 0; e < how.experiments; ++e) {
        sivid::experiment x;
        x.name = "E" + std::to_string(e);
        std::vector<double> x0 = start;
        for (auto& v : x0) v *= 1 + 0.5 * static_cast<double>(e);
        x.initial = box(s.states);
        for (std::size_t i = 0; i < s.states; ++i) {
            x.initial[i] = how.spread > 0 ? around(x0[i], how.spread) : interval(x0[i]);
            x0[i] = d.in(x.initial[i]);
        }
        result.starts.push_back(x0);
        for (std::size_t k = 0; k < how.samples; ++k) {
            times[e].push_back(how.horizon * (static_cast<double>(k) + d.uniform(0.1, 1)) /
                               static_cast<double>(how.samples));
            channels[e].push_back(d.below(s.states));
        }
        x.outliers = how.outliers;
        result.outliers.emplace_back();
        while (result.outliers[e].size() < how.outliers) {
            result.outliers[e].insert(d.below(how.samples));
        }
        problem.experiments.push_back(x);
    }
    result.simulate = [rate = rate.on<extended>(), times, channels,
                       kinked = how.kinked](std::size_t e, std::vector<double> const& p,
                                            std::vector<double> const& x0) {
        auto const states =
            kinked ? reference_states<dormand_prince>(rate, extend(x0), extend(p), 0, times[e], {},
                                                      1e-13L, 0.05)
                   : reference_states(rate, extend(x0), extend(p), 0, times[e], {}, 1e-14L);
        extended_state y;
        for (std::size_t k = 0; k < states.size(); ++k) y.push_back(states[k][channels[e][k]]);
        return y;
    };
    for (std::size_t e = 0; e < how.experiments; ++e) {
        auto const y = result.simulate(e, result.truth, result.starts[e]);
        for (std::size_t k = 0; k < y.size(); ++k) {
            double measured = static_cast<double>(y[k]) + d.uniform(-0.95, 0.95) * how.noise;
            if (result.outliers[e].count(k) > 0) {
                measured += (d.coin() ? 1 : -1) * how.noise * d.uniform(5, 50);
            }
            problem.experiments[e].measurements.push_back(
                {times[e][k], channels[e][k], around(measured, how.noise)});
        }
    }
    return result;
}

planted_problem plant(draws& d, std::size_t model, planting const& asked) {
    auto how = asked;
    how.kinked = model % planted_models == 3;
    switch (model % planted_models) {
    case 0:
        return plant(
            d, {1, 2, 0, 10},
            [](auto const&, auto const& x, auto const& p, auto const&) {
                return std::vector{p[1] - p[0] * x[0]};
            },
            box{between(0.5, 2), between(0, 1)}, {1}, how);
    case 1:
        return plant(
            d, {1, 2, 0, 10},
            [](auto const&, auto const& x, auto const& p, auto const&) {
                return std::vector{p[0] * x[0] * (1 - x[0] / p[1])};
            },
            box{between(0.5, 1.5), between(0.8, 1.6)}, {0.2}, how);
    case 2: // p0 and p1 only through their product
        return plant(
            d, {1, 3, 0, 10},
            [](auto const&, auto const& x, auto const& p, auto const&) {
                return std::vector{p[2] - p[0] * p[1] * x[0]};
            },
            box{between(0.5, 2), between(0.5, 1.5), between(0, 1)}, {1}, how);
    case 3: // dry friction with a kink
        return plant(
            d, {2, 1, 0, 10},
            [](auto const&, auto const& x, auto const& p, auto const&) {
                using namespace real;
                return std::vector{x[1], -(p[0] * x[0]) - 0.25 * abs(x[1]) * x[1]};
            },
            box{between(1, 3)}, {1, 0.2}, how);
    default:
        return plant(
            d, {2, 2, 0, 10},
            [](auto const&, auto const& x, auto const& p, auto const&) {
                using namespace real;
                return std::vector{x[1], -(p[0] * sin(x[0])) - p[1] * x[1]};
            },
            box{between(1, 3), between(0, 0.5)}, {1, 0}, how);
    }
}

} // namespace support
