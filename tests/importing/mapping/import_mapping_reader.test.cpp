// SPDX-License-Identifier: MIT
#include <sivid/importing/mapping/import_mapping_reader.hpp>

#include "io/import_support.hpp"

using namespace sivid;
using io_support::replaced;
using io_support::temporary_folder;

namespace {

import_mapping read(std::string_view text) {
    temporary_folder const folder;
    folder.write("mapping.json", text);
    return read_import_mapping(folder.path() / "mapping.json");
}
std::string refused(std::string_view from, std::string_view to) {
    try {
        (void)read(replaced(io_support::csv_mapping, from, to));
    } catch (input_error const& e) {
        CHECK_FALSE(e.remedy().empty());
        CHECK(e.place().is_json);
        return e.place().pointer + ": " + e.problem();
    }
    return "no error";
}

} // namespace

TEST_CASE("a mapping is read") {
    auto const m = read(io_support::csv_mapping);
    CHECK(m.id == "small");
    CHECK(m.model == "tank");
    CHECK(m.parameters.size() == 1);
    CHECK(m.fixed.size() == 1);
    REQUIRE(m.scenarios.size() == 1);
    auto const& s = m.scenarios[0];
    CHECK(s.name == "A");
    CHECK(s.role == scenario_role::fit);
    CHECK(s.file == m.file.parent_path() / "a.csv");
    CHECK(s.between == interpolation::linear);
    CHECK(s.inputs.size() == 1);
    CHECK(s.channels.size() == 1);
    CHECK(s.initial.size() == 1);
    CHECK_FALSE(s.duration);
}

TEST_CASE("defaults stand for what a scenario leaves out") {
    auto const m = read(R"({
  "format": "sivid-mapping-1", "id": "d", "model": "tank",
  "parameters": { "k": {"prior": [0.1, 0.2], "unit": "1/s"} }, "max_outlier_fraction": 0.05,
  "defaults": { "role": "fit", "source": { "kind": "csv", "separator": ";" }, "duration": 2,
    "time": { "column": 1, "unit": "s", "offset": 0 }, "interpolation": "hold",
    "inputs": {}, "channels": { "h": { "column": 2, "error": 1 } }, "initial": {} },
  "scenarios": [ { "name": "A", "file": "a.csv" },
                 { "name": "B", "file": "/b.csv", "role": "holdout", "duration": 3,
                   "source": { "kind": "csv" } } ] })");
    REQUIRE(m.scenarios.size() == 2);
    CHECK(m.scenarios[0].form.separator == ';');
    CHECK(m.scenarios[0].between == interpolation::hold);
    CHECK(*m.scenarios[0].duration == io_support::dec("2"));
    CHECK(m.scenarios[1].role == scenario_role::holdout);
    CHECK(m.scenarios[1].form.separator == ',');
    CHECK(*m.scenarios[1].duration == io_support::dec("3"));
    CHECK(m.scenarios[1].file == "/b.csv");
}

TEST_CASE("defects are refused at their place") {
    auto const has = [](std::string_view from, std::string_view to, std::string const& message) {
        CAPTURE(to);
        CHECK_THAT(refused(from, to), ContainsSubstring(message));
    };
    has("sivid-mapping-1", "sivid-mapping-2", "/format: unknown format");
    has("\"id\"", "\"extra\": 1, \"id\"", "/extra: unknown key");
    has("[0.1, 0.2]", "[0.2, 0.1]", "/parameters/k/prior: lower is above upper");
    has("{ \"k\": {\"prior\": [0.1, 0.2], \"unit\": \"1/s\"} }", "{}", "no parameter is unknown");
    has("\"g\": 9.81", "\"k\": 1", "fixed and a parameter");
    has("\"max_outlier_fraction\": 0", "\"max_outlier_fraction\": 1", "outside [0, 1)");
    CHECK(refused("\"role\": \"fit\", ", "") == "no error"); // fit unless stated
    has("\"fit\"", "\"holdout\"", "no scenario has the role fit");
    has("\"name\": \"A\"", "\"name\": \"A/B\"", "/scenarios/0/name");
    has("\"linear\"", "\"cubic\"", "/scenarios/0/interpolation");
    has("\"u\": {", "\"u v\": {", "cannot stand in a table");
    has("{ \"h\": { \"column\": \"level\", \"factor\": 0.01, \"error\": 0.02 } }", "{}",
        "/scenarios/0/channels: no channel is measured");
    has("\"h\": { \"column\"", "\"h_err\": { \"column\": 1, \"error\": 1 }, \"h\": { \"column\"",
        "cannot be told apart");
    has("\"interpolation\"", "\"duration\": 0, \"interpolation\"", "the duration is not above 0");
    has(", \"offset\": 0", "", "a key is missing: /scenarios/0/time/offset (where t = 0 lies");
    has("\"ms\"", "\"m\"", "/scenarios/0/time/unit: unknown unit 'm'");
    has("\"initial\": { \"h\": [0, 1] }", "\"initial\": { \"h\": 3 }", "/scenarios/0/initial/h");
    has("} ]\n}", "}, { \"name\": \"A\" } ]\n}",
        "3 keys are missing: /scenarios/1/file (relative to the mapping); /scenarios/1/time");
    CHECK_THROWS_AS(read("{"), input_error);
    CHECK_THROWS_AS(read("[]"), input_error);
    CHECK_THROWS_AS(read_import_mapping("/nowhere/mapping.json"), input_error);
}

