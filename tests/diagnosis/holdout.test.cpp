// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/holdout.hpp>

#include "diagnosis/small_catalogue.hpp"
#include "support/catch.hpp"

#include <concepts>

using namespace sivid;

namespace {
template <class T>
concept shows_experiments = requires(T const& t) {
    t.experiments;
}
|| requires(T const& t) { t.experiments(); };
} // namespace

TEST_CASE("hold-out data have no other way out than a fitted candidate") {
    STATIC_REQUIRE_FALSE(shows_experiments<holdout>);
    STATIC_REQUIRE_FALSE(std::convertible_to<holdout, std::vector<experiment>>);
    STATIC_REQUIRE_FALSE(std::convertible_to<holdout, identification_problem>);
}

TEST_CASE("they are judged with the model and the effects of the candidate") {
    auto const base = small_campaign::problem();
    holdout const kept({small_campaign::experiment(2, {})});
    CHECK_FALSE(kept.empty());
    CHECK(holdout().empty());
    screened fitted;
    fitted.figures.effects = {1};
    auto const p = kept.judged_by(fitted, base, small_campaign::catalogue());
    REQUIRE(p.experiments.size() == 1);
    CHECK(p.experiments[0].name == "E3");
    CHECK(p.choice.unknown == std::vector<std::string>{"k", "slope.a"});
}
