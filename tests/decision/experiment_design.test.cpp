// SPDX-License-Identifier: MIT
#include <sivid/decision/experiment_design.hpp>

#include "decision/planar_models.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"

#include <sivid/approximate/simulate/simulate.hpp>
#include <sivid/paving/identify.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

using namespace decision_support;

namespace {

std::vector<sivid::manoeuvre> shapes_for(sivid::prediction_problem const& p, double low,
                                         double high) {
    return sivid::manoeuvre_shapes({{0, "u0", "1", low, high}}, p.inputs, {0.0}, p.end, "s");
}

} // namespace

TEST_CASE("an experiment is found whose promise every truth keeps") {
    auto p = driven_cart(4);
    auto const goal = sivid::parse_goal("p0", p.model);
    auto const plan = sivid::planned_measurements::every(0.25, p.end, {0.02});
    auto const found = sivid::design_experiment(p, shapes_for(p, -1, 1), plan, {goal}, nullptr,
                                                {.seconds = 100, .pairs = 30});
    auto const* best = found.best();
    REQUIRE(best != nullptr);
    auto const promised = best->promised->goals[0];
    CHECK(promised.factor() < 0.35);
    CHECK(best->estimate <= promised.factor() + 1e-9);
    CHECK(found.simulated > 100);

    // Fifty truths, errors at their ends or anywhere, and what is identified from them.
    support::draws d{11};
    sivid::identify_options options;
    options.only_hulls = true;
    options.search.boxes = 2000;
    auto const* input = std::get_if<sivid::sampled_signal>(&best->inputs[0]);
    REQUIRE(input != nullptr);
    for (int n = 0; n < 50; ++n) {
        double const drag = d.uniform(0.3, 0.7), drive = d.uniform(0.8, 1.2);
        sivid::identification_problem data;
        data.model = p.model;
        data.choice = p.choice;
        data.prior = p.sets[0];
        sivid::experiment e;
        e.name = "new";
        e.inputs = best->inputs;
        e.initial = p.initial;
        double x = 0, t = 0;
        for (double const at : plan.times) {
            int const steps = 2000;
            double const h = (at - t) / steps;
            for (int k = 0; k < steps; ++k) { // midpoint rule
                auto const rate = [&](double time, double value) {
                    return drive * input->approximate(time) - drag * value;
                };
                double const tau = t + k * h;
                x += h * rate(tau + h / 2, x + h / 2 * rate(tau, x));
            }
            t = at;
            double const share = n % 2 == 0 ? d.uniform(-1, 1) : (d.below(2) == 0 ? -1.0 : 1.0);
            e.measurements.push_back({at, 0, support::around(x + 0.0199 * share, 0.02)});
        }
        data.experiments = {e};
        auto const answer = sivid::identify(data, options);
        REQUIRE(sivid::contains(answer.hull[0], drag));
        CHECK(answer.hull[0].upper() - answer.hull[0].lower() <= promised.after * 1.0000001);
    }
}

TEST_CASE("an actuator begins each manoeuvre at what it is told") {
    auto p = lagged_cart(1);
    auto const goal = sivid::parse_goal("p0", p.model);
    auto const limits = sivid::parse_requirement("always(abs(x1 - u0) < 0.001)", p.model, p.end);
    auto const plan = sivid::planned_measurements::every(0.25, p.end, {0.02});
    auto const menu = sivid::manoeuvre_shapes({{0, "u0", "1", 1, 2}}, p.inputs, {0, 0}, p.end, "s");
    auto const found = sivid::design_experiment(p, {menu.front()}, plan, {goal}, &limits,
                                                {.seconds = 100, .pairs = 10});
    REQUIRE(found.best() != nullptr); // a constant: from a start of 0 it would have to catch up
    auto const direct = sivid::promise_widths(p.under(found.best()->inputs), plan, {goal.value});
    CHECK(found.best()->promised->goals[0].after <= direct.goals[0].after * 1.01);
    CHECK(found.best()->promised->goals[0].after >= direct.goals[0].after * 0.99);
}

TEST_CASE("limits of a design are proved for all parameters, or it is not allowed") {
    auto p = driven_cart(4);
    auto const goal = sivid::parse_goal("p0", p.model);
    auto const limits = sivid::parse_requirement("always(abs(x0) < 0.6)", p.model, p.end);
    auto const plan = sivid::planned_measurements::every(0.25, p.end, {0.02});
    auto const free = sivid::design_experiment(p, shapes_for(p, -1, 1), plan, {goal}, nullptr,
                                               {.seconds = 100, .pairs = 10});
    auto const bound = sivid::design_experiment(p, shapes_for(p, -1, 1), plan, {goal}, &limits,
                                                {.seconds = 100, .proved = 20, .pairs = 10});
    REQUIRE(bound.best() != nullptr);
    CHECK(bound.best()->limits == sivid::requirement_answer::proved);
    CHECK(bound.best()->factor() > free.best()->factor());
    for (auto const& t : bound.tried) {
        if (!t.allowed()) continue;
        auto own = p;
        own.inputs = t.inputs;
        CHECK(sivid::verify(own, limits, {}).answer == sivid::requirement_answer::proved);
    }
    auto const none = sivid::parse_requirement("always(x0 < -1)", p.model, p.end);
    auto const nothing = sivid::design_experiment(p, shapes_for(p, -1, 1), plan, {goal}, &none,
                                                  {.seconds = 100, .pairs = 10});
    CHECK(nothing.best() == nullptr);
}

