// SPDX-License-Identifier: MIT
#include <sivid/decision/experiment_design.hpp>

#include "decision/planar_models.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"

#include <sivid/paving/identify.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

using namespace decision_support;

namespace {

std::vector<sivid::manoeuvre> shapes_for(sivid::prediction_problem const& p, double low,
                                         double high) {
    return sivid::manoeuvre_shapes({{0, "u0", "1", low, high}}, p.inputs, {0.0}, p.end);
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
