// SPDX-License-Identifier: MIT
#include <sivid/paving/identification_state.hpp>

#include "support/catch.hpp"

TEST_CASE("a new state has nothing in it, and is no search to go on with") {
    sivid::identification_state const s;
    CHECK_FALSE(s.guess);
    CHECK(s.seconds == 0);
    CHECK_THROWS_AS(s.search.require_valid(), std::invalid_argument);
}
