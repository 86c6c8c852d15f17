// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/diagnosis_run.hpp>

#include "diagnosis/small_catalogue.hpp"
#include "support/catch.hpp"

#include <sivid/approximate/candidate/screening.hpp>
#include <sivid/diagnosis/candidate/detail/effect_hulls.hpp>
#include <sivid/diagnosis/verification.hpp>
#include <sivid/model/effects.hpp>

#include <cstddef>
#include <stdexcept>

using namespace sivid;

namespace {

/// What a diagnosis of a cart leaves behind, without its proofs: the model, and it with one effect.
diagnosis_run fitted_run(small_campaign::truth const& real, std::size_t which = 0) {
    diagnosis_run run;
    run.base = small_campaign::problem(real);
    run.catalogue = small_campaign::catalogue();
    screening tried(run.base, run.catalogue);
    tried.try_one({});
    tried.try_one({which});
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

TEST_CASE("hold-out figures of the model itself stand under no cause") {
    auto run = fitted_run(small_campaign::with_drag(0.3));
    run.result.answer = answer_kind::unexplained; // what comes closest is the model
    run.result.causes.resize(1);                  // and then a candidate
    run.base_bound = verify_at(run.candidates[0].problem, run.candidates[0].fit);
    auto held_out = small_campaign::experiment(2, {});
    held_out.bridged = {{"u", 2, 0.1, true}};
    judge_by_holdout(run, holdout({held_out}));
    CHECK(run.result.assumptions.back() ==
          "of the held-out data; input u: held over 2 missing samples, longest gap 0.1 s");
    REQUIRE(run.holdout_before);
    CHECK(run.holdout_before->at_witness.upper() < 10);
    CHECK_FALSE(run.holdout_after);
    CHECK_FALSE(run.result.causes[0].holdout);
    CHECK_FALSE(run.result.shrink_holdout);
}

TEST_CASE("hold-out inputs may be recorded in another way than those of the fit") {
    auto const real = small_campaign::with_delay(0.2);
    auto run = fitted_run(real, 3);
    run.answer = 1;
    run.result.causes.resize(1);
    run.base_bound = verify_at(run.candidates[0].problem, run.candidates[0].fit);
    run.answer_bound = verify_at(run.candidates[1].problem, run.candidates[1].fit);
    REQUIRE(run.answer_bound.range.upper() <= 1);
    run.answer_hull = effect_hulls(run.base, {run.catalogue[3]}, {.seconds = 20});
    for (auto const between : {interpolation::linear, interpolation::hold}) {
        auto other = real;
        other.between = between;
        judge_by_holdout(run, holdout({small_campaign::experiment(2, other)}));
        REQUIRE(run.holdout_after);
        CHECK(run.holdout_after->at_witness.upper() <= 1);
        REQUIRE(run.holdout_after->over_fits);
        CHECK(run.holdout_after->over_fits->upper() < 4);
        CHECK(run.holdout_after->over_fits->upper() >= run.holdout_after->at_witness.lower());
    }
}

TEST_CASE("hold-out experiments that do not fit the model are refused") {
    auto run = fitted_run(small_campaign::with_drag(0.3));
    auto const refused = [&](auto const& change) {
        auto bad = small_campaign::experiment(2, {});
        change(bad);
        CHECK_THROWS_AS(judge_by_holdout(run, holdout({bad})), std::invalid_argument);
        CHECK_FALSE(run.holdout_before);
    };
    refused([](experiment& x) { x.inputs.clear(); });
    refused([](experiment& x) { x.initial = box{interval(0.0)}; });
    refused([](experiment& x) { x.measurements[3].channel = 7; });
    refused([](experiment& x) { x.measurements.clear(); });
    auto const twice = small_campaign::experiment(2, {});
    CHECK_THROWS_WITH(judge_by_holdout(run, holdout({twice, twice})),
                      ContainsSubstring("two experiments are called 'E3'"));
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
