// SPDX-License-Identifier: MIT
#include <sivid/decision/verification.hpp>

#include "decision/planar_models.hpp"
#include "paving/plain_problem.hpp"
#include "support/catch.hpp"

#include <sivid/paving/judge/feasibility_test.hpp>

#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

using namespace decision_support;
using answer = sivid::requirement_answer;

TEST_CASE("a requirement holds for all parameters, or a witness violates it") {
    auto const p = decay({{between(0.5, 1)}}, {sivid::interval(2.0)}, 2); // x0(t) = 2 exp(-p0 t)
    CHECK(verified(p, "x0 at 1 in [0.735, 1.22]").answer == answer::proved);
    CHECK(verified(p, "always(x0 > 0.27) and eventually(x0 < 0.74)").answer == answer::proved);
    CHECK(verified(p, "x0 > 1 until[0, 1.4] x0 < 1.3").answer == answer::proved);
    auto const says = verified(p, "x0 at 1 >= 0.74"); // 2/e = 0.73576
    REQUIRE(says.answer == answer::refuted);
    REQUIRE(says.witness);
    double const rate = says.witness->parameters[0];
    CHECK(rate <= 1);
    CHECK(rate >= 0.5);
    CHECK(2 * std::exp(-rate) < 0.74);
    CHECK(says.witness->found.high < 0);
    CHECK(says.witness->found.low <= 2 * std::exp(-rate) - 0.74);
}

TEST_CASE("a chain of comparisons is asked at one time") {
    // x0(t) = 2 exp(-p0 t) is within [0.099, 0.45] at 3, and 2 at time 0.
    auto const p = decay({{between(0.5, 1)}}, {sivid::interval(2.0)}, 3);
    for (auto const* text : {"0.5 < x0 < 3 at 3", "3 > x0 > 0.5 at 3", "0.5 < x0 at 3 < 3",
                             "0.5 at 3 < x0 < 3", "x0 in [0.5, 3 at 3]"}) {
        CAPTURE(text);
        CHECK(verified(p, text).answer == answer::refuted);
    }
    CHECK(verified(p, "0 < x0 < 0.5 at 3").answer == answer::proved);
    CHECK(verified(p, "always(0 < x0 < 0.5 at 3)").answer == answer::proved);
}

TEST_CASE("the robustness holds that of every motion") {
    auto const p = decay({{between(0.5, 1)}}, {sivid::interval(2.0)}, 2);
    auto const says = verified(p, "x0 at 1 > 0.7");
    REQUIRE(says.answer == answer::proved);
    CHECK(says.found.low <= 2 / std::numbers::e - 0.7);
    CHECK(says.found.low > 2 / std::numbers::e - 0.75);
    CHECK(says.found.high >= 2 * std::exp(-0.5) - 0.7);
}

TEST_CASE("what happens between two instants only is found") {
    // cos(p0 t) has its least value between the instants of any grid, at t = pi / p0.
    auto const p = oscillator(between(1.99, 2.01), 3);
    sivid::prediction_options few;
    few.cells = 4;
    auto const holds = verified(p, "always(x0 > -1.001)", few);
    CHECK(holds.answer == answer::proved);
    CHECK(holds.times.size() > 5); // it had to look closer
    auto const fails = verified(p, "always(x0 > -0.9999)", few);
    REQUIRE(fails.answer == answer::refuted);
    CHECK(std::abs(fails.witness->time - std::numbers::pi / 2) < 0.1);
    auto const somewhen = verified(p, "eventually(x0 < -0.9999)", few);
    CHECK(somewhen.answer == answer::proved);
}

TEST_CASE("a violation at the last instant only") {
    auto const p = decay({{between(0.5, 1)}}, {sivid::interval(2.0)}, 1);
    double const least = 2 / std::numbers::e; // at the end, for p0 = 1
    auto const above = [](double x) { return "always(x0 > " + std::to_string(x) + ")"; };
    CHECK(verified(p, above(least - 1e-4)).answer == answer::proved);
    auto const fails = verified(p, above(least + 1e-4));
    REQUIRE(fails.answer == answer::refuted);
    CHECK(fails.witness->parameters[0] > 0.999);
    CHECK(fails.witness->time > 0.99);
}

