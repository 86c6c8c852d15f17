// SPDX-License-Identifier: MIT
// Catalogues that are written otherwise than most: channels and experiments that stand twice,
// names that are taken, effects that cannot be joined or start where others say, priors that reach
// too far. The truth stays, or the catalogue is refused.
#include <sivid/diagnosis/diagnose.hpp>
#include <sivid/diagnosis/identify_remembering.hpp>
#include <sivid/diagnosis/verification.hpp>
#include <sivid/model/affected_problem.hpp>

#include "diagnosis/late_position.hpp"
#include "diagnosis/small_campaign.hpp"
#include "support/catch.hpp"

#include <sivid/approximate/candidate/screening.hpp>
#include <sivid/diagnosis/candidate/detail/effect_hulls.hpp>
#include <sivid/diagnosis/candidate/detail/episode_hulls.hpp>
#include <sivid/diagnosis/gap/detail/part_inflation.hpp>
#include <sivid/model/effects.hpp>
#include <sivid/model/named_effects.hpp>
#include <sivid/paving/identify.hpp>
#include <sivid/paving/inflation.hpp>
#include <sivid/paving/relation/detail/broken_relation.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

using namespace sivid;
using namespace sivid::literals;

namespace {

/// A lag of half a second that sees the input with an offset, and so begins at u(0) + d0.
std::vector<effect> lag_and_trim() {
    auto trim = effects::input_trim("trim", "u", "N", {-0.8_dec, 0.8_dec});
    trim.order = 1;
    return {effects::input_lag("lag", "u", "N", {0.45_dec, 0.55_dec}, 5), trim};
}
/// Such a lag that begins so far from u(0), and an offset.
small_campaign::truth lagged_from(double off, double d0) {
    small_campaign::truth real;
    real.lag = 0.5;
    real.missing = [off, d0](double t, double, double) {
        double const left = std::exp(-t / 0.5);
        return off * left + d0 * (1 - left);
    };
    return real;
}
approximate_fit at_point(identification_problem const& p, std::vector<double> parameters) {
    approximate_fit at;
    at.parameters = std::move(parameters);
    for (auto const& x : p.experiments) at.starts.push_back(mid(x.initial));
    return at;
}
std::size_t inside(identification const& found) { return found.paving.count(box_verdict::inside); }

} // namespace

TEST_CASE("a sensor that is late twice by one parameter is late by twice as much") {
    auto const base = diagnosis_support::with_late_position(300);
    auto const e = effects::sensor_latency("late", {"p", "p"}, {0_dec, 0.5_dec});
    auto const whole = affected(base, {e});
    REQUIRE(verify_at(whole, at_point(whole, {1, 0.15})).range.upper() <= 1);
    CHECK(contains(effect_hulls(base, {e}, {.seconds = 20}).parameters[1], 0.15));
    auto const some = only_within(e, {"E1", "E2"}, {0.01, 0.01});
    CHECK(contains(hulls_of_episodes(base, some, {.seconds = 20}).parameters[1], 0.15));
}

TEST_CASE("states that effects added start where their parameters say, and nowhere else") {
    // It begins at 0.3, which no parameter says: an offset of -0.7 would be seen ever after.
    auto const apart = affected(small_campaign::problem(lagged_from(-0.7, 0)), lag_and_trim());
    REQUIRE(starts_follow_parameters(apart));
    identify_options options;
    options.search.seconds = 10;
    auto const found = identify(apart, options);
    CHECK_FALSE(found.witness);
    CHECK(inside(found) == 0);
    CHECK(found.verdict != verdict::consistent);
    auto const bound = bound_inflation(apart, nullptr, {.seconds = 5});
    CHECK(bound.value.upper() > 2);
    REQUIRE(bound.witness);
    auto at = at_point(apart, bound.witness->parameters);
    auto const there = verify_at(apart, at).range;
    CHECK(there.lower() <= bound.value.upper() * (1 + 1e-6));
    CHECK(there.upper() >= bound.value.upper() * (1 - 1e-6));
    auto const next = [](std::string const&) { return true; };
    for (auto const& part :
         inflation_of_experiments(apart, unknown_inflation(), {.seconds = 3}, next))
        CHECK(part.hull->upper() > 2);

    auto const follows = affected(small_campaign::problem(lagged_from(0.3, 0.3)), lag_and_trim());
    REQUIRE(verify_at(follows, at_point(follows, {1, 0.5, 0.3})).range.upper() <= 1);
    CHECK(bound_inflation(follows, nullptr, {.seconds = 5}).value.lower() <= 1);
    auto const kept = identify(follows, options);
    CHECK(contains(kept.hull, std::vector<double>{1, 0.5, 0.3}));
    REQUIRE(kept.witness);
    CHECK(verify_at(follows, at_point(follows, kept.witness->parameters)).range.upper() <= 1);
    for (auto const& b : kept.paving.boxes()) {
        if (b.verdict != box_verdict::inside) continue;
        CHECK(verify_at(follows, at_point(follows, mid(b.set))).range.upper() <= 1);
    }
}

