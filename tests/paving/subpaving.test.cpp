// SPDX-License-Identifier: MIT
#include <sivid/paving/subpaving.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"

using namespace sivid;
using support::between;

TEST_CASE("volumes, counts and the hull of a subpaving") {
    subpaving paving(box{between(0, 4), between(0, 2)});
    CHECK_FALSE(paving.has_outer());
    CHECK(is_empty(paving.outer_hull()));
    CHECK(paving.outer_volume().upper() == 0);
    paving.add(box{between(0, 2), between(0, 2)}, box_verdict::outside);
    CHECK_FALSE(paving.has_outer());
    paving.add(box{between(2, 3), between(0, 2)}, box_verdict::inside);
    paving.add(box{between(3, 3.5), between(0, 1)}, box_verdict::undecided);
    paving.add(box{between(3, 3.5), between(1, 2)}, box_verdict::pending);
    CHECK(contains(paving.inner_volume(), 0.25));
    CHECK(contains(paving.outer_volume(), 0.375));
    CHECK(width(paving.outer_volume()) < 1e-14);
    CHECK(paving.boxes().size() == 4);
    CHECK(paving.count(box_verdict::inside) == 1);
    CHECK(paving.count(box_verdict::pending) == 1);
    CHECK(paving.count(box_verdict::outside) == 1);
    REQUIRE(paving.has_outer());
    CHECK(paving.outer_hull()[0].lower() == 2);
    CHECK(paving.outer_hull()[0].upper() == 3.5);
    CHECK(paving.outer_hull()[1].upper() == 2);
    CHECK(paving.prior()[0].upper() == 4);
}

TEST_CASE("what lies outside a box that holds all is left out, whatever waits there") {
    subpaving paving(box{between(0, 4)});
    paving.add(box{between(0, 1)}, box_verdict::pending);
    paving.add(box{between(1, 2)}, box_verdict::undecided);
    paving.add(box{between(2, 3)}, box_verdict::inside);
    paving.add(box{between(3, 4)}, box_verdict::outside);
    auto const left = within(paving, box{between(1.5, 3)});
    REQUIRE(left.boxes().size() == 3);
    CHECK(left.count(box_verdict::pending) == 0);
    CHECK(left.count(box_verdict::inside) == 1);
    CHECK(left.count(box_verdict::outside) == 1);
    CHECK(left.outer_hull()[0].lower() == 1.5);
    CHECK(left.outer_hull()[0].upper() == 3);
    CHECK(contains(left.outer_volume(), 0.375));
    CHECK(contains(left.inner_volume(), 0.25));
    auto const none = within(paving, box{interval_traits<interval>::empty()});
    CHECK(none.count(box_verdict::pending) + none.count(box_verdict::undecided) == 0);
}