TEST_CASE("a violation at a single corner of two parameters") {
    sivid::prediction_problem p;
    p.model = support::model_of(
        {.states = 2, .constants = 2},
        [](auto const&, auto const&, auto const& c, auto const&) {
            return std::vector{c[0], c[1]};
        },
        [](auto const&, auto const& x, auto const&, auto const&) { return x; });
    p.choice.unknown = {"p0", "p1"};
    p.sets = {{between(0, 1), between(0, 1)}};
    p.initial = {sivid::interval(0.0), sivid::interval(0.0)};
    p.end = 1; // x0(1) = p0, x1(1) = p1
    CHECK(verified(p, "(x0 + x1) at end < 2.001").answer == answer::proved);
    auto const fails = verified(p, "(x0 + x1) at end < 1.999");
    REQUIRE(fails.answer == answer::refuted);
    CHECK(fails.witness->parameters[0] + fails.witness->parameters[1] >= 1.999);
    // In a bilinear sense, too: only where one is great and the other small.
    CHECK(verified(p, "(x0 * (1 - x1)) at end < 0.999").answer == answer::refuted);
    CHECK(verified(p, "(x0 * (1 - x1)) at end < 1.001").answer == answer::proved);
}

TEST_CASE("without a feasible violation the answer is open") {
    auto p = decay({{between(0.5, 1)}}, {sivid::interval(2.0)}, 1);
    auto const what = sivid::parse_requirement("x0 at end > 0.8", p.model, p.end);
    auto feasible = all_feasible(p);
    std::size_t asked = 0;
    feasible.proved = [&](std::vector<double> const& x) {
        ++asked;
        return x[0] < 0.9; // what violates lies above ln(2.5) = 0.916
    };
    auto const says = sivid::verify(p, what, feasible, {.seconds = 3});
    CHECK(says.answer == answer::open);
    CHECK(asked > 0);
    REQUIRE_FALSE(says.open.empty());
    bool infeasible = false;
    for (auto const& b : says.open) {
        CHECK(b.parameters[0].upper() > 0.916);
        infeasible = infeasible || b.why == sivid::open_reason::infeasible;
    }
    CHECK(infeasible);
    // Nothing is refuted where nobody proves anything feasible.
    CHECK(sivid::verify(p, what, {}, {.seconds = 3}).answer == answer::open);
}

TEST_CASE("parameters that the measurements refute leave a requirement") {
    auto const data = plain_problem::make();
    sivid::feasibility_test test(data, {});
    auto const feasible = plain_problem::feasible(); // about [0.46, 0.54]
    auto p = decay({{between(0.3, 0.8)}}, {sivid::interval(1.0)}, 2);
    std::size_t asked = 0;
    auto const measured = [&](sivid::box const& parameters, std::function<bool()> const&) {
        ++asked;
        auto const& run = data.experiments[0];
        return sivid::measured_responses{{test.run(0, run.initial, parameters)}, {run.initial}};
    };
    auto const judged = [&](double bound) {
        auto const what =
            sivid::parse_requirement("x0 at end > " + std::to_string(bound), p.model, p.end);
        return sivid::verify(p, what, {}, {.seconds = 3}).answer;
    };
    auto const allowed = std::exp(-2 * feasible.upper()) - 0.01; // every feasible rate stays above
    CHECK(judged(allowed) == answer::open);
    p.measured = measured;
    CHECK(judged(allowed) == answer::proved);
    CHECK(asked > 0);
    CHECK(judged(std::exp(-2 * feasible.upper()) + 0.01) == answer::open); // some violate
}

