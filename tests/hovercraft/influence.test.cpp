// SPDX-License-Identifier: MIT
#include "influence.hpp"
#include "model.hpp"

#include "support/catch.hpp"

#include <cmath>

using namespace hovercraft_example;

namespace {

partial_effect effect_in(std::vector<ranked_equation> const& ranking, std::string const& state,
                         std::string const& constant) {
    for (auto const& e : ranking)
        for (auto const& p : e.effects)
            if (e.state == state && p.constant == constant) return p;
    FAIL("no effect of " << constant << " in " << state);
    return ranking[0].effects[0];
}

/// Everything that multiplies a constant's part of the rudder's moment, at its largest: without
/// D^4/A and L, for W = 83.333333 and the priors of the ranking.
double const moment = 1.1 * 1.891 * 0.0754 * 1.1 * 0.1339 * 1.1 * 1.225 * 83.333333 * 83.333333 *
                      0.5236 / (4 * 0.9 * 0.058);
double const pi = std::acos(-1.0), widest = 1.1 * 0.18;

} // namespace

TEST_CASE("Table 2.2 with proof: what occurs, and how strongly") {
    auto const ranking = rank_constants(sivid::record_model(hovercraft{}));
    REQUIRE(ranking.size() == 6);
    auto const effect = [&](std::string const& state, std::string const& constant) {
        return effect_in(ranking, state, constant);
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

    // By hand: d r'/d L = -CL Sg F delta/(4 A Iz) with F/A ~ D^2, d u'/d D11 = -u/m, at their
    // extremes.
    double const arm = 0.1 * moment * 4 / pi * widest * widest;
    CHECK(effect("r", "L").effect.lower() <= arm * (1 + 1e-9));
    CHECK(arm * (1 - 1e-9) <= effect("r", "L").effect.upper());
    CHECK_THAT(effect("r", "L").effect.upper(), WithinRel(arm, 0.01));
    CHECK_THAT(effect("u", "D11").effect.upper(), WithinRel(0.1 * 3 / (0.9 * 1.297), 1e-6));
    CHECK_THAT(effect("u", "D11").effect.lower(), WithinRel(0.1 * 3 / (0.9 * 1.297), 1e-6));
}

TEST_CASE(
    "A = pi D^2/4: the effects of D contain its own, and A is ranked only where it is freed") {
    auto const model = sivid::record_model(hovercraft{});
    auto const bound = rank_constants(model);
    for (auto const& e : bound)
        for (auto const& p : e.effects) CHECK(p.constant != "A");
    // r' ~ D^4/A = (4/pi) D^2.
    double const with_relation = 0.036 * 0.35 * moment * 4 / pi * 2 * widest;
    CHECK_THAT(with_relation, WithinAbs(3.44, 0.005));
    auto const d = effect_in(bound, "r", "D").effect;
    CHECK(d.lower() <= with_relation * (1 + 1e-9));
    CHECK(with_relation * (1 - 1e-9) <= d.upper());
    CHECK_THAT(d.lower(), WithinRel(with_relation, 1e-3));
    CHECK_THAT(d.upper(), WithinRel(with_relation, 5e-3));
    // Elsewhere the bounds are not looser than those of independent constants.
    CHECK(effect_in(bound, "u", "D").effect.upper() < 1.33);
    CHECK(effect_in(bound, "v", "m").effect.upper() < 1.6);

    auto const freed = rank_constants(model, default_ranges(), {"A"});
    double const least = 0.9 * 0.025447;
    CHECK_THAT(effect_in(freed, "r", "D").effect.upper(),
               WithinRel(0.036 * 0.35 * moment * 4 * std::pow(widest, 3) / least, 5e-3));
    CHECK_THAT(effect_in(freed, "r", "D").effect.upper(), WithinAbs(9.26, 0.02));
    CHECK(effect_in(freed, "r", "A").occurs);
    CHECK_THROWS_AS(rank_constants(model, default_ranges(), {"D"}), std::invalid_argument);
    CHECK_THROWS_AS(rank_constants(model, default_ranges(), {"Q"}), std::invalid_argument);
}
