// SPDX-License-Identifier: MIT
#include "craft.hpp"

#include "io/support.hpp"
#include "support/catch.hpp"

#include <sivid/app/generate.hpp>
#include <sivid/io/dataset/model_names.hpp>

#include <cmath>
#include <set>

using namespace sivid;
using hovercraft_example::built_in_scenarios;

namespace {

app::robot const& craft() {
    static auto const once = hovercraft_example::craft();
    return once;
}
model_names names() { return names_of(craft().model.about); }

char const* const good = R"({
  "format": "hovercraft-scenario-1", "name": "mine", "duration": 2,
  "initial": { "u": [0.9, 1.1], "v": 0, "r": 0, "x": 0, "y": 0, "psi": 0 },
  "inputs": { "W": { "shape": "ramp", "from": 10, "to": 30, "begin": 0.5, "end": 1 },
              "delta": { "shape": "samples", "t": [0, 1], "values": [0, 0.2] } } })";

scenario_description parsed(std::string const& text) {
    auto const model = names();
    return parse_scenario("s.json", text, model);
}

} // namespace

TEST_CASE("every bundled scenario is built in under its file's name") {
    auto const model = names();
    std::set<std::string> built_in;
    for (auto const& s : built_in_scenarios()) {
        auto const found = app::find_scenarios(craft(), s.name);
        REQUIRE(found.size() == 1);
        CHECK(found[0].name == s.name);
        CHECK_FALSE(found[0].about.empty());
        built_in.insert(found[0].name);
    }
    namespace fs = std::filesystem;
    fs::path const folder = fs::path{SIVID_SOURCE_DIR} / "examples/hovercraft/scenarios";
    for (auto const& file : fs::directory_iterator{folder}) {
        auto const s = read_scenario(file.path(), model);
        CHECK(s.name == file.path().stem());
        CHECK(built_in.erase(s.name) == 1);
    }
    CHECK(built_in.empty());
}

TEST_CASE("'all' is Table 2.4") {
    auto const all = app::find_scenarios(craft(), "all");
    REQUIRE(all.size() == 3);
    CHECK(all[0].duration == 1);
    CHECK(all[1].duration == 10);
    CHECK(all[2].duration == 3);
    CHECK(all[0].inputs[0](0.3) == 250);
    CHECK(all[1].inputs[0](0.3) == 0);
    for (double const t : {0.0, 0.4, 1.7, 3.0})
        CHECK_THAT(
            all[2].inputs[1](t),
            WithinAbs(std::acos(-1.0) / 12 * (1 + std::sin(std::acos(-1.0) * t / 2)), 1e-15));
}

TEST_CASE("shapes, as numbers and as exact signals") {
    auto const s = parsed(good);
    CHECK_THAT(mid(s.initial[0].enclosure), WithinAbs(1.0, 1e-15));
    CHECK(s.inputs[0](0) == 10);
    CHECK(s.inputs[0](0.75) == 20);
    CHECK(s.inputs[0](5) == 30);
    CHECK(s.inputs[1](0.5) == 0.1);
    CHECK(s.inputs[1](1.5) == 0.2);
    for (auto const& input : s.inputs) {
        auto const exact = std::get<sivid::sampled_signal>(exact_signal(input, 2));
        for (double const t : {0.0, 0.3, 0.6, 0.99, 1.5, 2.0})
            CHECK_THAT(exact.approximate(t), WithinAbs(input(t), 1e-12));
    }
}

TEST_CASE("a defect of a scenario file is named with its place") {
    struct defect {
        std::string from, to, place, message;
    };
    for (auto const& d : std::vector<defect>{
             {"hovercraft-scenario-1", "other", "/format", "unknown format"},
             {"\"duration\": 2", "\"duration\": 0", "/duration", "not above 0"},
             {"\"name\": \"mine\"", "\"name\": \"a/b\"", "/name", "file name"},
             {"\"ramp\"", "\"step\"", "/inputs/W/shape", "constant, sine, ramp, samples"},
             {"\"end\": 1", "\"end\": 0.5", "/inputs/W/end", "before it begins"},
             {"[0, 0.2]", "[0]", "/inputs/delta", "as many values"},
             {"\"t\": [0, 1]", "\"t\": [1, 1]", "/inputs/delta/t", "do not increase"},
             {"[0.9, 1.1]", "[1.1, 0.9]", "/initial/u", "lower is above upper"},
             {"\"psi\": 0", "\"phi\": 0", "/initial/phi", "unknown name 'phi'"},
             {", \"psi\": 0", "", "/initial", "'psi' is missing"},
             {"\"W\":", "\"Z\":", "/inputs/Z", "unknown name 'Z'"}}) {
        std::string text = good;
        auto const at = text.find(d.from);
        REQUIRE(at != std::string::npos);
        text.replace(at, d.from.size(), d.to);
        INFO(text);
        try {
            (void)parsed(text);
            FAIL("accepted");
        } catch (sivid::input_error const& e) {
            CHECK(e.place().pointer == d.place);
            CHECK_THAT(e.what(), ContainsSubstring(d.message));
        }
    }
    CHECK_THROWS_WITH(app::find_scenarios(craft(), "S9"), ContainsSubstring("one of: all, "));
}
