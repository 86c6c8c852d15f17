// SPDX-License-Identifier: MIT
// Records of systems whose equations over windows tell their constants, all of them planted.
#ifndef SIVID_TESTS_DIAGNOSIS_PLANTED_RECORDS_HPP
#define SIVID_TESTS_DIAGNOSIS_PLANTED_RECORDS_HPP

#include "diagnosis/planted_motion.hpp"

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace diagnosis_support {

/// Equations with constants and a prior, and what is drawn about them.
struct planted {
    std::string name;
    support::shape shape;
    support::recorded_rate rate;
    box prior;
    std::vector<std::size_t> shown;
    box starts; ///< of the states
    double step = 0.0025;
};

inline std::vector<planted> all_planted() {
    using list = std::vector<expression>;
    using constants = list const&;
    std::vector<planted> result;
    result.push_back({"dry friction, steep",
                      {2, 3, 1},
                      [](expression const&, constants x, constants p, constants u) {
                          auto const direction = x[0] / sqrt(sqr(x[0]) + sqr(expression(0.01)));
                          return list{p[0] * u[0] - p[1] * x[0] - p[2] * direction, x[0]};
                      },
                      box{between(0.2, 3), between(0.5, 3), between(0, 1)},
                      {0, 1},
                      box{between(-1, 1), between(-1, 1)},
                      0.0005});
    result.push_back({"dry friction, a product over a root",
                      {2, 3, 1},
                      [](expression const&, constants x, constants p, constants u) {
                          return list{p[0] * u[0] - p[1] * x[0] -
                                          p[2] * x[0] / sqrt(sqr(x[0]) + sqr(x[1]) + 0.01),
                                      x[0]};
                      },
                      box{between(0.2, 3), between(0.5, 3), between(0, 1)},
                      {0, 1},
                      box{between(-1, 1), between(-1, 1)}});
    result.push_back({"wind in a root",
                      {2, 3, 1},
                      [](expression const&, constants x, constants p, constants u) {
                          auto const a = x[0] - p[1];
                          auto const b = x[1] - p[2];
                          auto const speed = sqrt(sqr(a) + sqr(b) + 0.01);
                          return list{u[0] - p[0] * speed * a, 1 - p[0] * speed * b};
                      },
                      box{between(0.5, 1), between(-2, 2), between(-1, 2)},
                      {0, 1},
                      box{between(-1, 2), between(-1, 2)}});
    result.push_back({"constants in products and quotients",
                      {3, 4, 1},
                      [](expression const&, constants x, constants p, constants u) {
                          return list{(p[0] * u[0] - p[1] * x[0]) / p[3] + x[1] * x[2],
                                      -p[2] / p[3] * x[1] - x[0] * x[2], p[0] * p[1] * u[0] - x[2]};
                      },
                      box{between(0.5, 2), between(0.2, 1), between(0.1, 1), between(0.8, 1.4)},
                      {0, 1, 2},
                      box{between(0, 1), between(-1, 1), between(-1, 1)}});
    result.push_back({"a state that nobody sees",
                      {2, 3, 1},
                      [](expression const&, constants x, constants p, constants u) {
                          return list{p[0] * x[1] - p[1] * x[0], (u[0] - x[1]) / p[2]};
                      },
                      box{between(0.5, 2), between(0.2, 2), between(0.18, 0.22)},
                      {0},
                      box{between(-1, 1), between(0, 0)}});
    result.push_back({"a kink",
                      {1, 2, 1},
                      [](expression const&, constants x, constants p, constants u) {
                          return list{u[0] - p[0] * abs(x[0]) * x[0] - p[1] * max(x[0], 0.2)};
                      },
                      box{between(0, 2), between(0.1, 2)},
                      {0},
                      box{between(-1, 1)}});
    result.push_back({"the rate of another state",
                      {2, 2, 1},
                      [](expression const&, constants x, constants p, constants u) {
                          return list{u[0] - p[0] * x[0] - p[1] * sin(x[1]), x[0]};
                      },
                      box{between(0, 2), between(0, 9)},
                      {1},
                      box{between(-1, 1), between(-1, 1)}});
    result.push_back(
        {"friction seen by positions",
         {2, 5, 1},
         [](expression const&, constants x, constants p, constants u) {
             auto const direction = x[0] / sqrt(sqr(x[0]) + sqr(expression(0.01)));
             return list{p[0] * u[0] - p[1] * x[0] - p[2] * direction - p[3] * abs(x[0]) + p[4],
                         x[0]};
         },
         box{between(0.2, 3), between(0, 3), between(0, 1), between(-0.5, 0.5), between(-0.3, 0.3)},
         {1},
         box{between(-1, 1), between(-1, 1)},
         0.0005});
    result.push_back({"two encoders on one shaft",
                      {3, 2, 1},
                      [](expression const&, constants x, constants p, constants u) {
                          return list{p[0] * u[0] - p[1] * x[0], x[0], x[0]};
                      },
                      box{between(0.8, 2), between(1, 2)},
                      {1, 2},
                      box{between(-1, 1), between(-1, 1), between(-1, 1)}});
    result.push_back(
        {"two masses seen by positions",
         {4, 4, 1},
         [](expression const&, constants x, constants p, constants u) {
             auto const pull = p[1] * (x[2] - x[3]) + p[2] * max(x[0] - x[1], 0);
             return list{p[0] * u[0] - pull, pull - p[3] * abs(x[1]) * x[1], x[0], x[1]};
         },
         box{between(0.5, 2), between(1, 5), between(0, 1), between(0, 2)},
         {2, 3},
         box{between(-1, 1), between(-1, 1), between(-1, 1), between(-1, 1)}});
    return result;
}

inline sampled_signal drawn_input(draws& d, double duration, interpolation kind) {
    std::vector<double> t, v;
    double const size = d.uniform(0.3, 2);
    double const pace = d.uniform(0.5, 5);
    for (int k = 0; k * 0.05 < duration + 0.06; ++k) {
        t.push_back(k * 0.05);
        v.push_back(size * (d.coin() ? std::sin(pace * t.back()) : d.uniform(-1, 1)));
    }
    return {t, v, kind};
}
/// The same values, known up to a bound that the true ones keep.
inline sampled_signal uncertain(draws& d, sampled_signal const& truth, double error) {
    std::vector<double> values = truth.values(), bounds(values.size(), error);
    for (auto& v : values) v += d.uniform(-0.99, 0.99) * error;
    return {truth.times(), values, truth.kind(), bounds};
}
/// The constants of a planted record, drawn at ends of the prior, too.
struct drawn_record {
    identification_problem problem;
    std::vector<double> truth;
};
inline drawn_record record_of(draws& d, planted const& what, recorded_model const& m) {
    drawn_record result;
    result.truth = d.in(what.prior);
    result.problem.model = m;
    result.problem.choice = {support::all_constants(what.shape.constants), {}};
    result.problem.prior = what.prior;
    auto const experiments = 1 + d.below(3);
    for (std::size_t k = 0; k < experiments; ++k) {
        auto const kind = d.coin() ? interpolation::linear : interpolation::hold;
        std::vector<sampled_signal> const inputs{drawn_input(d, 3, kind)};
        auto const truth = simulate(m, result.truth, inputs, d.in(what.starts), 3, what.step);
        auto const sort = static_cast<noise>(d.below(4));
        double const error = d.coin() ? 0.02 : 0.1;
        auto e = measured(d, support::numbered('S', k), truth, inputs, what.shown, error, sort, {},
                          d.coin() ? 0.05 : 0.1);
        if (d.coin()) e.inputs[0] = uncertain(d, inputs[0], d.uniform(0.001, 0.1));
        for (std::size_t i = 0; d.coin() && i < e.initial.size(); ++i) {
            e.initial[i] = around(truth.states[0][i] + d.uniform(-0.04, 0.04), 0.05);
        }
        result.problem.experiments.push_back(std::move(e));
    }
    return result;
}

/// Two records of the first system with its constants as they are given.
inline identification_problem two_records(draws& d, std::vector<double> const& truth) {
    auto const what = all_planted()[0];
    auto const m = model_of(what.shape, what.rate);
    identification_problem problem{m, {support::all_constants(3), {}}, what.prior, {}};
    for (std::size_t k = 0; k < 2; ++k) {
        std::vector<sampled_signal> const inputs{drawn_input(d, 3, interpolation::linear)};
        auto const motion = simulate(m, truth, inputs, {0.5, 0}, 3, what.step);
        problem.experiments.push_back(measured(d, support::numbered('S', k), motion, inputs,
                                               what.shown, 0.02, noise::uniform));
    }
    return problem;
}

/// One record of the wind in a root.
inline identification_problem windy_record(draws& d, std::vector<double> const& truth) {
    auto const what = all_planted()[2];
    auto const m = model_of(what.shape, what.rate);
    identification_problem problem{m, {support::all_constants(3), {}}, what.prior, {}};
    std::vector<sampled_signal> const inputs{drawn_input(d, 3, interpolation::linear)};
    auto const motion = simulate(m, truth, inputs, {1, 0}, 3, what.step);
    problem.experiments.push_back(
        measured(d, "S", motion, inputs, what.shown, 0.01, noise::uniform));
    return problem;
}

} // namespace diagnosis_support

#endif
