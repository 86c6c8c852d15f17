// SPDX-License-Identifier: MIT
#include <sivid/io/scenario.hpp>

#include "io/small_identification.hpp"
#include "io/support.hpp"
#include "support/catch.hpp"

#include <sivid/io/input_error.hpp>

#include <cmath>
#include <cstddef>
#include <string>
#include <variant>

namespace {

sivid::scenario_description parsed(std::string const& text) {
    auto const names = sivid::names_of(sivid::record_model(io_support::two_rates{}).about);
    return sivid::parse_scenario("s.json", text, names);
}

} // namespace

TEST_CASE("a scenario of any model is read") {
    auto const s = parsed(R"({"format": "sivid-scenario-1", "name": "rest", "duration": 2.5,
                              "initial": {"x": [0.9, 1.1]}, "inputs": {}})");
    CHECK(s.duration == 2.5);
    CHECK(s.initial[0].enclosure.lower() <= 0.9);
    CHECK(s.initial[0].enclosure.upper() >= 1.1);
    CHECK(s.inputs.empty());
}

TEST_CASE("a scenario that is written reads back as the same") {
    sivid::model_names names;
    names.states = {{"x", "m"}, {"y", "m"}};
    names.inputs = {{"a", "1"}, {"b", "1"}, {"c", "1"}, {"d", "1"}};
    std::string const text =
        R"({"format": "sivid-scenario-1", "name": "S", "about": "all \"shapes\"",
        "duration": 2.5, "initial": {"x": [0.9, 1.1], "y": 0.1}, "inputs": {
        "a": {"shape": "constant", "value": 0.1},
        "b": {"shape": "sine", "offset": 1, "amplitude": 2, "frequency": 0.3, "phase": -1},
        "c": {"shape": "ramp", "from": 0, "to": 0.7, "begin": 0.1, "end": 1},
        "d": {"shape": "samples", "t": [0, 0.1, 2], "values": [1, 0.3333333333333333, -1e-300]}}})";
    auto const first = sivid::parse_scenario("s.json", text, names);
    auto const again = sivid::parse_scenario("t.json", sivid::scenario_json(first, names), names);
    CHECK(again.name == first.name);
    CHECK(again.about == first.about);
    CHECK(again.duration == first.duration);
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(again.initial[i].enclosure.lower() == first.initial[i].enclosure.lower());
        CHECK(again.initial[i].enclosure.upper() == first.initial[i].enclosure.upper());
    }
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(again.inputs[i].shape == first.inputs[i].shape);
        CHECK(again.inputs[i].times == first.inputs[i].times);
        CHECK(again.inputs[i].values == first.inputs[i].values);
        for (double const t : {0.0, 0.05, 0.7, 1.3, 2.5})
            CHECK(again.inputs[i](t) == first.inputs[i](t));
    }
}

TEST_CASE("what is wrong with a scenario is said") {
    CHECK_THROWS_WITH(parsed(R"({"format": "other", "name": "a", "duration": 1, "initial": {"x": 1},
                                 "inputs": {}})"),
                      ContainsSubstring("sivid-scenario-1"));
    CHECK_THROWS_WITH(parsed(R"({"format": "sivid-scenario-1", "name": "a", "duration": 0,
                                 "initial": {"x": 1}, "inputs": {}})"),
                      ContainsSubstring("not above 0"));
    CHECK_THROWS_AS(parsed("{"), sivid::input_error);
}

TEST_CASE("shapes are exact signals") {
    sivid::input_shape s;
    s.shape = sivid::input_shape::kind::ramp;
    s.from = 1;
    s.to = 3;
    s.begin = 0.5;
    s.end = 1.5;
    auto const ramp = std::get<sivid::sampled_signal>(sivid::exact_signal(s, 2));
    for (double const t : {0.0, 0.5, 1.0, 1.5, 2.0}) CHECK(ramp.approximate(t) == s(t));
    s.shape = sivid::input_shape::kind::sine;
    s.frequency = 1;
    auto const sine = std::get<sivid::analytic_signal>(sivid::exact_signal(s, 2));
    bool rounded = true; // 2 pi is no double: 6.28318530717958647692...
    for (auto const& n : sine.g.nodes()) {
        if (n.op != sivid::operation::literal) continue;
        auto const& value = sine.g.value(n).enclosure;
        rounded = rounded &&
                  !(value.lower() <= 0x1.921fb54442d18p2 && value.upper() >= 0x1.921fb54442d19p2);
    }
    CHECK_FALSE(rounded);
}