TEST_CASE("parameters outside of the sets do not count") {
    auto apart = decay({{between(0.5, 0.6)}, {between(0.9, 1)}}, {sivid::interval(2.0)}, 1);
    // x0(1) in [1.0976, 1.2131] or [0.7357, 0.8132]
    auto const says = [&](std::string const& text) {
        auto p = apart;
        auto const what = sivid::parse_requirement(text, p.model, p.end);
        auto feasible = all_feasible(p);
        feasible.proved = [&](std::vector<double> const& x) {
            return contains(p.sets[0], x) || contains(p.sets[1], x);
        };
        return sivid::verify(p, what, feasible);
    };
    CHECK(says("x0 at 1 < 0.82 or x0 at 1 > 1.09").answer == answer::proved);
    auto const fails = says("x0 at 1 < 0.82");
    REQUIRE(fails.answer == answer::refuted);
    CHECK(fails.witness->parameters[0] < 0.61);
}

TEST_CASE("all starts count") {
    auto const p = decay({{between(0.5, 1)}}, {between(1, 2)}, 1);
    CHECK(verified(p, "x0 at 1 in [0.367, 1.214]").answer == answer::proved);
    auto const low = verified(p, "x0 at 1 > 0.4");
    REQUIRE(low.answer == answer::refuted);
    CHECK(low.witness->start[0] * std::exp(-low.witness->parameters[0]) < 0.4);
}

TEST_CASE("a scenario that lasts longer than its motions leaves the answer open") {
    auto const p = explosion(between(0.9, 1.1), 2); // no motion lasts 2 s
    for (std::string const text : {"always(x0 > 0)", "x0 at end > 0", "eventually(x0 < 0)"}) {
        auto const says = verified(p, text, {.seconds = 1});
        CAPTURE(text);
        CHECK(says.answer == answer::open);
        REQUIRE_FALSE(says.open.empty());
        CHECK(says.open.front().why == sivid::open_reason::not_enclosed);
        CHECK(says.reached < 1.12);
    }
    // What is decided before is decided.
    CHECK(verified(p, "always[0, 0.5](x0 > 0.9)", {.seconds = 3}).answer == answer::proved);
    CHECK(verified(p, "eventually(x0 > 1.5)", {.seconds = 3}).answer == answer::proved);
    CHECK(verified(p, "always[0, 0.5](x0 < 1.5)", {.seconds = 3}).answer == answer::refuted);
}

TEST_CASE("an expression that is not defined everywhere leaves the answer open") {
    auto const p = decay({{between(0.5, 1)}}, {sivid::interval(2.0)}, 1);
    CHECK(verified(p, "always(log(x0 - 1) < 5)", {.seconds = 1}).answer == answer::open);
    CHECK(verified(p, "always(log(x0 + 1) < 5)", {.seconds = 2}).answer == answer::proved);
}

TEST_CASE("a requirement that was read for another model is refused") {
    auto const p = decay({{between(0.5, 1)}}, {sivid::interval(2.0)}, 1);
    auto other = p.model;
    auto const what = sivid::parse_requirement("x0 * sin(3 * x0) at 1 > 0", other, 1);
    CHECK_THROWS_AS(sivid::verify(p, what, {}), std::invalid_argument);
    CHECK_THROWS_AS(sivid::verify(p, what, all_feasible(p)), std::invalid_argument);
}

TEST_CASE("without time nothing is said") {
    auto const p = decay({{between(0.5, 1)}}, {sivid::interval(2.0)}, 1);
    auto const says = verified(p, "x0 at 1 > 0", {.seconds = 0});
    CHECK(says.answer == answer::open);
    CHECK_FALSE(says.open.empty());
    CHECK(verified(p, "x0 at 1 > 0", {.seconds = NAN}).answer == answer::open);
}

