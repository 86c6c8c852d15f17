// SPDX-License-Identifier: MIT
#include <sivid/enclosure/suggested_degree.hpp>

#include "support/catch.hpp"

#include <cstddef>

TEST_CASE("degrees fall with the number of unknowns, and are 0 for points alone") {
    std::size_t const expected[] = {0, 4, 4, 4, 3, 2, 2};
    for (std::size_t n = 0; n < 7; ++n) CHECK(sivid::suggested_degree(n) == expected[n]);
    for (std::size_t n = 7; n < 200; ++n) {
        CHECK(sivid::suggested_degree(n) == 2);
    }
}