TEST_CASE("hours are 3600 seconds") {
    auto const m = read(replaced(io_support::csv_mapping, "\"ms\"", "\"h\""));
    CHECK(m.scenarios[0].time.to_seconds.factor_lower == io_support::dec("3600"));
    CHECK(m.scenarios[0].time.to_seconds.factor_upper == io_support::dec("3600"));
}

TEST_CASE("what must hold together") {
    auto const twice = [](std::string const& name, std::string const& inputs) {
        std::string text{io_support::csv_mapping};
        auto const from = text.find("    { \"name\"");
        auto const scenario = text.substr(from, text.rfind(" ]") - from);
        auto second = replaced(scenario, "\"A\"", "\"" + name + "\"");
        second = replaced(second, R"("u": { "column": "pump" })", inputs);
        return text.replace(text.rfind(" ]"), 0, ", " + second);
    };
    CHECK(read(twice("B", R"("u": { "column": "pump" })")).scenarios.size() == 2);
    CHECK_THROWS_AS(read(twice("A", R"("u": { "column": "pump" })")), input_error);
    CHECK_THROWS_AS(read(twice("B", "")), input_error);
    CHECK_THROWS_AS(read(twice("B", R"("w": { "column": "pump" })")), input_error);
    // A log that is split has no common offset.
    auto const split = replaced(io_support::serial_mapping, "\"longest_gap\": 0.05",
                                "\"longest_gap\": 0.05, \"gap\": \"split\"");
    CHECK(read(split).scenarios.size() == 1);
    CHECK_THROWS_AS(read(replaced(split, "\"first\"", "0")), input_error);
}

TEST_CASE("only what matters is asked for") {
    auto const m = read(R"({ "format": "sivid-mapping-1", "id": "i", "model": "m",
      "parameters": { "k": { "prior": [0, 1] } }, "max_outlier_fraction": 0,
      "scenarios": [ { "name": "A", "file": "a.csv", "time": { "sample_time": 0.01 },
                       "channels": { "h": { "column": 1, "error": 0.1 } } } ] })");
    auto const& s = m.scenarios.at(0);
    CHECK(s.role == scenario_role::fit);
    CHECK(s.form.from == source_form::kind::csv);
    CHECK(s.inputs.empty());
    CHECK(s.initial.empty());
    CHECK(*s.time.sample_time == io_support::dec("0.01"));
    CHECK(s.time.offset.is_zero());
    CHECK_FALSE(s.windows);
    CHECK(s.thin == 1);
}

TEST_CASE("a sample time stands instead of a column") {
    auto const has = [](std::string const& time, std::string const& message) {
        CAPTURE(time);
        CHECK_THAT(refused(R"("time": { "column": "time", "unit": "ms", "offset": 0 })", time),
                   ContainsSubstring(message));
    };
    has(R"("time": { "column": "time", "sample_time": 1 })", "a column and a sample time");
    has(R"("time": { "sample_time": 0 })", "/time/sample_time: not above 0");
    has(R"("time": {})", "time/column (or sample_time");
    try {
        (void)read(
            replaced(io_support::serial_mapping, "\"column\": \"t_ms\"", "\"sample_time\": 0.01"));
        FAIL("a log without times was accepted");
    } catch (input_error const& e) {
        CHECK_THAT(e.what(), ContainsSubstring("may lose lines"));
    }
}

TEST_CASE("windows and thinning are read for each scenario or for all") {
    auto const with = [](std::string const& text) {
        return read(
            replaced(io_support::csv_mapping, "\"interpolation\"", text + ", \"interpolation\""));
    };
    auto const s = with(R"("thin": 5, "windows": { "length": 2, "every": 10, "first": 1, "count": 4,
                 "holdout": [2], "initial": "propose" })")
                       .scenarios.at(0);
    REQUIRE(s.windows);
    CHECK(s.thin == 5);
    CHECK(s.windows->every == io_support::dec("10"));
    CHECK(s.windows->most == 4);
    CHECK(s.windows->is_holdout(2));
    CHECK(s.windows->initial.at(0).name == "h");
    CHECK_THROWS_AS(with("\"thin\": 0"), input_error);
    CHECK_THROWS_AS(read(replaced(replaced(io_support::csv_mapping, "\"fit\"", "\"holdout\""),
                                  "\"interpolation\"",
                                  R"("windows": {"length": 1, "holdout": 2}, "interpolation")")),
                    input_error);
    auto const all = read(replaced(io_support::csv_mapping, "\"scenarios\"",
                                   R"("defaults": { "thin": 3 }, "scenarios")"));
    CHECK(all.scenarios[0].thin == 3);
}
