// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/claim/detail/candidate_verdicts.hpp>

#include "diagnosis/small_catalogue.hpp"
#include "support/catch.hpp"

#include <sivid/approximate/candidate/screening.hpp>
#include <sivid/paving/relation/detail/broken_relation.hpp>

#include <algorithm>

using namespace sivid;

namespace {

diagnosis_run judged(small_campaign::truth const& real, diagnosis_options const& options = {},
                     int most_steps = 1000, bool relations = false) {
    diagnosis_run run;
    run.base = small_campaign::problem(real);
    run.catalogue = small_campaign::catalogue();
    if (relations) run.findings = find_broken_relations(run.base);
    screening tried(run.base, run.catalogue);
    tried.run();
    run.candidates = tried.candidates();
    candidate_order const order(tried.figures(), tried.measurements(), {});
    run.answer = order.answer();
    for (auto const i : order.order()) {
        run.result.causes.push_back(
            cause_of(run.candidates[i], run.catalogue, run.base.prior.size(), 1));
    }
    diagnosis_effort effort(60, {}, [&](std::string const&) { return --most_steps >= 0; });
    candidate_verdicts(run, order, effort, options)();
    return run;
}
[[nodiscard]] bool holds(cause const& c, std::string const& effect) {
    return std::count(c.effects.begin(), c.effects.end(), effect) > 0;
}

} // namespace

TEST_CASE("the truth explains, no part of it is excluded, and something else is") {
    auto const causes = judged(small_campaign::with_slope(0.3)).result.causes;
    REQUIRE_FALSE(causes.empty());
    CHECK(causes.front().effects == std::vector<std::string>{"slope"});
    CHECK(causes.front().verdict == cause_verdict::explains);
    int excluded = 0;
    for (auto const& c : causes) {
        if (holds(c, "slope")) CHECK(c.verdict != cause_verdict::excluded);
        excluded += c.verdict == cause_verdict::excluded ? 1 : 0;
        if (c.verdict == cause_verdict::explains) CHECK(c.witness);
    }
    CHECK(excluded > 0);
}

TEST_CASE("the witness that is shown is the one that the inflation is proved at") {
    for (double const slope : {0.1, 0.2, 0.3, 0.4}) {
        auto const run = judged(small_campaign::with_slope(slope));
        auto const& shown = run.result.causes.front().witness;
        auto const& proved = run.answer_bound.witness;
        REQUIRE((shown && proved));
        REQUIRE(shown->parameters.size() == proved->parameters.size());
        for (std::size_t j = 0; j < proved->parameters.size(); ++j) {
            CHECK(shown->parameters[j].value == proved->parameters[j]);
        }
        CHECK(run.result.causes.front().inflation.upper() == run.answer_bound.range.upper());
    }
}

TEST_CASE("without boxes nothing is excluded, and a stop leaves the rest undecided") {
    diagnosis_options none;
    none.exclusion.boxes = none.exclusions.boxes = 0;
    for (auto const& c : judged(small_campaign::with_slope(0.3), none).result.causes) {
        CHECK(c.verdict != cause_verdict::excluded);
    }
    for (auto const& c : judged(small_campaign::with_slope(0.3), {}, 0).result.causes) {
        CHECK(c.verdict == cause_verdict::undecided);
    }
}

TEST_CASE("a refuted relation excludes what leaves it as it is, delays as well, without any box") {
    diagnosis_options no_boxes;
    no_boxes.exclusion.boxes = no_boxes.exclusions.boxes = 0;
    auto const verdict_of = [](diagnosis_run const& run, std::string const& effect) {
        for (auto const& c : run.result.causes) {
            if (c.effects != std::vector{effect}) continue;
            CHECK((c.verdict != cause_verdict::excluded || !c.assumptions.empty()));
            return c.verdict;
        }
        return cause_verdict::undecided;
    };
    // p' = v does not hold between the sensors: nothing that acts on v' mends that.
    auto const scaled = judged(small_campaign::with_scale(0.3), no_boxes, 1000, true);
    CHECK(verdict_of(scaled, "scale") == cause_verdict::explains);
    for (auto const* other : {"slope", "quadratic", "late"}) {
        CHECK(verdict_of(scaled, other) == cause_verdict::excluded);
    }
    // v' = k u - d v does not hold: the sensor of p is out of the question.
    auto const sloping = judged(small_campaign::with_slope(0.4), no_boxes, 1000, true);
    CHECK(verdict_of(sloping, "slope") == cause_verdict::explains);
    for (auto const& c : sloping.result.causes) {
        if (holds(c, "slope")) CHECK(c.verdict != cause_verdict::excluded);
    }
    for (auto const& real : {small_campaign::with_delay(0.3), small_campaign::with_drag(0.3),
                             small_campaign::truth{}}) {
        for (auto const& c : judged(real, no_boxes, 1000, true).result.causes) {
            bool const truth =
                holds(c, real.delay > 0 ? "late" : "quadratic") || c.fitted_inflation <= 1;
            if (truth) CHECK(c.verdict != cause_verdict::excluded);
        }
    }
}

TEST_CASE("a relation that a cause which explains leaves as it is excludes nothing") {
    auto const real = small_campaign::with_slope(0.4);
    auto run = judged(real, {}, 1000, false);
    auto const before = run.result.causes;
    relation_finding wrong; // p' = v holds
    wrong.equation = 0;
    wrong.proved = true;
    wrong.channels = {"p", "v"};
    wrong.assumptions = {"not met"};
    run.findings = {wrong};
    std::vector<candidate> figures;
    for (auto const& s : run.candidates) figures.push_back(s.figures);
    candidate_order const order(figures, 1, {});
    diagnosis_options no_boxes;
    no_boxes.exclusion.boxes = no_boxes.exclusions.boxes = 0;
    diagnosis_effort effort(60, {}, {});
    for (auto& c : run.result.causes) c.verdict = cause_verdict::undecided;
    candidate_verdicts(run, order, effort, no_boxes)();
    for (auto const& c : run.result.causes) CHECK(c.verdict != cause_verdict::excluded);
}