TEST_CASE("inputs that jump are seen on both sides") {
    sivid::prediction_problem p;
    p.model = support::model_of(
        {.states = 1, .constants = 1, .inputs = 1},
        [](auto const&, auto const& x, auto const& c, auto const& u) {
            return std::vector{c[0] * (u[0] - x[0])};
        },
        [](auto const&, auto const& x, auto const&, auto const&) { return x; });
    p.choice.unknown = {"p0"};
    p.sets = {{between(1, 1.1)}};
    p.initial = {sivid::interval(0.0)};
    p.end = 2;
    p.inputs = {sivid::sampled_signal({0, 1}, {1, -1}, sivid::interpolation::hold)};
    CHECK(verified(p, "always[0, 0.9](u0 > 0.5) and always[1, 2](u0 < -0.5)").answer ==
          answer::proved);
    CHECK(verified(p, "always(u0 in [-1, 1])").answer == answer::proved);
    // Before t = 1 the input is 1 however close; the instant itself has -1.
    CHECK(verified(p, "always[0, 1](u0 > 0)").answer != answer::proved);
    CHECK(verified(p, "u0 > 0 until u0 < 0").answer == answer::proved);
    CHECK(verified(p, "always(x0 < 0.68) and eventually(x0 > 0.63)").answer == answer::proved);
}

namespace {

/// Two states and two parameters that begin at `initial`; `rate` is called with (x, p, u).
template <class Rate>
sivid::prediction_problem planar(Rate const& rate, sivid::box sets, sivid::box initial, double end,
                                 std::size_t inputs = 0) {
    sivid::prediction_problem p;
    p.model = support::model_of(
        {.states = 2, .constants = 2, .inputs = inputs},
        [&](auto const&, auto const& x, auto const& c, auto const& u) { return rate(x, c, u); },
        [](auto const&, auto const& x, auto const&, auto const&) { return x; });
    p.choice.unknown = {"p0", "p1"};
    p.sets = {std::move(sets)};
    p.initial = std::move(initial);
    p.end = end;
    return p;
}
sivid::interval const zero{0.0}, one{1.0};

} // namespace

TEST_CASE("what cannot move or matter is left out") {
    // x0 stays at 0, so that p0 says nothing and x1(t) = exp(-p1 t).
    auto const idle = planar(
        [](auto const& x, auto const& c, auto const&) {
            return std::vector{c[0] * x[0] * x[1], x[0] * x[0] - c[1] * x[1]};
        },
        {between(-5, 5), between(0.5, 1)}, {zero, one}, 1);
    auto const holds = verified(idle, "x1 at 1 in [0.367, 0.607]");
    CHECK(holds.answer == answer::proved);
    CHECK(holds.parts < 10);
    CHECK(verified(idle, "always(x0 >= 0 and x0 <= 0)").answer == answer::proved);
    auto const fails = verified(idle, "x1 at 1 > 0.37");
    REQUIRE(fails.answer == answer::refuted);
    REQUIRE(fails.witness->parameters.size() == 2);
    CHECK(fails.witness->parameters[1] > 0.99);
    CHECK(contains(idle.sets[0], fails.witness->parameters));
    // An open box says of an idle side all of it.
    auto nothing_feasible = idle;
    auto const what = sivid::parse_requirement("x1 at 1 > 0.4", nothing_feasible.model, 1);
    auto const open = sivid::verify(nothing_feasible, what, {}, {.seconds = 3});
    REQUIRE_FALSE(open.open.empty());
    CHECK(open.open[0].parameters[0].lower() == -5);
    CHECK(open.open[0].parameters[0].upper() == 5);
    // A parameter of the requirement alone counts.
    CHECK(verified(idle, "p0 at 0 < 4.5").answer == answer::refuted);
    CHECK(verified(idle, "(x1 - p0) at 1 > -4.5").answer == answer::refuted);
}

TEST_CASE("a parameter that acts by a derived constant counts") {
    auto p = planar(
        [](auto const& x, auto const& c, auto const&) {
            return std::vector{0 * x[0] - c[1] * x[0], x[1]};
        },
        {between(0.5, 1), between(0, 0)}, {one, zero}, 1);
    p.choice.unknown = {"p0"}; // p1 = 2 p0
    p.sets = {{between(0.5, 1)}};
    auto& g = p.model.g;
    p.model.derived.push_back(
        {1, g.mul(g.constant(2.0), g.leaf(sivid::operation::constant, 0)), false});
    CHECK(verified(p, "x0 at 1 in [0.135, 0.368]").answer == answer::proved);
    auto const fails = verified(p, "x0 at 1 > 0.2");
    REQUIRE(fails.answer == answer::refuted);
    CHECK(fails.witness->parameters[0] > 0.8);
    // One that is not defined everywhere says nothing of motions without it.
    p.model.derived.back().value = g.div(g.constant(1.0), g.leaf(sivid::operation::constant, 0));
    p.sets = {{between(-1, 1)}};
    CHECK(verified(p, "x0 at 1 > 0.2", {.seconds = 0.3}).answer == answer::open);
}

