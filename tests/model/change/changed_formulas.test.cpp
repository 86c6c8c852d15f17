// SPDX-License-Identifier: MIT
#include <sivid/model/change/changed_formulas.hpp>

#include "diagnosis/small_campaign.hpp"
#include "support/catch.hpp"

#include <sivid/model/effects.hpp>
#include <sivid/model/named_effects.hpp>

#include <stdexcept>
#include <string>
#include <vector>

using namespace sivid;
using namespace sivid::literals;
using lines = std::vector<std::string>;

namespace {

lines changed(std::vector<effect> effects) {
    return formulas_of(record_model(small_campaign::cart{}), std::move(effects)).lines;
}
effect named(std::string const& name) { return effects_named({}, {name}).at(0); }

} // namespace

TEST_CASE("terms that a rate gains stand beside the model's own rate") {
    CHECK(changed({}).empty());
    CHECK(changed({effects::quadratic_damping("drag", "v", "1/m", {0_dec, 1_dec})}) ==
          lines{"v' becomes v' - v * k_1 * abs(v)"});
    CHECK(changed({named("v'~2*v^3")}) == lines{"v' becomes v' + k_1 * 2 * v^3"});
    // The rate of p is v: a name would not be shorter.
    CHECK(changed({effects::constant_rate("slip", "p", "m/s", {-1_dec, 1_dec})}) ==
          lines{"p' becomes v + a"});
}

TEST_CASE("inputs, constants and sensors are named as the model sees them") {
    CHECK(changed({effects::input_gain("gain", "u", {-1_dec, 1_dec})}) ==
          lines{"u becomes u * (k_1 + 1)"});
    CHECK(changed({effects::drift("fades", "k", {0_dec, 1_dec})}) ==
          lines{"k becomes k * (t * k_1 + 1)"}); // the model has a k
    CHECK(changed({effects::sensor_bias("offset", "p", "m", {-1_dec, 1_dec})}) ==
          lines{"the sensor p shows p + b"});
    CHECK(changed({effects::input_lag("lag", "u", "N", {0_dec, 1_dec}, 10)}) ==
          lines{"a further state lag.u starts at u, with lag.u' = (u - lag.u) / tau",
                "u becomes lag.u"});
    CHECK(changed({named("sensor_lag(p)~0.5")}) ==
          lines{"a further state sensor_lag.p starts at 0, with sensor_lag.p' = v - sensor_lag.p / "
                "tau",
                "the sensor p shows p - sensor_lag.p"});
}

TEST_CASE("an input and a constant of one name are told apart") {
    auto base = record_model(small_campaign::cart{});
    base.about.constants.push_back({"u", "N", literal{interval(1.0), 1.0}});
    base.about.inputs.push_back({"t", "s"});
    CHECK(formulas_of(base, {effects::input_gain("gain", "u", {-1_dec, 1_dec})}).lines ==
          lines{"u becomes u * (k_1 + 1)"});
}

TEST_CASE("an effect may have the name of what reads the changes") {
    CHECK(changed({effects::input_gain("seen", "u", {-1_dec, 1_dec})}) ==
          lines{"u becomes u * (k_1 + 1)"});
}

TEST_CASE("what is remembered is said in words") {
    CHECK(changed({effects::input_delay("late", "u", {0_dec, 1_dec})}) ==
          lines{"u becomes u at the time t - tau"});
    CHECK(changed({effects::input_clock_drift("slow", "u", {0_dec, 0.5_dec})}) ==
          lines{"u becomes u at the time t - r * (t - begin)"});
    CHECK(changed({named("sensor_latency(p)~0.5")}) ==
          lines{"the sensor p shows what was at the time t - tau"});
    auto const wraps = changed({named("sensor_wrap(p)~2")});
    REQUIRE(wraps.size() == 2);
    CHECK(wraps[0] == "the sensor p shows p - T * sensor_wrap.wraps");
    CHECK_THAT(wraps[1], StartsWith("sensor_wrap.wraps counts how often the readings of p"));
}

