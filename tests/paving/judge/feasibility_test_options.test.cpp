// SPDX-License-Identifier: MIT
#include <sivid/paving/judge/feasibility_test_options.hpp>

#include "support/catch.hpp"

TEST_CASE(
    "limited tests ask the same question in boxes and witnesses, and keep their other options") {
    sivid::feasibility_test_options mine;
    mine.sharp_enough = 0.25;
    int asked = 0;
    auto const limited = sivid::limited(mine, [&asked] { return ++asked < 2; });
    CHECK(limited.sharp_enough == 0.25);
    CHECK_FALSE(mine.keep_going);
    REQUIRE(limited.keep_going);
    REQUIRE(limited.witness.keep_going);
    CHECK(limited.keep_going());
    CHECK_FALSE(limited.witness.keep_going());
    CHECK(asked == 2);
}
