// SPDX-License-Identifier: MIT
#include <sivid/decision/ranking/measurement_group.hpp>

#include "support/catch.hpp"

TEST_CASE("a group holds what all of its limits allow") {
    sivid::measurement const early{.time = 1, .channel = 0, .bound = {0, 1}};
    sivid::measurement const late{.time = 2, .channel = 1, .bound = {0, 1}};
    sivid::measurement_group const all, first{.experiment = {}, .channel = {}, .to = 2},
        rest{.experiment = {}, .channel = {}, .from = 2}, sensor{.experiment = 3, .channel = 1};
    CHECK((all.holds(0, early) && all.holds(7, late)));
    CHECK((first.holds(0, early) && !first.holds(0, late))); // the end is the next part's
    CHECK((!rest.holds(0, early) && rest.holds(0, late)));
    CHECK((sensor.holds(3, late) && !sensor.holds(3, early) && !sensor.holds(2, late)));
}
