// SPDX-License-Identifier: MIT
#include <sivid/paving/observer_refutation.hpp>

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
    double const proved = sivid::inflation_refuted_by_observers(problem, truth, 5);
    CHECK(proved > 0.5 * truth);
    CHECK(proved <= truth);
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

TEST_CASE("no time proves nothing") {
    auto const problem = decay(between(0.1, 3), 0.5, 0.6, 0.02);
    CHECK(sivid::inflation_refuted_by_observers(problem, 10, 0) == 0);
    CHECK(sivid::inflation_refuted_by_observers(problem, 10, 5, [] { return false; }) == 0);
}

TEST_CASE("starts are wide against the state's own range") {
    auto problem = decay(between(0.1, 3), 0.5, 0.6, 0.02);
    CHECK_FALSE(sivid::has_wide_starts(problem));
    double const limit = problem.model.about.states[0].limit;
    problem.experiments[0].initial = box{between(0, 0.2 * limit)};
    CHECK(sivid::has_wide_starts(problem));
}
