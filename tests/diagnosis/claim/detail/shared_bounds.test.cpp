// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/claim/detail/shared_bounds.hpp>

#include "diagnosis/small_catalogue.hpp"
#include "support/catch.hpp"

#include <sivid/approximate/candidate/screening.hpp>
#include <sivid/diagnosis/claim/detail/diagnosis_consistency.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace sivid;

namespace {

/// The model as it is, and with each of these sets of effects; nothing is proved yet.
diagnosis_run fitted_run(small_campaign::truth const& real,
                         std::vector<std::vector<std::size_t>> const& sets) {
    diagnosis_run run;
    run.base = small_campaign::problem(real);
    run.catalogue = small_campaign::catalogue();
    screening tried(run.base, run.catalogue);
    tried.try_one({});
    for (auto const& effects : sets) tried.try_one(effects);
    run.candidates = tried.candidates();
    for (std::size_t k = 1; k < run.candidates.size(); ++k)
        run.result.causes.push_back(cause_of(run.candidates[k], run.catalogue, 1, 1));
    run.base_bound = verify_fit(run.candidates.front());
    run.result.inflation = run.base_bound.range;
    run.result.gap = gap_of(run.result.inflation);
    run.result.answer = answer_kind::open;
    return run;
}
interval from(double lower, double upper) {
    return interval_traits<interval>::bounds(lower, upper);
}

} // namespace

TEST_CASE("what a richer model cannot do the model itself cannot") {
    auto run = fitted_run(small_campaign::with_slope(0.4), {{0}, {2}, {0, 2}});
    auto& both = run.result.causes[2];
    REQUIRE(both.effects.size() == 2);
    auto const proved = bound_inflation(run.candidates[3].problem, &run.candidates[3].fit);
    REQUIRE(proved.value.lower() > 1);
    both.inflation = proved.value;
    CHECK(run.result.gap == gap_verdict::undecided);
    share_bounds(run);
    CHECK(run.result.gap == gap_verdict::certified);
    CHECK(run.result.inflation.lower() == proved.value.lower());
    CHECK(run.base_bound.range.lower() == proved.value.lower());
    for (auto const& c : run.result.causes) {
        CHECK(c.inflation.lower() == proved.value.lower());
        CHECK(c.verdict == cause_verdict::excluded);
    }
    // None of them is above what is true of it.
    for (std::size_t k = 0; k < run.candidates.size(); ++k)
        CHECK(run.result.inflation.lower() <=
              bound_inflation(run.candidates[k].problem).value.upper());
    CHECK(find_contradictions(run.result).empty());
}

TEST_CASE("a delay that may be none is no reason to know less") {
    auto run = fitted_run(small_campaign::with_slope(0.4), {{3}});
    run.result.causes[0].inflation = from(1.5, 100);
    share_bounds(run);
    CHECK(run.result.inflation.lower() == 1.5);
}

TEST_CASE("a witness of a model with fewer effects is one with more, at their neutral values") {
    auto const real = small_campaign::with_slope(0.4);
    auto run = fitted_run(real, {{1}, {0, 1}, {1, 3}, {2}});
    auto const alone = verify_fit(run.candidates[1]);
    REQUIRE(alone.range.upper() <= 1);
    auto& c = run.result.causes;
    c[0].inflation = alone.range;
    c[0].witness =
        named(run.candidates[1].problem, alone.witness->parameters, alone.witness->starts);
    c[0].verdict = cause_verdict::explains;
    share_bounds(run);
    for (std::size_t const k : {1U, 2U}) {
        CHECK(c[k].verdict == cause_verdict::explains);
        CHECK(c[k].inflation.upper() == alone.range.upper());
        REQUIRE(c[k].witness);
        // And it does: a validated run there says the same.
        auto const& problem = run.candidates[k + 1].problem;
        approximate_fit at;
        for (auto const& p : c[k].witness->parameters) at.parameters.push_back(p.value);
        for (auto const& s : c[k].witness->starts) {
            at.starts.emplace_back();
            for (auto const& x : s.states) at.starts.back().push_back(x.value);
        }
        CHECK(verify_at(problem, at).range.upper() <= 1);
    }
    // What does not hold the effect has the bound of the model as it is, which has one of its own.
    CHECK(c[3].verdict == cause_verdict::undecided);
    CHECK(c[3].inflation.upper() == run.result.inflation.upper());
    CHECK(run.result.gap == gap_verdict::undecided);
    run.result.answer = answer_kind::effects;
    run.result.effects = {"slope"};
    CHECK(find_contradictions(run.result).empty());
}

TEST_CASE("parts of the data, and of their bounds, say what they imply of all") {
    auto run = fitted_run(small_campaign::with_slope(0.4), {{0}});
    double const upper = run.result.inflation.upper();
    REQUIRE(upper > 2.5);
    run.result.scenario_inflation = {{"E1", "1", 9, from(0, 99)}, {"E2", "1", 2.2, from(2.1, 2.2)}};
    run.result.channel_inflation = {{"p", "1", 9, std::nullopt}};
    confined_gap part;
    part.channel = "v";
    part.factor = from(0, 2.4);
    auto const& w = *run.base_bound.witness;
    part.witness = named(run.base, w.parameters, w.starts);
    auto& slope = part.witness.parameters.front().value;
    slope = std::nextafter(slope, HUGE_VAL); // another one than that of the model as it is
    run.result.confined = {part};
    share_bounds(run);
    // What the result shows as the witness of its upper end is the one that attains it.
    REQUIRE(run.result.witness);
    CHECK(run.result.witness->parameters.front().value == slope);
    REQUIRE(run.base_bound.witness);
    CHECK(run.base_bound.witness->parameters.front() == slope);
    CHECK(run.result.inflation.lower() == 2.1);
    CHECK(run.result.inflation.upper() == 2.4);
    CHECK(run.base_bound.range.upper() == 2.4);
    CHECK(run.result.scenario_inflation[0].hull->upper() == 2.4);
    CHECK(run.result.scenario_inflation[0].value == 2.4);
    CHECK(run.result.confined[0].factor.lower() == 2.1);
    CHECK(run.result.causes[0].inflation.upper() == 2.4);
    CHECK(run.result.causes[0].inflation.lower() == 0);
}

TEST_CASE("bounds that contradict each other are not carried on") {
    auto run = fitted_run(small_campaign::with_slope(0.4), {{0}});
    double const upper = run.result.inflation.upper();
    run.result.causes[0].inflation = from(upper + 1, upper + 2);
    share_bounds(run);
    CHECK(run.result.inflation.lower() == 0);
    CHECK(run.result.causes[0].inflation.lower() == upper + 1);
    CHECK_FALSE(find_contradictions(run.result).empty());
}
