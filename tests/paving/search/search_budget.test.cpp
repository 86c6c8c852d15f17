// SPDX-License-Identifier: MIT
#include <sivid/paving/search/search_budget.hpp>

#include "support/catch.hpp"

#include <sivid/paving/inversion_options.hpp>

#include <cmath>

using sivid::stop_reason;
using sivid::used_up;

TEST_CASE("a search ends by the first budget that is used up") {
    sivid::inversion_options most{.seconds = 2, .boxes = 10, .memory = 100};
    CHECK_FALSE(used_up(most, 2, 9, 100));
    CHECK(used_up(most, 2.5, 10, 101) == stop_reason::time_budget);
    CHECK(used_up(most, 2, 10, 101) == stop_reason::box_budget);
    CHECK(used_up(most, 2, 9, 101) == stop_reason::memory_budget);
    most.seconds = std::nan("");
    CHECK(used_up(most, 0, 0, 0) == stop_reason::time_budget);
}
