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

TEST_CASE("times are shifted exactly, and the first counts of those that coincide as doubles") {
    scenario_mapping s;
    s.channels.resize(1);
    import_protocol protocol;
    auto o = scenario_of(s, {"0.1", "0.3", "0.30000000000000000001", "0.4"});
    shift_times(o, dec("-0.1"), protocol);
    REQUIRE(o.channels[0].samples.size() == 3);
    CHECK(o.channels[0].samples[1].time == dec("0.2"));
    CHECK(io_support::noted(protocol, "the same double") == std::vector<std::size_t>{3});
    CHECK_THROWS_AS(shift_times(o, dec("1e400"), protocol), input_error);
}
