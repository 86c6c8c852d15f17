// SPDX-License-Identifier: MIT
#include <sivid/io/import_mapping_reader.hpp>

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
    has("\"role\": \"fit\", ", "", "/scenarios/0: the key 'role' is missing");
    has("\"fit\"", "\"holdout\"", "no scenario has the role fit");
    has("\"name\": \"A\"", "\"name\": \"A/B\"", "/scenarios/0/name");
    has("\"linear\"", "\"cubic\"", "/scenarios/0/interpolation");
    has("\"u\": {", "\"u v\": {", "cannot stand in a table");
    has("{ \"h\": { \"column\": \"level\", \"factor\": 0.01, \"error\": 0.02 } }", "{}",
        "/scenarios/0/channels: no channel is measured");
    has("\"h\": { \"column\"", "\"h_err\": { \"column\": 1, \"error\": 1 }, \"h\": { \"column\"",
        "cannot be told apart");
    has("\"interpolation\"", "\"duration\": 0, \"interpolation\"", "the duration is not above 0");
    has(", \"offset\": 0", "", "/scenarios/0/time: the key 'offset' is missing: where t = 0 lies");
    has("\"ms\"", "\"d\"", "/scenarios/0/time/unit: unknown unit 'd'");
    has("\"initial\": { \"h\": [0, 1] }", "\"initial\": { \"h\": 3 }", "/scenarios/0/initial/h");
    has("} ]\n}", "}, { \"name\": \"A\" } ]\n}", "the key 'role' is missing");
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