namespace {

/// x' = u0 - p0 x, or x' = u0 - p0 x |x|: two causes of the same loss of speed.
sivid::prediction_problem slowed(bool square, double end) {
    sivid::prediction_problem p;
    p.model = support::model_of(
        {.states = 1, .constants = 1, .inputs = 1},
        [square](auto const&, auto const& x, auto const& c, auto const& u) {
            return std::vector{square ? u[0] - c[0] * sqr(x[0]) : u[0] - c[0] * x[0]};
        },
        [](auto const&, auto const& x, auto const&, auto const&) { return x; });
    p.choice.unknown = {"p0"};
    p.sets = {{between(0.2, 1.5)}};
    p.inputs = {sivid::sampled_signal({0.0}, {1.0}, sivid::interpolation::hold)};
    p.initial = {sivid::interval(1.0)};
    p.end = end;
    return p;
}

/// The data of an experiment with a true parameter, errors at and within their bounds.
sivid::identification_problem measured(sivid::prediction_problem const& truth, double p0,
                                       sivid::planned_measurements const& plan, support::draws& d) {
    sivid::identification_problem data;
    data.model = truth.model;
    data.choice = truth.choice;
    data.prior = truth.around();
    data.experiments.resize(1);
    auto& e = data.experiments[0];
    e.name = "new";
    e.inputs = truth.inputs;
    e.initial = truth.initial;
    auto choice = truth.choice;
    choice.unknown.clear();
    choice.fixed["p0"] = sivid::interval(p0);
    auto times = plan.times;
    auto const motion = sivid::simulate(
        std::make_shared<sivid::approximate_model const>(truth.model, choice, truth.inputs),
        truth.inputs, sivid::mid(truth.initial), {}, 0, times, {1e-10});
    for (std::size_t k = 0; k < times.size(); ++k) {
        double const share = d.below(2) == 0 ? d.uniform(-1, 1) : (d.below(2) == 0 ? -1.0 : 1.0);
        double const error = plan.errors[0];
        e.measurements.push_back(
            {times[k], 0, support::around(motion.outputs[k][0] + 0.999 * error * share, error)});
    }
    return data;
}

} // namespace

TEST_CASE("an experiment refutes one of two causes, whichever is true") {
    support::draws d{17};
    sivid::identify_options quick;
    quick.only_hulls = true;
    quick.search.boxes = 500;
    // At a steady speed both causes look alike.
    auto linear = slowed(false, 3), square = slowed(true, 3);
    auto const first = measured(linear, 0.98, {{1, 2, 3}, {0.02}}, d);
    for (auto* p : {&linear, &square}) {
        auto data = first;
        data.model = p->model;
        auto const left = sivid::identify(data, quick);
        REQUIRE(left.verdict != sivid::verdict::inconsistent);
        p->sets = {left.hull};
    }
    auto const same = sivid::tell_apart(linear, square, {{1, 2, 3}, {0.02}}, {.pairs = 100});
    CHECK_FALSE(same.told_apart);

    auto const plan = sivid::planned_measurements::every(0.25, 3, {0.02});
    auto const menu = sivid::manoeuvre_shapes({{0, "u0", "1", 0, 4}}, linear.inputs, {1}, 3, "s");
    auto const of_linear = sivid::parse_requirement("always(x0 < 3)", linear.model, 3);
    auto const of_square = sivid::parse_requirement("always(x0 < 3)", square.model, 3);
    auto const found = sivid::design_separation(linear, square, menu, plan, &of_linear, &of_square,
                                                {.seconds = 100, .proved = 3, .pairs = 60});
    auto const* best = found.best();
    REQUIRE(best != nullptr);
    CHECK(best->promised->told_apart);
    CHECK(best->limits == sivid::requirement_answer::proved);
    CHECK(best->factor() == 0);
    linear.inputs = square.inputs = best->inputs;
    for (auto const* truth : {&linear, &square}) {
        auto const* const other = truth == &linear ? &square : &linear;
        for (int n = 0; n < 10; ++n) {
            double const p0 = d.in(truth->sets[0][0]);
            auto data = measured(*truth, p0, plan, d);
            auto const own = sivid::identify(data, quick);
            CHECK(sivid::contains(own.hull[0], p0));
            data.model = other->model;
            data.prior = other->around();
            CHECK(sivid::identify(data, quick).verdict == sivid::verdict::inconsistent);
        }
    }
}
