// SPDX-License-Identifier: MIT
#include "rank.hpp"

#include "support/catch.hpp"

#include <cmath>

using namespace hovercraft_example;

TEST_CASE("Table 2.2 with proof: what occurs, and how strongly") {
    auto const ranking = rank_constants(sivid::record_model(hovercraft{}));
    REQUIRE(ranking.size() == 6);
    auto const effect = [&](std::string const& state, std::string const& constant) {
        for (auto const& e : ranking)
            for (auto const& p : e.effects)
                if (e.state == state && p.constant == constant) return p;
        FAIL("no such effect");
        return ranking[0].effects[0];
    };
    // Where the report errs: neither occurs there.
    CHECK_FALSE(effect("u", "Sv").occurs);
    CHECK_FALSE(effect("r", "D22").occurs);
    CHECK(effect("v", "Sv").occurs);
    CHECK(effect("v", "D22").occurs);
    CHECK(effect("r", "L").occurs);
    CHECK(effect("r", "Sg").occurs);
    for (auto const* state : {"x", "y", "psi"})
        for (auto const* constant : {"m", "Sv", "Sg", "L"})
            CHECK_FALSE(effect(state, constant).occurs);

    for (auto const& e : ranking) {
        for (std::size_t k = 0; k < e.effects.size(); ++k) {
            auto const& p = e.effects[k];
            CHECK(p.effect.lower() <= p.effect.upper());
            CHECK(p.occurs == (p.effect.upper() > 0));
            if (k > 0) CHECK(p.effect.upper() <= e.effects[k - 1].effect.upper());
        }
    }
    CHECK(ranking[2].unit == "rad/s^2");
    CHECK(ranking[2].effects[0].constant == "Sg");

    // By hand: d r'/d L = -CL Sg F delta/(4 A Iz), d u'/d D11 = -u/m, at their extremes.
    double const thrust =
        1.1 * 0.1339 * 1.1 * 1.225 * std::pow(1.1 * 0.18, 4) * 83.333333 * 83.333333;
    double const arm =
        0.1 * 1.1 * 1.891 * 0.0754 * thrust * 0.5236 / (4 * 0.9 * 0.025447 * 0.9 * 0.058);
    CHECK(effect("r", "L").effect.lower() <= arm * (1 + 1e-9));
    CHECK(arm * (1 - 1e-9) <= effect("r", "L").effect.upper());
    CHECK_THAT(effect("r", "L").effect.upper(), WithinRel(arm, 0.01));
    CHECK_THAT(effect("u", "D11").effect.upper(), WithinRel(0.1 * 3 / (0.9 * 1.297), 1e-6));
    CHECK_THAT(effect("u", "D11").effect.lower(), WithinRel(0.1 * 3 / (0.9 * 1.297), 1e-6));
}
