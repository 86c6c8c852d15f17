// SPDX-License-Identifier: MIT
#include <sivid/importing/scenario/detail/scenario_import.hpp>

#include "io/import_support.hpp"

using namespace sivid;
using namespace io_support;

namespace {

struct result {
    import_protocol protocol;
    open_scenario scenario;
};
/// The small table through the mapping with `from` replaced by `to`.
result read(std::string_view from, std::string_view to, std::string_view text = small_table,
            bool only = true) {
    temporary_folder const folder;
    folder.write("mapping.json", replaced(csv_mapping, from, to));
    static std::vector<import_mapping> kept; // the scenario points into its mapping
    kept.reserve(1000);
    kept.push_back(read_import_mapping(folder.path() / "mapping.json"));
    auto const& s = kept.back().scenarios.at(0);
    result r;
    auto const table = read_recorded_table(s, text, r.protocol);
    r.scenario = scenario_import{s, "A", only, r.protocol}.read(table).at(0);
    return r;
}
std::string refused(std::string_view from, std::string_view to,
                    std::string_view text = small_table) {
    try {
        (void)read(from, to, text);
    } catch (input_error const& e) {
        CHECK_FALSE(e.remedy().empty());
        return e.what();
    }
    return "no error";
}
std::vector<std::string> times(imported_quantity const& q) {
    std::vector<std::string> result;
    for (auto const& s : q.samples) result.push_back(s.time.text());
    return result;
}
using list = std::vector<std::string>;

} // namespace

TEST_CASE("a scenario lasts as long as its inputs") {
    auto const r = read("small", "small");
    CHECK(r.scenario.duration == dec("0.3"));
    CHECK(times(r.scenario.inputs[0]) == list{"0", "0.1", "0.2", "0.3"});
    CHECK(times(r.scenario.channels[0]) == list{"0", "0.1", "0.3"});
    CHECK(r.scenario.rows == 4);
    CHECK(r.scenario.measurement_count() == 3);
    CHECK(has_note(r.protocol, "duration: as long as all inputs"));
    CHECK(has_note(r.protocol, "the times are exact"));
}

TEST_CASE("offset and duration cut, one knot on either side stays") {
    auto const r = read(R"("offset": 0 })", R"("offset": -0.1 }, "duration": 0.15)");
    CHECK(times(r.scenario.inputs[0]) == list{"0", "0.1", "0.2"});
    CHECK(times(r.scenario.channels[0]) == list{"0"});
    CHECK(noted(r.protocol, "outside [0, duration]") == std::vector<std::size_t>{2, 2, 5});
    CHECK(has_note(r.protocol, "time shifted by -0.1 s"));
}

TEST_CASE("the first row with all inputs") {
    auto const r = read(R"("offset": 0 })", R"("offset": "first" })",
                        "time,pump,level\n0,,1\n50,,2\n100,1,3\n200,1,4\n300,,5\n");
    CHECK(times(r.scenario.inputs[0]) == list{"0", "0.1"});
    CHECK(times(r.scenario.channels[0]) == list{"0", "0.1"});
    CHECK(r.scenario.duration == dec("0.1"));
}

TEST_CASE("no inputs: as long as something is measured") {
    auto const r =
        read(R"("u": { "column": "pump" })", "", "time,pump,level\n0,x,1\n100,x,2\n200,x,\n");
    CHECK(r.scenario.inputs.empty());
    CHECK(r.scenario.duration == dec("0.1"));
}

TEST_CASE("times that are one double are thinned") {
    auto const r = read("\"ms\"", "\"s\"",
                        "time,pump,level\n0,1,1\n1,1,1\n1.00000000000000000001,1,1\n2,1,1\n");
    CHECK(times(r.scenario.inputs[0]) == list{"0", "1.00000000000000000001", "2"});
    CHECK(noted(r.protocol, "the same double") == std::vector<std::size_t>{3, 3});
}

TEST_CASE("what an input lacks is counted, and what cannot be told is an assumption") {
    std::string text = "time,pump,level\n";
    for (int i = 0; i < 20; ++i) text += std::to_string(i) + ",1,2\n";
    for (int i = 40; i < 60; ++i) text += std::to_string(i) + ",1,2\n";
    auto const counted = read("small", "small", text);
    auto const& samples = counted.scenario.inputs[0].samples;
    REQUIRE(samples.size() == 40);
    for (std::size_t i = 0; i < 40; ++i) CHECK(samples[i].missing == (i == 20 ? 20 : 0));
    CHECK_FALSE(has_note(counted.protocol, "more than five usual steps"));
    // Without a usual step nobody can tell.
    std::string rare = "time,pump,level\n";
    for (int const t : {0, 3, 4, 9, 11, 80, 81, 88, 90, 93}) rare += std::to_string(t) + ",1,2\n";
    auto const r = read("small", "small", rare);
    for (auto const& sample : r.scenario.inputs[0].samples) CHECK(sample.missing == 0);
    CHECK(noted(r.protocol, "more than five usual steps") == std::vector<std::size_t>{7});
}

TEST_CASE("a record that makes no scenario is refused") {
    auto const offset = [](std::string const& o) { return "\"offset\": " + o + " }"; };
    auto const zero = R"("offset": 0 })";
    CHECK_THAT(refused(zero, offset("0.1")),
               ContainsSubstring("line 2: the input 'u' starts after t = 0"));
    CHECK_THAT(refused(zero, offset("-0.3")), ContainsSubstring("nothing is left after t = 0"));
    CHECK_THAT(refused(zero, R"("offset": 0 }, "duration": 0.4)"),
               ContainsSubstring("the inputs end at 0.3 s, before the duration"));
    CHECK_THAT(refused("small", "small", "time,pump,level\n"), ContainsSubstring("no data line"));
    CHECK_THAT(refused("small", "small", "time,pump,level\n0,1,\n1,1,\n"),
               ContainsSubstring("no measurement lies within"));
    CHECK_THAT(refused("small", "small", "time,pump,level\n0,,1\n1,,1\n"),
               ContainsSubstring("the input 'u' has no reading"));
    CHECK_THAT(refused(zero, offset("\"first\""), "time,pump,level\n0,,1\n1,,1\n"),
               ContainsSubstring("no row has a reading of every input"));
    CHECK_THAT(refused(zero, offset("1.7e308"), "time,pump,level\n1.7e308,1,1\n"),
               ContainsSubstring("starts after t = 0"));
    CHECK_THAT(refused("\"ms\", \"offset\": 0", "\"s\", \"offset\": 1.7e308",
                       "time,pump,level\n-1,1,1\n1.7e308,1,1\n"),
               ContainsSubstring("beyond the range of double"));
}

TEST_CASE("a stretch of a log may be shorter than the duration") {
    auto const r = read(R"("offset": 0 })", R"("offset": 0 }, "duration": 5)", small_table, false);
    CHECK(r.scenario.duration == dec("0.3"));
}
