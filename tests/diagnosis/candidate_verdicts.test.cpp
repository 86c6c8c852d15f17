// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/candidate_verdicts.hpp>

#include "diagnosis/small_catalogue.hpp"
#include "support/catch.hpp"

#include <algorithm>

using namespace sivid;

namespace {

diagnosis_run judged(small_campaign::truth const& real, diagnosis_options const& options = {},
                     int most_steps = 1000) {
    diagnosis_run run;
    run.base = small_campaign::problem(real);
    run.catalogue = small_campaign::catalogue();
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
    REQUIRE(causes.front().parameters[0].hull);
    CHECK(contains(*causes.front().parameters[0].hull, 0.3));
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

TEST_CASE("without boxes nothing is excluded; a stop leaves the rest undecided") {
    diagnosis_options none;
    none.exclusion.boxes = none.exclusions.boxes = 0;
    for (auto const& c : judged(small_campaign::with_slope(0.3), none).result.causes) {
        CHECK(c.verdict != cause_verdict::excluded);
    }
    for (auto const& c : judged(small_campaign::with_slope(0.3), {}, 0).result.causes) {
        CHECK(c.verdict == cause_verdict::undecided);
    }
}
