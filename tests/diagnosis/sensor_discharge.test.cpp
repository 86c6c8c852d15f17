// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/sensor_discharge.hpp>

#include "diagnosis/planted_motion.hpp"
#include "support/catch.hpp"

using namespace diagnosis_support;

namespace {

box const prior{between(1, 10), between(0, 1), between(0.5, 2)};

/// A pendulum, with dry friction that the model lacks or with a biased second sensor.
identification_problem problem_of(draws& d, double dry, double bias) {
    identification_problem problem{pendulum(), {support::all_constants(3), {}}, prior, {}};
    for (double const pace : {1.5, 2.5}) {
        std::vector<sampled_signal> const inputs{sine_input(2, pace, 4)};
        auto const truth = simulate(pendulum(dry), {5, 0.3, 1}, inputs, {0.8, 0}, 4);
        problem.experiments.push_back(
            measured(d, support::numbered('S', problem.experiments.size()), truth, inputs, {0, 1},
                     0.01, noise::uniform, {0, bias}));
    }
    return problem;
}
sensor_fault const ranges{between(-0.1, 0.1), between(-0.3, 0.3)};

} // namespace

TEST_CASE("correcting a channel undoes its fault") {
    draws d(40);
    auto const problem = problem_of(d, 0, 0);
    auto const fixed = corrected(problem, "y1", {between(-0.5, 0.25), between(1, 2)});
    for (std::size_t e = 0; e < problem.experiments.size(); ++e) {
        auto const& before = problem.experiments[e].measurements;
        auto const& after = fixed.experiments[e].measurements;
        for (std::size_t k = 0; k < before.size(); ++k) {
            if (before[k].channel == 0) {
                CHECK(equal(before[k].bound, after[k].bound));
                continue;
            }
            double const s = d.uniform(-0.5, 0.25), b = d.uniform(1, 2);
            CHECK(contains(after[k].bound, (d.in(before[k].bound) - b) / (1 + s)));
        }
    }
    CHECK_THROWS_AS(corrected(problem, "y7", {}), std::invalid_argument);
    CHECK_THROWS_AS(corrected(problem, "y1", {between(-1, 0), between(0, 0)}),
                    std::invalid_argument);
}

TEST_CASE("a fault of the sensor is never discharged where it is the cause") {
    draws d(41);
    for (double const bias : {-0.2, 0.05, 0.25}) {
        auto const problem = problem_of(d, 0, bias);
        for (std::size_t i = 0; i < 2; ++i) {
            auto const verdict = discharge_sensor(problem, i, "y1", ranges, {}, 40);
            CHECK_FALSE(verdict.discharged);
            CHECK(verdict.examined <= 40);
        }
        // The other sensor cannot have caused what the kinematic equation shows.
        if (std::abs(bias) > 0.1) {
            REQUIRE(relation_examiner(problem).examine(0).proved);
            CHECK(discharge_sensor(problem, 0, "y0", {interval(0.0), between(-1, 1)}).discharged);
        }
    }
}

TEST_CASE("friction is no fault of a sensor") {
    draws d(42);
    auto const problem = problem_of(d, 1.5, 0);
    REQUIRE(relation_examiner(problem).examine(1).proved);
    auto const rate = discharge_sensor(problem, 1, "y1", {interval(0.0), between(-0.3, 0.3)});
    CHECK(rate.discharged);
    CHECK_FALSE(rate.repair);
    CHECK(rate.channel == "y1");
}

TEST_CASE("a relation that holds needs no repair") {
    draws d(43);
    auto const verdict = discharge_sensor(problem_of(d, 0, 0), 1, "y1", ranges);
    CHECK_FALSE(verdict.discharged);
    REQUIRE(verdict.repair);
    CHECK(verdict.repair->first == 0);
    CHECK(verdict.examined == 1);
}
