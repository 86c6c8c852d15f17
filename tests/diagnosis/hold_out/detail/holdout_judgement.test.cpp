// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/hold_out/detail/holdout_judgement.hpp>

#include "diagnosis/small_catalogue.hpp"
#include "support/catch.hpp"

#include <sivid/approximate/candidate/screening.hpp>
#include <sivid/diagnosis/verification.hpp>

#include <cmath>

using namespace sivid;

namespace {

holdout_judgement judged(small_campaign::truth const& real, std::vector<std::size_t> effects,
                         verified_inflation* bound_of_fit = nullptr) {
    auto const base = small_campaign::problem(real);
    auto const catalogue = small_campaign::catalogue();
    screening s(base, catalogue);
    s.try_one(effects);
    auto const& fitted = s.candidates().front();
    auto bound = verify_at(fitted.problem, fitted.fit);
    if (!fitted.problem.model.has_memory()) {
        auto const proved = bound_inflation(fitted.problem, &fitted.fit);
        bound = {proved.value, proved.witness, {}, proved.hull};
    }
    if (bound_of_fit != nullptr) *bound_of_fit = bound;
    holdout const kept({small_campaign::experiment(2, real)});
    inflation_options search;
    search.seconds = 2;
    return judge_by_holdout(fitted, bound, {}, kept.judged_by(fitted, base, catalogue), {}, search);
}

} // namespace

TEST_CASE("an effect that is the truth does well on held-out data") {
    auto const real = small_campaign::with_drag(0.3);
    auto const before = judged(real, {});
    auto const after = judged(real, {0});
    CHECK(before.at_witness.lower() > 1.5);
    CHECK(after.at_witness.upper() <= 1);
    CHECK(after.rmse.size() == 2);
    CHECK(after.rmse[0] < 0.5 * before.rmse[0]);
    REQUIRE(before.over_fits);
    CHECK(before.over_fits->upper() >= before.at_witness.lower());
    CHECK(after.covered == 1);
    CHECK(after.width > 0);
    CHECK(std::isfinite(after.width)); // of all parameters that fit as well: a box around a line
    CHECK(after.run.residuals.size() == 1);
}

TEST_CASE("models with delays are judged at their witness") {
    auto const real = small_campaign::with_delay(0.2);
    auto const after = judged(real, {3});
    CHECK(after.at_witness.upper() <= 1);
    CHECK_FALSE(after.over_fits);
    CHECK(std::isnan(after.covered));
}
