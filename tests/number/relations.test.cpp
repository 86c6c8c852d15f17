// SPDX-License-Identifier: MIT
#include <sivid/number/relations.hpp>

#include "support/catch.hpp"

using namespace sivid;

namespace {
interval make(double lo, double hi) { return detail::bounded(lo, hi); }
} // namespace

TEST_CASE("order relations are statements about elements") {
    interval const none = detail::empty_interval(), all = detail::entire_interval();
    CHECK(less(make(1, 2), make(1, 3)));
    CHECK_FALSE(less(make(1, 4), make(2, 3)));
    CHECK_FALSE(less(make(2, 3), make(1, 4)));
    CHECK(less(none, none));
    CHECK_FALSE(less(none, make(1, 2)));
    CHECK(strict_less(make(1, 2), make(1.5, 3)));
    CHECK_FALSE(strict_less(make(1, 2), make(1, 3)));
    CHECK(strict_less(all, all));
    CHECK(precedes(make(1, 2), make(2, 3)));
    CHECK_FALSE(strict_precedes(make(1, 2), make(2, 3)));
    CHECK(strict_precedes(make(1, 2), make(3, 4)));
    CHECK(precedes(none, all));
    CHECK(strict_precedes(all, none));
}

TEST_CASE("comparison operators are true only if certain") {
    CHECK(make(1, 2) < make(3, 4));
    CHECK_FALSE(make(1, 3) < make(2, 4));
    CHECK_FALSE(make(1, 3) >= make(2, 4));
    CHECK(make(1, 2) <= make(2, 4));
    CHECK(make(3, 4) > make(1, 2));
    CHECK(make(1, 1) == make(1, 1));
    CHECK_FALSE(make(1, 2) == make(1, 2));
    CHECK(make(1, 2) != make(1, 2));
    CHECK_FALSE(detail::empty_interval() < make(1, 2));
    CHECK_FALSE(make(0, 0) != interval{0.0});
}
