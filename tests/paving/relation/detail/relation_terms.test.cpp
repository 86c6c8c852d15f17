// SPDX-License-Identifier: MIT
#include <sivid/paving/relation/detail/relation_terms.hpp>

#include "support/catch.hpp"

TEST_CASE("a suspected sensor shows its state as it is, unless something else is said") {
    sivid::suspected_sensor const s;
    CHECK(equal(s.scale, sivid::interval(0.0)));
    CHECK(equal(s.drift, sivid::interval(0.0)));
    CHECK(s.mixing.empty());
}
