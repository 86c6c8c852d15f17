// SPDX-License-Identifier: MIT
#include "support/catch.hpp"

#include <sivid/report/number_text.hpp>

using namespace sivid::report;

TEST_CASE("range: empty by default, and hulls ignore the empty and the infinite") {
    double const inf = std::numeric_limits<double>::infinity();
    double const nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(is_empty(range{}));
    CHECK(is_empty(range{nan, 1}));
    CHECK(is_empty(range{2, 1}));
    CHECK_FALSE(is_empty(range{1, 1}));
    CHECK_FALSE(is_finite(range{0, inf}));
    CHECK(hull(range{}, range{1, 2}) == range{1, 2});
    CHECK(hull(range{1, 2}, range{-1, 0}) == range{-1, 2});
    CHECK(hull(range{1, 2}, nan) == range{1, 2});
    CHECK(hull(range{1, 2}, inf) == range{1, 2});
    CHECK(is_empty(intersect(range{0, 1}, range{2, 3})));
    CHECK(with_margin(range{0, 2}, 0.5) == range{-1, 3});
}
