// SPDX-License-Identifier: MIT
#include <sivid/space/vec.hpp>

#include "support/catch.hpp"

TEST_CASE("a vec is an aggregate that structured bindings take apart") {
    sivid::vec<double, 3> const x{1, 2, 4};
    auto const& [a, b, c] = x;
    CHECK(a + 10 * b + 100 * c == 421);
    STATIC_REQUIRE(std::is_aggregate_v<sivid::vec<double, 3>>);
}
