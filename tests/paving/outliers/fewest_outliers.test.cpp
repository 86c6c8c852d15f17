// SPDX-License-Identifier: MIT
#include <sivid/paving/outliers/fewest_outliers.hpp>

#include "support/catch.hpp"

using namespace sivid;

TEST_CASE("a count is exact where both of its bounds are the same") {
    CHECK(proved_count{}.exact());
    CHECK(proved_count{3, 3}.exact());
    CHECK_FALSE(proved_count{2, 3}.exact());
}
