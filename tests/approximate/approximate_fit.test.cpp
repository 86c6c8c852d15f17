// SPDX-License-Identifier: MIT
#include <sivid/approximate/approximate_fit.hpp>

#include "support/catch.hpp"

TEST_CASE("a fit that was not made explains nothing") {
    sivid::approximate_fit const none;
    CHECK(none.parameters.empty());
    CHECK_FALSE(none.inflation <= 1);
    CHECK_FALSE(none.squares < 1e300);
}
