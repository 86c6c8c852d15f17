// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/gap/detail/gap_proof.hpp>

#include "diagnosis/small_campaign.hpp"
#include "diagnosis/small_catalogue.hpp"
#include "support/catch.hpp"

#include <sivid/approximate/candidate/screening.hpp>

using namespace sivid;

namespace {

screened fitted(small_campaign::truth const& real) {
    screening s(small_campaign::problem(real), {});
    s.try_one({});
    return s.candidates().front();
}

} // namespace

TEST_CASE("a gap is proved, within as much work whatever the clock says") {
    auto const s = fitted(small_campaign::with_drag(0.3));
    std::vector<inflation_range> found;
    for (double const seconds : {50.0, 100.0}) {
        diagnosis_effort effort(seconds, {}, {});
        auto bound = verify_fit(s);
        CHECK(bound.range.lower() == 0);
        CHECK(gap_of(bound.range) == gap_verdict::undecided);
        prove_gap(bound, s, effort, {});
        found.push_back(bound.range);
        CHECK(gap_of(bound.range) == gap_verdict::certified);
    }
    CHECK(found[0].lower() == found[1].lower());
    CHECK(found[0].upper() == found[1].upper());
}

TEST_CASE("no box: nothing is proved from below, unless by observers") {
    auto const s = fitted(small_campaign::with_drag(0.3));
    diagnosis_effort effort(100, {}, {});
    gap_options none;
    none.bound.boxes = none.further_boxes = 0;
    none.observers.boxes = 0;
    auto bound = verify_fit(s);
    prove_gap(bound, s, effort, none);
    CHECK(gap_of(bound.range) == gap_verdict::undecided);
    CHECK(bound.range.upper() > 1);
    none.observers = {20000, 0.3};
    prove_gap(bound, s, effort, none);
    CHECK(gap_of(bound.range) == gap_verdict::certified);
}

TEST_CASE("more work is done while it is open whether there is a gap, and no more") {
    auto const s = fitted(small_campaign::with_drag(0.3));
    diagnosis_effort effort(100, {}, {});
    gap_options brief;
    brief.bound.boxes = 0;
    auto bound = verify_fit(s);
    prove_gap(bound, s, effort, brief);
    CHECK(gap_of(bound.range) == gap_verdict::certified);
    auto longer = verify_fit(s);
    prove_gap(longer, s, effort, {});
    CHECK(longer.range.lower() >= bound.range.lower());
}

TEST_CASE("a model that explains its data has none") {
    auto const s = fitted({});
    diagnosis_effort effort(100, {}, {});
    auto bound = verify_fit(s);
    CHECK(gap_of(bound.range) == gap_verdict::none);
    prove_gap(bound, s, effort, {});
    CHECK(gap_of(bound.range) == gap_verdict::none);
    CHECK(bound.witness);
}

TEST_CASE("few experiments refute where there are many, and only there") {
    auto s = fitted(small_campaign::with_drag(0.3));
    std::size_t spent = 0;
    inflation_options search;
    CHECK(refuted_by_few(s, 1, search, spent) == 0); // two are not many
    auto const both = s.problem.experiments;
    auto const residuals = s.fit.residuals;
    s.problem.experiments.insert(s.problem.experiments.end(), both.begin(), both.end());
    s.fit.residuals.insert(s.fit.residuals.end(), residuals.begin(), residuals.end());
    CHECK(refuted_by_few(s, 1, search, spent) > 1);
    CHECK(spent > 0);
}

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
