// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/gap/detail/hardest_experiments.hpp>

#include "diagnosis/small_campaign.hpp"
#include "diagnosis/small_catalogue.hpp"
#include "support/catch.hpp"

using namespace sivid;

TEST_CASE("the experiments that a fit misses by most are kept, in their order") {
    auto problem = small_campaign::problem({});
    problem.experiments.push_back(problem.experiments.front());
    problem.experiments.back().name = "third";
    REQUIRE(problem.experiments.size() == 3);
    approximate_fit fit;
    fit.residuals = {{0.1, -3}, {2, 0.5}, {0.2, -2.5}};
    CHECK(hardest_experiments(problem, fit, 3).experiments.size() == 3);
    auto const two = hardest_experiments(problem, fit, 2);
    REQUIRE(two.experiments.size() == 2);
    CHECK(two.experiments[0].name == problem.experiments[0].name);
    CHECK(two.experiments[1].name == problem.experiments[2].name);
    // An outlier that the budget allows does not count.
    problem.experiments[0].outliers = 1;
    auto const one = hardest_experiments(problem, fit, 1);
    REQUIRE(one.experiments.size() == 1);
    CHECK(one.experiments[0].name == problem.experiments[2].name);
    // A fit that failed chooses nothing.
    CHECK(hardest_experiments(problem, {}, 1).experiments.size() == 3);
}
