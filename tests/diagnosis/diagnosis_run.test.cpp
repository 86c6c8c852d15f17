// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/diagnosis_run.hpp>

#include "diagnosis/small_campaign.hpp"
#include "support/catch.hpp"

using namespace sivid;

TEST_CASE("a run that was stopped at once is judged by nothing") {
    diagnosis_run run;
    run.base = small_campaign::problem({});
    judge_by_holdout(run, holdout(run.base.experiments));
    CHECK_FALSE(run.holdout_before);
    CHECK(run.result.causes.empty());
    CHECK_FALSE(run.result.shrink_holdout);
}
