// SPDX-License-Identifier: MIT
#include <sivid/importing/mapping/detail/required_keys.hpp>

#include "io/import_support.hpp"

using namespace sivid;

namespace {

std::string message(std::string const& text) {
    auto const root = parse_json("m.json", text);
    try {
        require_mapping_keys(root);
    } catch (input_error const& e) {
        CHECK_FALSE(e.remedy().empty());
        return e.what();
    }
    return "complete";
}

} // namespace

TEST_CASE("all missing keys are named at once, with what they mean") {
    auto const text = message(R"({ "id": "x", "parameters": { "k": {} },
        "scenarios": [ { "name": "A", "time": { "unit": "s" }, "inputs": { "u": { "column": 1 } },
                         "channels": { "h": { "column": 1 } } } ] })");
    CHECK_THAT(text, ContainsSubstring("8 keys are missing: /model (the name of the model); "
                                       "/max_outlier_fraction (0 if ") &&
                         ContainsSubstring("/parameters/k/prior") &&
                         ContainsSubstring("/scenarios/0/file (") &&
                         ContainsSubstring("/scenarios/0/interpolation (") &&
                         ContainsSubstring("/scenarios/0/channels/h/error (") &&
                         ContainsSubstring("/scenarios/0/time/column (or sample_time") &&
                         ContainsSubstring("/scenarios/0/time/offset (where t = 0 lies"));
    CHECK(message(std::string{io_support::csv_mapping}) == "complete");
    CHECK(message(std::string{io_support::serial_mapping}) == "complete");
}

TEST_CASE("what further files lack is named, and the first one may measure nothing") {
    auto const text = message(R"({ "id": "x", "model": "m", "parameters": {},
        "max_outlier_fraction": 0,
        "scenarios": [ { "name": "A", "file": "a.csv", "time": { "sample_time": 1 },
                         "further_files": [ { "file": "b.csv", "inputs": { "u": {} },
                                              "clock": {} }, {}, 7 ] } ] })");
    CHECK_THAT(text, ContainsSubstring("7 keys are missing: /scenarios/0/further_files/0/time (") &&
                         ContainsSubstring("/further_files/0/inputs/u/column") &&
                         ContainsSubstring("/further_files/0/clock/offset (what to add") &&
                         ContainsSubstring("/further_files/1/file (") &&
                         ContainsSubstring("/further_files/1/time (") &&
                         ContainsSubstring("/further_files/1/clock (how it differs") &&
                         ContainsSubstring("/scenarios/0/interpolation ("));
}

TEST_CASE("what the defaults lack is named once") {
    auto const text = message(R"({ "id": "x", "model": "m", "parameters": {},
        "max_outlier_fraction": 0,
        "defaults": { "file": "a.log", "source": { "kind": "serial" }, "windows": {},
                      "time": { "column": "t", "unit": "s", "offset": 0 },
                      "channels": { "h": { "column": "h", "error": 1 } },
                      "initial": { "v": { "rate_of": "h" }, "w": {} } },
        "scenarios": [ { "name": "A" }, { "name": "B" }, {} ] })");
    CHECK_THAT(text, ContainsSubstring("6 keys are missing: /defaults/source/fields") &&
                         ContainsSubstring("/defaults/source/longest_gap") &&
                         ContainsSubstring("/defaults/windows/length") &&
                         ContainsSubstring("/defaults/initial/v/acceleration (how fast") &&
                         ContainsSubstring("/defaults/initial/w/channel") &&
                         ContainsSubstring("/scenarios/2/name"));
}

TEST_CASE("without room the hints are left out, and wrong types are the reader's") {
    std::string many;
    for (int i = 0; i < 40; ++i) many += i > 0 ? ", {}" : "{}";
    auto const text = message(R"({ "scenarios": [)" + many + "] }");
    CHECK_THAT(text, ContainsSubstring("164 keys are missing: /id; /model; "));
    CHECK(text.size() < 1200);
    CHECK_THAT(message(R"({ "parameters": 1, "defaults": [], "scenarios": 3 })"),
               ContainsSubstring("3 keys are missing: /id"));
    CHECK_THAT(message(R"({ "scenarios": [1, [], { "time": 3, "channels": [1], "inputs": 2 }] })"),
               ContainsSubstring("/scenarios/2/name"));
}
