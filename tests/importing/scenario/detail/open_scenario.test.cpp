// SPDX-License-Identifier: MIT
#include <sivid/importing/scenario/detail/open_scenario.hpp>

#include "io/import_support.hpp"

using namespace sivid;
using io_support::dec;

namespace {

open_scenario scenario_of(scenario_mapping const& s, std::vector<std::string> const& times) {
    open_scenario o;
    o.mapping = &s;
    o.stretch = "A";
    o.channels.emplace_back();
    o.channels[0].mapping = s.channels.data();
    o.channels[0].from = &s;
    for (auto const& t : times) {
        imported_sample sample;
        sample.line = o.channels[0].samples.size() + 1;
        sample.time = dec(t);
        o.channels[0].samples.push_back(sample);
    }
    return o;
}

} // namespace

TEST_CASE("counts before and after thinning") {
    scenario_mapping s;
    s.channels.resize(1);
    auto const o = scenario_of(s, {"0", "1", "2", "3", "4"});
    CHECK(o.measurement_count() == 5);
    s.thin = 2;
    CHECK(o.measurement_count() == 3);
    CHECK(o.reading_count() == 5);
    s.thin = 9;
    CHECK(o.measurement_count() == 1);
}

TEST_CASE("times are shifted exactly, and the last counts of those that coincide as doubles") {
    scenario_mapping s;
    s.channels.resize(1);
    import_protocol protocol;
    auto o = scenario_of(s, {"0.1", "0.3", "0.30000000000000000001", "0.4"});
    shift_times(o, dec("-0.1"), protocol);
    REQUIRE(o.channels[0].samples.size() == 3);
    CHECK(o.channels[0].samples[1].time == dec("0.20000000000000000001"));
    CHECK(io_support::noted(protocol, "the same double") == std::vector<std::size_t>{2});
    CHECK_THROWS_AS(shift_times(o, dec("1e400"), protocol), input_error);
}

TEST_CASE("a held input has stepped at an instant, and readings from before are left out") {
    scenario_mapping s;
    s.between = interpolation::hold;
    s.inputs.resize(2);
    s.channels.resize(1);
    // Lines 1 to 5: u steps in line 3, y was read in all of them, w in the first and the last.
    auto o =
        scenario_of(s, {"0", "1010e-3", "1.0100000000000000001", "1.01000000000000000011", "2"});
    o.inputs = {o.channels[0], o.channels[0]};
    o.inputs[0].mapping = &s.inputs[0];
    o.inputs[0].samples.erase(o.inputs[0].samples.begin() + 3);
    o.inputs[0].samples[2].reading.value = o.inputs[0].samples[3].reading.value = dec("5");
    o.inputs[1].mapping = &s.inputs[1];
    o.inputs[1].samples.erase(o.inputs[1].samples.begin() + 1, o.inputs[1].samples.begin() + 4);
    import_protocol protocol;
    auto const lines_of = [](imported_quantity const& q) {
        std::vector<std::size_t> lines;
        for (auto const& sample : q.samples) lines.push_back(sample.line);
        return lines;
    };
    auto both = o, before = o;
    shift_times(both, {}, protocol);
    CHECK(lines_of(both.inputs[0]) == std::vector<std::size_t>{1, 3, 5});
    CHECK(lines_of(both.inputs[1]) == std::vector<std::size_t>{1, 5});
    CHECK(lines_of(both.channels[0]) == std::vector<std::size_t>{1, 4, 5});
    CHECK(io_support::noted(protocol, "of the next one") == std::vector<std::size_t>{2, 3});
    CHECK(io_support::noted(protocol, "a later sample") == std::vector<std::size_t>{2});
    // Of two lines at one time the first has the reading alone, the second the step alone.
    before.channels[0].samples.erase(before.channels[0].samples.begin() + 2,
                                     before.channels[0].samples.begin() + 4);
    shift_times(before, {}, protocol);
    CHECK(lines_of(before.channels[0]) == std::vector<std::size_t>{1, 5});
    // Lines at one time between which a linear input does not change are one.
    s.between = interpolation::linear;
    auto const message = [&] {
        try {
            shift_times(o, {}, protocol);
        } catch (input_error const& e) {
            return std::string{e.what()};
        }
        return std::string{"no error"};
    };
    auto flat = o;
    flat.inputs[0].samples[2].reading.value = {};
    shift_times(flat, {}, protocol);
    CHECK(lines_of(flat.inputs[0]) == std::vector<std::size_t>{1, 3, 5});
    CHECK_THAT(message(), ContainsSubstring("line 3: the input '' has another value in line 2") &&
                              ContainsSubstring("\"hold\""));
}
