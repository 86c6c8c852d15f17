// SPDX-License-Identifier: MIT
#include <sivid/decision/promised_width.hpp>

#include "decision/planar_models.hpp"
#include "paving/plain_problem.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"

#include <sivid/paving/judge/feasibility_test.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <utility>
#include <vector>

using namespace decision_support;

namespace {

sivid::node_id constant_of(sivid::prediction_problem& p, std::size_t k) {
    return p.model.g.leaf(sivid::operation::constant, k);
}

/// How far p and q of [low, high] may lie apart with |y(p, x) - y(q, z)| <= 2 e at all times.
template <class Output>
double worst(double low, double high, std::vector<double> const& starts,
             std::vector<double> const& times, double e, Output const& y) {
    double most = 0;
    int const n = 400;
    for (int i = 0; i <= n; ++i) {
        for (int j = i; j <= n; ++j) {
            double const p = low + (high - low) * i / n, q = low + (high - low) * j / n;
            if (q - p <= most) continue;
            for (double const x : starts) {
                for (double const z : starts) {
                    bool const same = std::all_of(times.begin(), times.end(), [&](double t) {
                        return std::abs(y(p, x, t) - y(q, z, t)) <= 2 * e;
                    });
                    if (same) most = std::max(most, q - p);
                }
            }
        }
    }
    return most;
}

double falling(double p, double x, double t) { return x * std::exp(-p * t); }

} // namespace

TEST_CASE("what an experiment leaves at worst is bounded closely") {
    auto p = decay({{between(0.5, 1.5)}}, {sivid::interval(1.0)}, 2);
    auto const goal = constant_of(p, 0);
    for (auto const& times : {std::vector<double>{1}, std::vector<double>{0.5, 1, 2}}) {
        auto const found = sivid::promise_widths(p, {times, {0.01}}, {goal}, {.pairs = 60});
        REQUIRE(found.goals.size() == 1);
        CHECK(found.reached == 2);
        double const sure = worst(0.5, 1.5, {1.0}, times, 0.01, falling);
        CHECK(std::abs(found.goals[0].before - 1) < 1e-12);
        CHECK(found.goals[0].after >= sure);
        CHECK(found.goals[0].after <= 1.1 * sure + 0.005);
        CHECK(found.goals[0].factor() <= found.goals[0].after * (1 + 1e-12));
    }
}

TEST_CASE("each of the two motions has its own start") {
    auto p = decay({{between(0.5, 1.5)}}, {between(0.9, 1.1)}, 2);
    auto const goal = constant_of(p, 0);
    std::vector<double> const times{0.5, 1, 1.5, 2};
    double const sure = worst(0.5, 1.5, {0.9, 0.95, 1.0, 1.05, 1.1}, times, 0.02, falling);
    auto const found = sivid::promise_widths(p, {times, {0.02}}, {goal}, {.pairs = 100});
    CHECK(sure > 0.1);
    CHECK(found.goals[0].after >= sure);
    CHECK(found.goals[0].after <= 1.25 * sure);
}

TEST_CASE("periods that cannot be told apart are not promised to part") {
    auto p = oscillator(between(0.5, 9.0), 3);
    auto const goal = constant_of(p, 0);
    std::vector<double> const times{1, 2, 3}; // cos w t is the same for w and 2 pi - w
    auto const found =
        sivid::promise_widths(p, {times, {0.01, 0}}, {goal}, {.seconds = 2, .pairs = 60});
    CHECK(found.goals[0].after >= 2 * 3.14159265 - 2 * 0.5 - 0.1);
    auto const finer = sivid::promise_widths(p, {{0.3, 0.6, 1, 2, 3}, {0.01, 0.01}}, {goal},
                                             {.seconds = 20, .pairs = 400, .target = 0.05});
    CHECK(finer.goals[0].after < 0.5);
}

