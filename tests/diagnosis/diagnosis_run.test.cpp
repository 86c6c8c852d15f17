// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/diagnosis_run.hpp>

#include "diagnosis/small_catalogue.hpp"
#include "support/catch.hpp"

#include <sivid/diagnosis/candidate/screening.hpp>
#include <sivid/diagnosis/verification.hpp>
#include <sivid/model/effects.hpp>

using namespace sivid;

namespace {

/// What a diagnosis of a cart with drag leaves behind, without its proofs.
diagnosis_run fitted_run(small_campaign::truth const& real) {
    diagnosis_run run;
    run.base = small_campaign::problem(real);
    run.catalogue = small_campaign::catalogue();
    screening tried(run.base, run.catalogue);
    tried.try_one({});
    tried.try_one({0});
    run.candidates = tried.candidates();
    return run;
}

} // namespace

TEST_CASE("hold-out data change figures, never what was chosen") {
    auto const real = small_campaign::with_drag(0.3);
    auto run = fitted_run(real);
    run.answer = 1;
    run.result.answer = answer_kind::effects;
    run.result.effects = {"quadratic"};
    run.result.causes.resize(1);
    run.base_bound = verify_at(run.candidates[0].problem, run.candidates[0].fit);
    run.answer_bound = verify_at(run.candidates[1].problem, run.candidates[1].fit);
    // Data of another machine, so that the answer looks bad on them.
    auto const other = small_campaign::with_slope(0.5);
    judge_by_holdout(run, holdout({small_campaign::experiment(2, other)}));
    CHECK(run.answer == 1);
    CHECK(run.result.effects == std::vector<std::string>{"quadratic"});
    REQUIRE(run.result.causes[0].holdout);
    CHECK(run.result.causes[0].holdout->inflation_after.lower() > 1);
    REQUIRE(run.result.shrink_holdout);
    CHECK(run.result.shrink_holdout->upper() < 1);
}

TEST_CASE("without hold-out data, or without candidates, nothing is added") {
    auto run = fitted_run(small_campaign::with_drag(0.3));
    judge_by_holdout(run, holdout());
    CHECK_FALSE(run.holdout_before);
    diagnosis_run nothing;
    judge_by_holdout(nothing, holdout({small_campaign::experiment(2, {})}));
    CHECK_FALSE(nothing.holdout_before);
}

TEST_CASE("where nobody knows how often hold-out readings had wrapped, the answer is not judged") {
    using namespace sivid::literals;
    auto const wraps = effects::sensor_wrap("wraps", "p", "m", {0.85_dec, 0.95_dec}, 0.45);
    for (double const width : {0.0, 2.0}) { // of the start
        diagnosis_run run;
        run.base = small_campaign::problem();
        run.catalogue = {wraps};
        screening tried(run.base, run.catalogue);
        tried.try_one({});
        tried.try_one({0});
        run.candidates = tried.candidates();
        run.answer = 1;
        run.result.causes.resize(1);
        auto kept = small_campaign::experiment(2, {});
        kept.initial[0] = interval(mid(kept.initial[0]), mid(kept.initial[0]) + width);
        judge_by_holdout(run, holdout({kept}), 1);
        CHECK(run.holdout_before);
        CHECK(run.holdout_after.has_value() == (width == 0));
        CHECK(run.result.causes[0].holdout.has_value() == (width == 0));
    }
}
