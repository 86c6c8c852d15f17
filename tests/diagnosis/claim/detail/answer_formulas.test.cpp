// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/claim/detail/answer_formulas.hpp>

#include "diagnosis/small_campaign.hpp"
#include "support/catch.hpp"

#include <sivid/model/effects.hpp>

#include <utility>

using namespace sivid;
using namespace sivid::literals;

TEST_CASE("what the answer changes is stated, and nothing where no effect is the answer") {
    diagnosis_run run;
    run.base = small_campaign::problem();
    run.catalogue = {effects::linear_damping("film", "v", {0_dec, 1_dec})};
    screened s;
    s.figures.effects = {0};
    s.problem = run.base;
    run.candidates.push_back(std::move(s));
    run.result.answer = answer_kind::effects;
    state_change(run);
    REQUIRE(run.result.change.lines.size() == 1);
    CHECK(run.result.change.lines[0] == "v' becomes v' - v * k_1");
    CHECK(run.result.change.symbols.at("film.k") == "k_1"); // the cart has a k
    run.result.answer = answer_kind::unexplained;
    state_change(run);
    CHECK(run.result.change.lines.empty());
}
