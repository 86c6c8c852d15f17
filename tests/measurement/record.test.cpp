// SPDX-License-Identifier: MIT
#include <sivid/measurement/record.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"

using namespace sivid;
using support::between;

TEST_CASE("records are sorted by time, then channel, equal ones as they stood") {
    record const mixed{{2, 0, between(0, 1)},
                       {1, 1, between(1, 2)},
                       {1, 0, between(2, 3)},
                       {1, 1, between(3, 4)},
                       {0, 5, between(4, 5)}};
    auto const s = sorted(mixed);
    REQUIRE(s.size() == 5);
    double const expected[] = {4, 2, 1, 3, 0};
    for (std::size_t i = 0; i < 5; ++i) {
        CAPTURE(i);
        CHECK(s[i].bound.lower() == expected[i]);
    }
    CHECK(sorted({}).empty());
}
