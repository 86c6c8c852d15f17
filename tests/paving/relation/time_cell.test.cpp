// SPDX-License-Identifier: MIT
#include <sivid/paving/relation/time_cell.hpp>

#include "diagnosis/planted_motion.hpp"
#include "support/catch.hpp"

using namespace diagnosis_support;

TEST_CASE("a line holds what it was made from") {
    draws d(60);
    for (int n = 0; n < 200; ++n) {
        double const start = d.uniform(-1e3, 1e3), end = d.uniform(-1, 1);
        auto const line = cell_line::of(start, end, between(-0.1, 0.2), 0.3);
        // The line's middle lies within the centre and the spread, whatever the rounding.
        auto const off = (static_cast<long double>(start) + end) / 2 - line.centre;
        CHECK(line.spread.lower() <= off - 0.1L + 1e-15L);
        CHECK(off + 0.2L - 1e-15L <= line.spread.upper());
        CHECK(width(line.spread) <= 0.3001);
        CHECK(line.drift >= std::abs(end - start) * (1 - 1e-15));
        CHECK(line.departure == 0.3);
    }
}

TEST_CASE("without a drift the range is centre and spread") {
    auto const still = cell_line::still(between(1, 3));
    CHECK(still.centre == 2);
    CHECK(still.drift == 0);
    CHECK(still.departure == 0);
    CHECK(equal(still.spread, between(-1, 1)));
    CHECK(is_entire(cell_line::still(interval_traits<interval>::entire()).spread));
}
