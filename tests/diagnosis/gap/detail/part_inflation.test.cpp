// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/gap/detail/part_inflation.hpp>

#include "diagnosis/small_catalogue.hpp"
#include "support/catch.hpp"

#include <cmath>
#include <cstddef>
#include <string>

using namespace sivid;

TEST_CASE("no part of the data is worse than the whole, and the broken channel shows") {
    auto p = small_campaign::problem(small_campaign::with_scale(0.2));
    auto const whole = bound_inflation(p);
    auto const go_on = [](std::string const&) { return true; };
    auto const scenarios = inflation_of_experiments(p, whole.value, {}, go_on);
    auto const channels = inflation_of_channels(p, whole.value, {}, go_on);
    REQUIRE(scenarios.size() == 2);
    REQUIRE(channels.size() == 2);
    for (auto const* parts : {&scenarios, &channels}) {
        for (auto const& part : *parts) CHECK(part.hull->lower() <= whole.value.upper());
    }
    CHECK(channels[1].name == "v");
    CHECK(channels[1].hull->upper() <= 1); // the speed alone is explained
    std::erase_if(p.experiments[0].measurements, [](auto const& m) { return m.channel == 0; });
    std::erase_if(p.experiments[1].measurements, [](auto const& m) { return m.channel == 0; });
    CHECK(inflation_of_channels(p, whole.value, {}, go_on).size() == 1);
    CHECK(inflation_of_experiments(p, whole.value, {}, [](std::string const& name) {
              return name == "E1";
          }).size() == 1);
}

TEST_CASE("a part that is everything is bounded as the whole is, without a search") {
    auto p = small_campaign::problem(small_campaign::with_scale(0.2));
    p.experiments.resize(1);
    auto const go_on = [](std::string const&) { return true; };
    auto const whole = interval(2.5, 3);
    auto const parts = inflation_of_experiments(p, whole, {}, go_on);
    REQUIRE(parts.size() == 1);
    CHECK(parts[0].hull->lower() == 2.5);
    CHECK(parts[0].hull->upper() == 3);
    for (auto const& channel : inflation_of_channels(p, whole, {}, go_on)) {
        CHECK(channel.hull->upper() != 3); // two channels: each is less than everything
    }
}

TEST_CASE("a channel with fewer measurements than outliers is bounded, too") {
    auto p = small_campaign::problem(small_campaign::with_scale(0.2));
    for (auto& e : p.experiments) {
        e.outliers = 3;
        std::size_t of_speed = 0;
        std::erase_if(e.measurements,
                      [&](auto const& m) { return m.channel == 1 && ++of_speed > 2; });
    }
    auto const go_on = [](std::string const&) { return true; };
    auto const channels = inflation_of_channels(p, interval(0.0, HUGE_VAL), {}, go_on);
    REQUIRE(channels.size() == 2);
    CHECK(channels[1].hull->upper() == 0);
}
