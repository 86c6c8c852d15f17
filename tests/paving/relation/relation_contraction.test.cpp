// SPDX-License-Identifier: MIT
#include <sivid/paving/relation/relation_contraction.hpp>

#include "diagnosis/planted_motion.hpp"
#include "support/catch.hpp"
#include "support/sweep.hpp"

#include <sivid/paving/identify.hpp>

#include <functional>

using namespace diagnosis_support;

namespace {

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

std::vector<planted> all_planted() {
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
    return result;
}
sampled_signal drawn_input(draws& d, double duration, interpolation kind) {
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
sampled_signal uncertain(draws& d, sampled_signal const& truth, double error) {
    std::vector<double> values = truth.values(), bounds(values.size(), error);
    for (auto& v : values) v += d.uniform(-0.99, 0.99) * error;
    return {truth.times(), values, truth.kind(), bounds};
}
/// The constants of a planted record, drawn at ends of the prior, too.
struct drawn_record {
    identification_problem problem;
    std::vector<double> truth;
};
drawn_record record_of(draws& d, planted const& what, recorded_model const& m) {
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

} // namespace

TEST_CASE("no parameter that explains the data is removed") {
    draws d(710);
    auto const count = support::swept(std::size_t{12}, std::size_t{400});
    for (auto const& what : all_planted()) {
        auto const m = model_of(what.shape, what.rate);
        for (std::size_t n = 0; n < count; ++n) {
            auto const r = record_of(d, what, m);
            auto const rest = contract_by_relations(r.problem, {.boxes = d.coin() ? 1u : 8u});
            INFO(what.name << " " << n);
            REQUIRE_FALSE(is_empty(rest));
            for (std::size_t j = 0; j < rest.size(); ++j) {
                CHECK(rest[j].lower() <= r.truth[j]);
                CHECK(r.truth[j] <= rest[j].upper());
            }
        }
    }
}

TEST_CASE("short records of wide priors tell much without any trajectory") {
    draws d(711);
    std::vector<double> shares;
    for (int n = 0; n < 6; ++n) {
        auto const what = all_planted()[0];
        auto const m = model_of(what.shape, what.rate);
        std::vector<double> const truth{1.2, 1.5, 0.3};
        identification_problem problem{m, {support::all_constants(3), {}}, what.prior, {}};
        for (int k = 0; k < 2; ++k) {
            std::vector<sampled_signal> const inputs{drawn_input(d, 3, interpolation::linear)};
            auto const motion = simulate(m, truth, inputs, {0.5, 0}, 3, what.step);
            problem.experiments.push_back(measured(d, support::numbered('S', std::size_t(k)),
                                                   motion, inputs, what.shown, 0.02,
                                                   noise::uniform));
        }
        auto const rest = contract_by_relations(problem);
        REQUIRE(contains(rest, truth));
        for (std::size_t j = 0; j < 3; ++j) shares.push_back(width(rest[j]) / width(what.prior[j]));
    }
    std::sort(shares.begin(), shares.end());
    CHECK(shares[shares.size() / 2] < 0.25);
}

TEST_CASE("a constant inside a root is told by halves of its prior") {
    draws d(712);
    auto const what = all_planted()[2];
    auto const m = model_of(what.shape, what.rate);
    std::vector<double> const truth{0.8, -0.6, 0.4};
    identification_problem problem{m, {support::all_constants(3), {}}, what.prior, {}};
    std::vector<sampled_signal> const inputs{drawn_input(d, 3, interpolation::linear)};
    auto const motion = simulate(m, truth, inputs, {1, 0}, 3, what.step);
    problem.experiments.push_back(
        measured(d, "S", motion, inputs, what.shown, 0.01, noise::uniform));
    auto const once = contract_by_relations(problem, {.boxes = 1});
    auto const halved = contract_by_relations(problem, {.boxes = 64});
    CHECK(contains(once, truth));
    CHECK(contains(halved, truth));
    CHECK(subset(halved, once));
    CHECK(width(halved[1]) < 0.7 * width(what.prior[1]));
    CHECK(width(halved[2]) < 0.7 * width(what.prior[2]));
}

TEST_CASE("rates that no channel shows are told by what changes at them") {
    draws d(715);
    auto const m = support::model_of(
        {2, 2, 1}, [](expression const&, std::vector<expression> const& x,
                      std::vector<expression> const& p, std::vector<expression> const& u) {
            return std::vector<expression>{p[0] * u[0] - p[1] * x[0], x[0]};
        });
    std::vector<double> const truth{1.2, 1.5};
    identification_problem problem{
        m, {support::all_constants(2), {}}, box{between(0.8, 2), between(1, 2)}, {}};
    for (int k = 0; k < 2; ++k) {
        std::vector<sampled_signal> const inputs{drawn_input(d, 3, interpolation::linear)};
        auto const motion = simulate(m, truth, inputs, {0.5, 0}, 3, 0.0025);
        problem.experiments.push_back(measured(d, support::numbered('S', std::size_t(k)), motion,
                                               inputs, {1}, 0.002, noise::uniform));
    }
    auto const rest = contract_by_relations(problem, {.boxes = 1});
    CHECK(contains(rest, truth));
    CHECK(width(rest[0]) < 0.9 * width(problem.prior[0]));
}

TEST_CASE("data that no parameter explains leave nothing") {
    draws d(713);
    auto const what = all_planted()[0];
    auto const m = model_of(what.shape, what.rate);
    std::vector<sampled_signal> const inputs{drawn_input(d, 3, interpolation::linear)};
    auto const motion = simulate(m, {6, 1.5, 0.3}, inputs, {0.5, 0}, 3, what.step);
    identification_problem problem{m, {support::all_constants(3), {}}, what.prior, {}};
    problem.experiments.push_back(
        measured(d, "S", motion, inputs, what.shown, 0.01, noise::uniform));
    CHECK(is_empty(contract_by_relations(problem)));
    SECTION("unless samples may be outliers") {
        problem.experiments[0].outliers = 1;
        CHECK(equal(contract_by_relations(problem)[0], what.prior[0]));
    }
    SECTION("or there was no time") {
        auto const rest = contract_by_relations(problem, {.keep_going = [] { return false; }});
        CHECK(equal(rest[0], what.prior[0]));
    }
}

TEST_CASE("nothing is known of a state that nobody sees, from a start that nobody knows") {
    draws d(714);
    auto const what = all_planted()[4];
    auto const m = model_of(what.shape, what.rate);
    std::vector<sampled_signal> const inputs{drawn_input(d, 3, interpolation::linear)};
    auto const motion = simulate(m, {1, 1, 0.2}, inputs, {0.5, 0}, 3, what.step);
    identification_problem problem{m, {support::all_constants(3), {}}, what.prior, {}};
    problem.experiments.push_back(
        measured(d, "S", motion, inputs, what.shown, 0.01, noise::uniform));
    CHECK(width(contract_by_relations(problem)[0]) < 0.9 * width(what.prior[0]));
    problem.experiments[0].initial[1] = between(-1e6, 1e6);
    CHECK(contains(contract_by_relations(problem), std::vector<double>{1, 1, 0.2}));
}

TEST_CASE("identify begins with it where runs over the prior end early") {
    draws d(716);
    auto const what = all_planted()[0];
    auto const m = model_of(what.shape, what.rate);
    std::vector<double> const truth{1.2, 1.5, 0.3};
    identification_problem problem{m, {support::all_constants(3), {}}, what.prior, {}};
    for (std::size_t k = 0; k < 2; ++k) {
        std::vector<sampled_signal> const inputs{drawn_input(d, 3, interpolation::linear)};
        auto const motion = simulate(m, truth, inputs, {0.5, 0}, 3, what.step);
        problem.experiments.push_back(measured(d, support::numbered('S', k), motion, inputs,
                                               what.shown, 0.02, noise::uniform));
        problem.experiments[k].initial[0] = between(0.45, 0.54);
    }
    identify_options options;
    options.search.boxes = 1;
    auto const found = identify(problem, options);
    REQUIRE(found.windows.has_value());
    CHECK(found.windows->left < 0.1);
    CHECK(contains(found.hull, truth));
    CHECK(subset(found.hull, contract_by_relations(problem, {.boxes = 1})));
    options.windows = false;
    auto const without = identify(problem, options);
    CHECK_FALSE(without.windows.has_value());
    CHECK(contains(without.hull, truth));
}
