// SPDX-License-Identifier: MIT
#include <sivid/enclosure/options.hpp>

#include "support/catch.hpp"

TEST_CASE("options are an aggregate with useful defaults") {
    STATIC_REQUIRE(std::is_aggregate_v<sivid::enclosure_options>);
    sivid::enclosure_options const o{.order = 20, .tolerance = 1e-9};
    CHECK(o.order == 20);
    CHECK(o.tolerance == 1e-9);
    CHECK(o.minimum_step > 0);
    CHECK(o.minimum_step < o.maximum_step);
    CHECK_FALSE(o.method);
}
