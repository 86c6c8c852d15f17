// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/verification.hpp>

#include "diagnosis/small_catalogue.hpp"
#include "support/catch.hpp"

using namespace sivid;
using namespace sivid::literals;

TEST_CASE("the truth is verified, also of models with delays and lags") {
    auto const catalogue = small_campaign::catalogue();
    auto const check = [&](small_campaign::truth const& real, effect const& e, double parameter) {
        auto const p = affected(small_campaign::problem(real), {e});
        approximate_fit guess;
        guess.parameters = {real.k, parameter};
        for (auto const& x : p.experiments) guess.starts.push_back(mid(x.initial));
        auto const v = verify_at(p, guess);
        INFO(e.name);
        CHECK(v.range.upper() <= 0.62); // the deviations fill 60 % of the bounds
        CHECK(v.range.lower() > 0.55);
        REQUIRE(v.witness);
        CHECK(v.witness->parameters == guess.parameters);
        return v;
    };
    (void)check(small_campaign::with_drag(0.25), catalogue[0], 0.25);
    (void)check(small_campaign::with_slope(0.25), catalogue[1], 0.25);
    auto const late = check(small_campaign::with_delay(0.25), catalogue[3], 0.25);
    CHECK(late.assumptions.size() == 1);
}

TEST_CASE("what does not explain is not verified") {
    auto const p = affected(small_campaign::problem(small_campaign::with_drag(0.25)), {});
    approximate_fit guess;
    guess.parameters = {1.0};
    for (auto const& x : p.experiments) guess.starts.push_back(mid(x.initial));
    CHECK(verify_at(p, guess).range.lower() > 1);
    CHECK(verify_at(p, {}).range.upper() == std::numeric_limits<double>::infinity());
}

TEST_CASE("where no validated run gets to the end there is no witness") {
    auto const p = affected(small_campaign::problem(), {});
    approximate_fit guess;
    guess.parameters = {1.0};
    for (auto const& x : p.experiments) guess.starts.push_back(mid(x.initial));
    CHECK(verify_at(p, guess).witness);
    feasibility_test_options brief;
    brief.witness.maximum_steps = 1;
    auto const v = verify_at(p, guess, brief);
    CHECK(v.range.upper() == std::numeric_limits<double>::infinity());
    CHECK_FALSE(v.witness);
}

TEST_CASE("a problem in which only the delay is unknown can be verified") {
    auto base = small_campaign::problem(small_campaign::with_delay(0.25));
    auto p = affected(base, {small_campaign::catalogue()[3]});
    p.choice.fixed["k"] = interval(1.0);
    p.choice.unknown = {"late.tau"};
    p.prior = box{interval(0.0, 0.5)};
    approximate_fit guess;
    guess.parameters = {0.25};
    for (auto const& x : p.experiments) guess.starts.push_back(mid(x.initial));
    CHECK(verify_at(p, guess).range.upper() <= 0.62);
}

TEST_CASE("starts of lags follow the parameters") {
    auto const lag = effects::input_lag("lag", "u", "N", {0.1_dec, 1_dec}, 5);
    auto const band = effects::input_dead_band("band", "u", "N", {0_dec, 0.25_dec});
    auto const p = affected(small_campaign::problem(), {lag, band});
    approximate_fit guess;
    guess.parameters = {1.0, 0.5, 0.125};
    for (auto const& x : p.experiments) guess.starts.push_back(mid(x.initial));
    auto const v = verify_at(p, guess);
    REQUIRE(v.witness);
    CHECK(v.witness->starts[0][2] == 0.875);
}
