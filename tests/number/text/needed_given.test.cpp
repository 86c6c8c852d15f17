// SPDX-License-Identifier: MIT
#include <sivid/number/text/needed_given.hpp>

#include "support/catch.hpp"

using namespace sivid;

TEST_CASE("counts in messages are numbers, one of them in the singular") {
    CHECK(needed_given(2, 3) == ": 2 are needed, 3 were given");
    CHECK(needed_given(1, 0) == ": 1 is needed, 0 were given");
    CHECK(needed_given(4, 1) == ": 4 are needed, 1 was given");
}