TEST_CASE("effects have names of their own") {
    auto const base = small_campaign::problem();
    auto one = effects::constant_rate("gust", "v", "m/s2", {-1_dec, 1_dec});
    auto two = effects::linear_damping("gust", "v", {0_dec, 1_dec});
    one.only_in = {"E1"};
    two.only_in = {"E2"};
    CHECK_THROWS_WITH(affected(base, {one, two}),
                      ContainsSubstring("two effects are called 'gust'"));
    CHECK_THROWS_WITH(diagnose(base, {one, two}),
                      ContainsSubstring("two effects are called 'gust'"));
    one.name = "u"; // its switch would be the input
    CHECK_THROWS_WITH(affected(base, {one}), ContainsSubstring("two inputs are called 'u'"));
    CHECK_THROWS_WITH(diagnose(base, {one}), ContainsSubstring("two inputs are called 'u'"));
}

TEST_CASE("an effect begins and ends once in an experiment") {
    auto const gust = effects::constant_rate("gust", "v", "m/s2", {-1_dec, 1_dec});
    CHECK_THROWS_WITH(effects_named({gust}, {"gust@E1>=0.5<1+E1>=2<3"}),
                      ContainsSubstring("the experiment 'E1' stands twice"));
    auto twice = gust;
    twice.only_in = {"E1", "E2", "E1"};
    CHECK_NOTHROW(affected(small_campaign::problem(), {twice})); // it says so twice
    twice.since = {0.5, 1, 2};
    CHECK_THROWS_WITH(affected(small_campaign::problem(), {twice}),
                      ContainsSubstring("the experiment 'E1' stands twice"));
}

TEST_CASE("experiments need all inputs and states of the model") {
    auto p = small_campaign::problem();
    p.experiments[1].inputs.clear();
    auto const refused = [](auto const& asked) {
        CHECK_THROWS_WITH(asked(), ContainsSubstring("experiment 'E2'") &&
                                       ContainsSubstring("has 1 inputs, but 0 signals were given"));
    };
    auto const lag = effects::input_lag("lag", "u", "N", {0.1_dec, 1_dec}, 5);
    refused([&] { p.require_valid(); });
    refused([&] { (void)find_broken_relations(p); });
    refused([&] { (void)diagnose(p, {}); });
    refused([&] { (void)affected(p, {lag}); });
    refused([&] { (void)identify_remembering(p, {lag}, {}); });
    p = small_campaign::problem();
    p.experiments[1].initial = box{interval(0.0)}; // the lag's start is no substitute
    CHECK_THROWS_WITH(affected(p, {lag}), ContainsSubstring("needs one side per state"));
}

TEST_CASE("equations of a campaign have names of their own") {
    auto p = small_campaign::problem();
    p.model.about.states[0].equation = "v";
    CHECK_NOTHROW(p.require_valid());
    CHECK_THROWS_WITH(p.require_valid_campaign(),
                      ContainsSubstring("two equations are called 'v'"));
}

