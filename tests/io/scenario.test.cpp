// SPDX-License-Identifier: MIT
#include <sivid/io/scenario.hpp>

#include "io/small_identification.hpp"
#include "io/support.hpp"
#include "support/catch.hpp"

#include <sivid/io/input_error.hpp>

#include <cmath>
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
