// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/claim/detail/answer_hulls.hpp>

#include "diagnosis/small_catalogue.hpp"
#include "support/catch.hpp"

#include <sivid/approximate/candidate/screening.hpp>
#include <sivid/diagnosis/candidate/detail/describe_candidate.hpp>

#include <string>

using namespace sivid;

namespace {

/// A run whose answer is the effect of this number.
diagnosis_run answered(small_campaign::truth const& real, std::size_t effect) {
    diagnosis_run run;
    run.base = small_campaign::problem(real);
    run.catalogue = small_campaign::catalogue();
    screening tried(run.base, run.catalogue);
    tried.try_one({});
    tried.try_one({effect});
    run.candidates = tried.candidates();
    run.answer = 1;
    run.result.causes.push_back(cause_of(run.candidates[1], run.catalogue, 1, 1));
    run.result.causes[0].inflation = interval(0.5, 0.9);
    return run;
}

} // namespace

TEST_CASE("an answer that explains the data gets hulls of everything, last and in time") {
    for (double const seconds : {60.0, 0.0}) {
        auto run = answered(small_campaign::with_slope(0.3), 1);
        diagnosis_effort effort(seconds, {}, {});
        answer_hulls(run, effort, {})();
        if (seconds == 0) {
            CHECK(run.answer_hull.parameters.size() == 0);
            CHECK_FALSE(run.result.causes[0].parameters[0].hull);
            continue;
        }
        REQUIRE(run.answer_hull.parameters.size() == 2);
        CHECK(contains(run.answer_hull.parameters[0], 1.0));
        REQUIRE(run.result.causes[0].parameters[0].hull);
        auto const hull = *run.result.causes[0].parameters[0].hull;
        CHECK(contains(hull, 0.3));
        CHECK(width(hull) < 0.2);
        CHECK(effort.left() > 0);
    }
}

TEST_CASE("what is not proved to explain the data has no hull") {
    auto run = answered(small_campaign::with_slope(0.3), 1);
    run.result.causes[0].inflation = interval(0.5, 1.5);
    diagnosis_effort effort(60, {}, {});
    answer_hulls(run, effort, {})();
    CHECK(run.answer_hull.parameters.size() == 0);
    CHECK_FALSE(run.result.causes[0].parameters[0].hull);
}