TEST_CASE("a lag begins behind another lag, and effects that cannot be joined are left out") {
    auto const base = small_campaign::problem();
    auto const servo = effects::input_lag("servo", "u", "N", {0_dec, 0.1_dec}, 5);
    auto const amplifier = effects::input_lag("amplifier", "u", "N", {0_dec, 0.05_dec}, 5);
    auto const both = affected(base, {servo, amplifier});
    for (std::size_t const state : {2U, 3U}) {
        CHECK(contains(both.experiments[0].initial[state], small_campaign::input(0, 0)));
        CHECK(width(both.experiments[0].initial[state]) == 0);
    }
    auto const behind = affected(affected(base, {servo}), {amplifier}); // that begins at u, too
    CHECK(contains(behind.experiments[0].initial[3], small_campaign::input(0, 0)));

    effect motor; // its torque falls with the speed: a lag would begin at what a state says
    motor.name = "motor";
    motor.parameters = {{"k", "1", 0_dec, 0.01_dec, 0_dec}};
    motor.on_inputs = [](effect_scope& m) { m.input("u") *= 1 - m.parameter() * m.state("v"); };
    screening tried(base, {motor, servo, effects::sensor_bias("bias", "p", "m", {0_dec, 1_dec})},
                    {.always_pairs = true});
    REQUIRE_NOTHROW(tried.run());
    CHECK(tried.find({0, 1}) == nullptr);
    CHECK(tried.find({0, 2}) != nullptr);
    CHECK(tried.counts().complete());
    motor.on_inputs = [](effect_scope& m) { (void)m.input("w"); };
    CHECK_THROWS_AS(screening(base, {motor}).run(), std::invalid_argument);
}

TEST_CASE("sizes that mean nothing are refused, or not sliced") {
    auto const hulls_of = [](small_campaign::truth const& real, effect const& e, double size) {
        auto const base = small_campaign::problem(real);
        auto const hull = effect_hulls(base, {e}, {.seconds = 5}).parameters;
        CHECK(contains(hull[1], size));
    };
    auto const refused = [](effect const& e) {
        CHECK_THROWS_AS(affected(small_campaign::problem({}), {e}), std::invalid_argument);
    };
    small_campaign::truth limited;
    limited.limit = 0.5;
    auto limit = effects::input_rate_limit("limit", "u", "N/s", {0.1_dec, 3_dec});
    limit.parameters[0].lower = 0_dec;
    hulls_of(limited, limit, 0.5);
    refused(effects::input_backlash("loose", "u", "N", {-0.1_dec, 0.5_dec}));
    refused(effects::input_delay("late", "u", {-0.1_dec, 0.5_dec}));
}

TEST_CASE("what was identified with wrapped readings says what their counts rest on") {
    auto const base = diagnosis_support::with_late_position(100);
    auto const wrap = effects::sensor_wrap("wrap", "p", "m", {9_dec, 11_dec}, 5);
    auto const late = effects::sensor_latency("late", {"p"}, {0_dec, 0.5_dec});
    auto const found = identify_remembering(base, {wrap, late}, {.seconds = 1});
    auto const says = [](std::string const& a) {
        return a.find("p has wrapped as often") != std::string::npos;
    };
    CHECK(std::count_if(found.assumptions.begin(), found.assumptions.end(), says) == 1);
}

TEST_CASE("no effect changes the delay of another one") {
    auto const base = small_campaign::problem();
    effect longer;
    longer.name = "longer";
    longer.parameters = {{"c", "1", 0_dec, 2_dec, 0_dec}};
    longer.on_inputs = [](effect_scope& m) { m.constant("late.tau") *= 1 + m.parameter(); };
    for (auto const& late : {effects::input_delay("late", "u", {0_dec, 0.3_dec}),
                             effects::sensor_latency("late", {"p"}, {0_dec, 0.3_dec})}) {
        CHECK_THROWS_WITH(affected(base, {late, longer}),
                          ContainsSubstring("'late.tau' is a delay or a play"));
        CHECK_NOTHROW(affected(base, {only_within(late, {"E1"}), only_within(late, {"E2"}, {1})}));
    }
}