TEST_CASE("a state that begins at 0 may leave it where its motion is not unique") {
    auto const rests = [](auto const& rate) {
        return planar(rate, {between(0.5, 1), between(0.5, 1)}, {zero, zero}, 3);
    };
    auto const root = rests([](auto const& x, auto const& c, auto const&) {
        return std::vector{sqrt(abs(x[0])), x[0] - c[1] * x[1]};
    }); // also x0 = t^2/4
    auto const jump = rests([](auto const& x, auto const& c, auto const&) {
        return std::vector{sign(x[0]), x[0] - c[1] * x[1]};
    }); // also x0 = t
    auto const product = rests([](auto const& x, auto const& c, auto const&) {
        return std::vector{c[0] * x[1], sqrt(abs(x[1]))};
    });
    auto const hidden = rests([](auto const& x, auto const& c, auto const&) {
        return std::vector{x[1] * c[0], x[1] / sqrt(sqr(x[1]))}; // x1' = 1 or -1, not defined at 0
    });
    auto const logarithm = rests([](auto const& x, auto const& c, auto const&) {
        return std::vector{x[0] * log(sqr(x[0])), c[0] * x[0]};
    });
    for (auto const& p : {root, jump, product, hidden, logarithm}) {
        for (std::string const text : {"always(abs(x0) < 0.01)", "always(abs(x1) < 0.01)"}) {
            CAPTURE(text);
            CHECK(verified(p, text, {.seconds = 0.3}).answer != answer::proved);
        }
    }
}

TEST_CASE("a state that begins near 0 moves") {
    auto const rate = [](auto const& x, auto const& c, auto const&) {
        return std::vector{c[0] * x[0], x[0]};
    };
    auto const p = planar(rate, {between(1, 3), one}, {between(0, 0.1), zero}, 1);
    CHECK(verified(p, "x1 at 1 < 0.64").answer == answer::proved); // 0.1 (e^3 - 1)/3 = 0.6362
    auto const fails = verified(p, "x1 at 1 < 0.6");
    REQUIRE(fails.answer == answer::refuted);
    CHECK(fails.witness->start[0] > 0.09);
    CHECK(fails.witness->parameters[0] > 2.9);
}

TEST_CASE("an input counts unless it is the same all along") {
    auto const rate = [](auto const& x, auto const& c, auto const& u) {
        return std::vector{c[0] * u[0] - x[0], 0 * c[1] * x[0]};
    };
    auto p = planar(rate, {between(1, 2), one}, {zero, zero}, 2, 1);
    std::string const rests = "always(abs(x0) < 0.01)";
    p.inputs = {sivid::sampled_signal({0}, {0}, sivid::interpolation::hold)};
    CHECK(verified(p, rests).answer == answer::proved);
    p.inputs = {sivid::sampled_signal({0, 1}, {0, 1}, sivid::interpolation::hold)};
    CHECK(verified(p, rests).answer == answer::refuted);
    p.inputs = {sivid::sampled_signal({-1, 1, 3}, {0, 0, 1}, sivid::interpolation::linear)};
    CHECK(verified(p, rests).answer == answer::refuted);
    p.inputs = {sivid::sampled_signal({0}, {0}, sivid::interpolation::hold, {0.5})};
    CHECK(verified(p, rests, {.seconds = 0.5}).answer == answer::open);
    p.inputs = {sivid::analytic_signal::from([](auto const& t) { return t * 0.1; })};
    CHECK(verified(p, rests).answer == answer::refuted);
}