TEST_CASE("what is known already is used, and several goals are followed at once") {
    auto p = decay({{between(0.5, 0.6)}, {between(1.4, 1.5)}}, {sivid::interval(1.0)}, 2);
    auto const goal = constant_of(p, 0);
    auto const square = p.model.g.binary(sivid::operation::mul, goal, goal);
    auto const found =
        sivid::promise_widths(p, {{1}, {0.05}}, {goal, square}, {.pairs = 60, .target = 0.2});
    REQUIRE(found.goals.size() == 2);
    CHECK(std::abs(found.goals[0].before - 1) < 1e-12);
    CHECK(found.goals[0].after <= 0.1 + 1e-9); // within one of the two sets
    CHECK(found.goals[1].after <= 0.3);
    CHECK(found.goals[1].after >= 1.5 * 1.5 - 1.4 * 1.4);
}

TEST_CASE("what was measured before sharpens a promise") {
    auto const data = plain_problem::make(0, 0, sivid::interval(2.0));
    sivid::feasibility_test test(data, {});
    auto p = decay({{between(0.3, 0.8)}}, {between(0.5, 1.5)}, 3); // a poor experiment
    auto const goal = constant_of(p, 0);
    sivid::planned_measurements const plan{{1, 2, 3}, {0.05}};
    auto const alone = sivid::promise_widths(p, plan, {goal}, {.pairs = 30});
    p.measured = [&](sivid::box const& parameters, std::function<bool()> const&) {
        auto const& run = data.experiments[0];
        return sivid::measured_responses{{test.run(0, run.initial, parameters)}, {run.initial}};
    };
    auto const both = sivid::promise_widths(p, plan, {goal}, {.pairs = 30});
    auto const feasible = plain_problem::feasible();
    double const left = feasible.upper() - feasible.lower();
    CHECK(alone.goals[0].after > 1.5 * left);
    CHECK(both.goals[0].after >= left * (1 - 1e-9)); // the new data may tell nothing
    CHECK(both.goals[0].after <= 1.1 * left);
}

TEST_CASE("plans and goals that make no sense are refused") {
    auto p = decay({{between(0.5, 1.5)}}, {sivid::interval(1.0)}, 2);
    auto const goal = constant_of(p, 0);
    auto const state = p.model.g.leaf(sivid::operation::state, 0);
    CHECK_THROWS_AS(sivid::promise_widths(p, {{1}, {0.1}}, {state}), std::invalid_argument);
    CHECK_THROWS_AS(sivid::promise_widths(p, {{1}, {}}, {goal}), std::invalid_argument);
    CHECK_THROWS_AS(sivid::promise_widths(p, {{1}, {0.0}}, {goal}), std::invalid_argument);
    CHECK_THROWS_AS(sivid::promise_widths(p, {{1}, {NAN}}, {goal}), std::invalid_argument);
    CHECK_THROWS_AS(sivid::promise_widths(p, {{3}, {0.1}}, {goal}), std::invalid_argument);
    CHECK_THROWS_AS(sivid::promise_widths(p, {{}, {0.1}}, {goal}), std::invalid_argument);
    CHECK_THROWS_AS(sivid::planned_measurements::every(0, 2, {0.1}), std::invalid_argument);
    CHECK(sivid::planned_measurements::every(0.5, 2, {0.1}).times ==
          std::vector<double>{0.5, 1, 1.5, 2});
}

TEST_CASE("motions that are lost promise what they show until then") {
    auto p = explosion(between(0.5, 2.0), 3); // from x(0) = 1: infinite after 1 / p
    auto const goal = constant_of(p, 0);
    auto const found =
        sivid::promise_widths(p, {{0.2, 0.4, 2.5}, {0.01}}, {goal}, {.seconds = 3, .pairs = 40});
    CHECK(found.reached < 2.5);
    CHECK(found.goals[0].after > 0);
    CHECK(found.goals[0].after < 0.5);
}