TEST_CASE("what an input or a constant has become is called by its name in rates and sensors") {
    effect film;
    film.name = "film";
    film.parameters = {{"f", "1/s", 0_dec, 1_dec, 0_dec}};
    film.on_rates = [](effect_scope& m) {
        m.rate("v") -= m.parameter() * m.state("v") / m.constant("d") + m.input("u");
    };
    // Whoever applies the lines one kind after the other must not change d, or u, twice.
    CHECK(changed({effects::drift("fades", "d", {0_dec, 1_dec}),
                   effects::input_gain("gain", "u", {-1_dec, 1_dec}), film}) ==
          lines{"u becomes u * (k_2 + 1)", "d becomes d * (t * k_1 + 1)",
                "v' becomes v' - (u + v * f / d)"});
}

TEST_CASE("several effects keep their parameters apart, and their times") {
    auto const both = formulas_of(record_model(small_campaign::cart{}),
                                  {effects::quadratic_damping("drag", "v", "1/m", {0_dec, 1_dec}),
                                   effects::linear_damping("film", "v", {0_dec, 1_dec})});
    CHECK(both.symbols.at("drag.k") == "k_1");
    CHECK(both.symbols.at("film.k") == "k_2");
    CHECK(both.lines == lines{"v' becomes v' - v * k_1 * abs(v) - v * k_2"});
    auto const partial = changed({only_within(named("v'~2*v^3"), {"E1", "E2"},
                                              {1.5, effect::from_start}, {effect::for_ever, 3})});
    CHECK(partial == lines{"v' becomes v' + k_1 * 2 * v^3",
                           "v'~2*v^3 acts in E1 from 1.5 s on, E2 until 3 s only"});
}

TEST_CASE("a state that inputs see moves as the rates say that are set behind them") {
    effect filter;
    filter.name = "filter";
    filter.parameters = {{"k", "1/s", 0_dec, 1_dec, 0_dec}};
    filter.on_inputs = [](effect_scope& m) {
        (void)m.add_state("filter.d", "m/s", 9, expression(0));
    };
    filter.on_rates = [](effect_scope& m) {
        m.rate("filter.d") = m.rate("v") - m.state("filter.d") * m.parameter();
    };
    CHECK(changed({filter}) == lines{"a further state filter.d starts at 0, with filter.d' = v' - "
                                     "k_1 * filter.d"});
}

TEST_CASE("what stands in long formulas more than once is a part with a line of its own") {
    effect shared;
    shared.name = "shared";
    shared.parameters = {{"k", "1", 0_dec, 1_dec, 0_dec}};
    shared.on_rates = [](effect_scope& m) {
        auto const s = m.add_state("shared.s", "m", 1, std::nullopt);
        auto term = m.parameter() * m.state("v") + s;
        for (int n = 0; n < 5; ++n) term = sin(term) * term; // 2^5 times the first one
        m.rate("v") += term;
        m.rate("shared.s") = -term;
    };
    auto const all = changed({shared});
    REQUIRE(all.size() == 8);
    CHECK(all[0] == "part_1 = shared.s + v * k_1");
    CHECK(all[1] == "part_2 = part_1 * sin(part_1)");
    CHECK(all[5] == "part_6 = part_5 * sin(part_5)");
    CHECK(all[6] == "a further state shared.s starts anywhere, with shared.s' = -part_6");
    CHECK(all[7] == "v' becomes v' + part_6");
}

TEST_CASE(
    "a formula that nobody would read is not written, and an effect of another model refused") {
    effect endless;
    endless.name = "endless";
    endless.parameters = {{"k", "1", 0_dec, 1_dec, 0_dec}};
    endless.on_rates = [](effect_scope& m) {
        auto term = m.parameter() * m.state("v");
        for (int n = 0; n < 60; ++n) term = sin(term) * term; // shared: 2^60 parts as text
        m.rate("v") += term;
    };
    CHECK(changed({endless}) == lines{"v' becomes something that is too long to be shown"});
    CHECK_THROWS_AS(changed({effects::input_gain("gain", "none", {-1_dec, 1_dec})}),
                    std::invalid_argument);
}
