// SPDX-License-Identifier: MIT
#include <sivid/paving/inflation/observer_refutation.hpp>

#include "support/catch.hpp"
#include "support/inflations.hpp"
#include "support/problems.hpp"

using namespace support;

namespace {

bool always() { return true; }

} // namespace

TEST_CASE("a decay: what is proved comes near the inflation and never passes it") {
    auto const prior = between(0.1, 3);
    auto const problem = decay(prior, 0.5, 0.6, 0.02);
    double const truth = decay_inflation(prior, 0.5, 0.6, 0.02);
    REQUIRE(truth > 4);
    auto const proved = sivid::inflation_refuted_by_observers(problem, truth);
    CHECK(proved.lower > 0.5 * truth);
    CHECK(proved.lower <= truth);
    auto const verdict =
        sivid::inflation_refuted_by_observers(problem, truth, {.only_verdict = true});
    CHECK(verdict.lower > 1);
    CHECK(verdict.lower < proved.lower);
    CHECK(verdict.boxes < proved.boxes);
    sivid::observer_refutation refuted(problem);
    CHECK(refuted(0.7 * truth, always));
    CHECK_FALSE(refuted(1.0001 * truth, [&] { return refuted.tested() < 3000; }));
}

TEST_CASE("problems with a truth are not refuted, whatever the time") {
    for (std::size_t trial = 0; trial < 10; ++trial) {
        draws d(40 + trial);
        planting how;
        how.experiments = 1 + trial % 3;
        how.spread = 0.1;
        how.outliers = trial % 2;
        auto const planted = plant(d, trial, how);
        sivid::observer_refutation refuted(planted.problem);
        CAPTURE(trial);
        CHECK_FALSE(refuted(1, [&] { return refuted.tested() < 400; }));
    }
}

TEST_CASE("a prior without the truth is refuted, though starts are wide") {
    draws d(5);
    planting how;
    how.samples = 30;
    how.horizon = 12;
    how.spread = 0.5;
    auto planted = plant(d, 0, how);
    auto& problem = planted.problem;
    // x' = p1 - p0 x, in equilibrium at p1/p0: three times as much is out of reach.
    double const level = planted.truth[1] / planted.truth[0];
    problem.prior[0] = between(0.5, 2);
    problem.prior[1] = between(3 * level * 2, 3 * level * 2.5);
    sivid::observer_refutation refuted(problem);
    CHECK(refuted(1, always));
    CHECK(refuted.tested() < 200);
}

TEST_CASE("no time and no boxes prove nothing") {
    auto const problem = decay(between(0.1, 3), 0.5, 0.6, 0.02);
    CHECK(sivid::inflation_refuted_by_observers(problem, 10, {.seconds = 0}).lower == 0);
    CHECK(sivid::inflation_refuted_by_observers(problem, 10, {.boxes = 0}).lower == 0);
    sivid::observer_effort stopped;
    stopped.go_on = [] { return false; };
    CHECK(sivid::inflation_refuted_by_observers(problem, 10, stopped).lower == 0);
}

TEST_CASE("boxes end a refutation where they end it, whatever the clock says") {
    auto const prior = between(0.1, 3);
    auto const problem = decay(prior, 0.5, 0.6, 0.02);
    double const truth = decay_inflation(prior, 0.5, 0.6, 0.02);
    double last = 0;
    for (std::size_t const boxes : {20u, 200u, 2000u}) {
        auto const once = sivid::inflation_refuted_by_observers(problem, truth, {boxes, 100});
        auto const again = sivid::inflation_refuted_by_observers(problem, truth, {boxes, 1000});
        CHECK(once.lower == again.lower);
        CHECK(once.boxes == again.boxes);
        CHECK(once.boxes <= boxes + sivid::interval_observer::width);
        CHECK(once.lower >= last);
        last = once.lower;
    }
}

TEST_CASE("what one level came to is where the next begins, and nothing is lost on the way") {
    auto const prior = between(0.1, 3);
    auto const problem = decay(prior, 0.5, 0.6, 0.02);
    double const truth = decay_inflation(prior, 0.5, 0.6, 0.02);
    sivid::observer_refutation in_steps(problem), at_once(problem);
    CHECK(in_steps(1, always));
    auto const first = in_steps.tested();
    CHECK(in_steps(0.7 * truth, always));
    CHECK(at_once(0.7 * truth, always));
    CHECK(in_steps.tested() - first <= at_once.tested());
    CHECK_FALSE(in_steps(1.0001 * truth, [&] { return in_steps.tested() < 6000; }));
}

TEST_CASE("starts are wide against the state's own range") {
    auto problem = decay(between(0.1, 3), 0.5, 0.6, 0.02);
    CHECK_FALSE(sivid::has_wide_starts(problem));
    double const limit = problem.model.about.states[0].limit;
    problem.experiments[0].initial = box{between(0, 0.2 * limit)};
    CHECK(sivid::has_wide_starts(problem));
}