namespace {

/// x' = -p0 x^n from 1.
sivid::prediction_problem power_law(int n, sivid::interval const& rate, double end) {
    auto p = decay({{rate}}, {sivid::interval(1.0)}, end);
    if (n == 2) {
        p.model = support::model_of(
            {.states = 1, .constants = 1},
            [](auto const&, auto const& x, auto const& c, auto const&) {
                return std::vector{-(c[0] * sqr(x[0]))};
            },
            [](auto const&, auto const& x, auto const&, auto const&) { return x; });
    }
    return p;
}

} // namespace

namespace {

struct told_apart {
    sivid::planned_measurements plan;
    explicit told_apart(sivid::planned_measurements p) : plan(std::move(p)) {}
    [[nodiscard]] bool operator()(sivid::prediction_problem const& a,
                                  sivid::prediction_problem const& b) const {
        return sivid::tell_apart(a, b, plan, {.seconds = 100, .pairs = 60}).told_apart;
    }
};

} // namespace

TEST_CASE("two models are told apart where no pair of their motions is close, and not else") {
    auto const linear = power_law(1, between(0.4, 0.8), 4);
    auto const square = power_law(2, between(0.4, 0.8), 4);
    auto const exp_at = [](double p, double t) { return std::exp(-p * t); };
    auto const square_at = [](double p, double t) { return 1 / (1 + p * t); };
    std::vector<double> const times{1, 2, 4};
    double closest = 1; // the smallest largest difference of all pairs
    for (int i = 0; i <= 400; ++i) {
        for (int j = 0; j <= 400; ++j) {
            double most = 0;
            for (double const t : times)
                most = std::max(
                    most, std::abs(exp_at(0.4 + 0.001 * i, t) - square_at(0.4 + 0.001 * j, t)));
            closest = std::min(closest, most);
        }
    }
    REQUIRE(closest > 0.02);
    for (double const share : {0.5, 0.9, 1.02, 2.0}) { // of what can just be told
        double const error = 0.5 * share * closest;
        auto const found = sivid::tell_apart(linear, square, {times, {error}},
                                             {.seconds = 100, .pairs = share > 1 ? 60U : 4000U});
        CHECK(found.told_apart == (share < 1));
        auto const turned = sivid::tell_apart(square, linear, {times, {error}},
                                              {.seconds = 100, .pairs = share > 1 ? 60U : 4000U});
        CHECK(turned.told_apart == (share < 1));
    }
    // The same model, and the same parameters among others: never.
    CHECK_FALSE(sivid::tell_apart(linear, power_law(1, between(0.7, 0.9), 4), {times, {1e-9}},
                                  {.seconds = 100, .pairs = 30})
                    .told_apart);
    CHECK(sivid::tell_apart(linear, power_law(1, between(0.9, 1), 4), {times, {1e-3}}).told_apart);
    CHECK_THROWS_AS(sivid::tell_apart(linear, power_law(1, between(0.7, 0.9), 3), {{1}, {0.1}}),
                    std::invalid_argument);
}

TEST_CASE("each of two models hears its own data") {
    auto const data = plain_problem::make(0, 0, sivid::interval(2.0));
    sivid::feasibility_test test(data, {});
    auto const feasible = plain_problem::feasible();
    auto known = decay({{between(0.3, 0.8)}}, {sivid::interval(1.0)}, 3);
    auto const free = decay({{between(feasible.upper() + 0.03, 0.9)}}, {sivid::interval(1.0)}, 3);
    sivid::planned_measurements const plan{{1, 2, 3}, {0.002}};
    told_apart const told(plan);
    CHECK_FALSE(told(known, free));
    CHECK_FALSE(told(free, known));
    known.measured = [&](sivid::box const& parameters, std::function<bool()> const&) {
        auto const& run = data.experiments[0];
        return sivid::measured_responses{{test.run(0, run.initial, parameters)}, {run.initial}};
    };
    CHECK(told(known, free));
    CHECK(told(free, known));
}
