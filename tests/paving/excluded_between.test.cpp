// SPDX-License-Identifier: MIT
#include <sivid/paving/excluded_between.hpp>

#include "support/catch.hpp"

using namespace sivid;

TEST_CASE("what boxes leave out between the ends of a hull is counted, and no more") {
    box const prior{interval(0, 10), interval(0, 1), interval(3)};
    subpaving paving(prior);
    auto const add = [&](double from, double to, double low, double high, box_verdict v) {
        paving.add(box{interval(from, to), interval(low, high), interval(3)}, v);
    };
    add(0, 2, 0, 0.5, box_verdict::undecided);
    add(1, 3, 0.5, 1, box_verdict::inside);
    add(3, 7, 0, 1, box_verdict::outside); // kept or not
    add(7, 8, 0, 1, box_verdict::pending);
    add(9, 10, 0, 0.75, box_verdict::undecided);
    auto const& hull = paving.outer_hull();
    CHECK_THAT(excluded_between(paving, hull, 0), WithinAbs(0.5, 1e-12)); // (3, 7), (8, 9)
    CHECK(excluded_between(paving, hull, 0) <= 0.5);
    CHECK(excluded_between(paving, hull, 1) == 0);
    CHECK(excluded_between(paving, hull, 2) == 0); // it has no width
    // A hull that is known better counts instead.
    box const narrow{interval(2.5, 8.5), interval(0, 1), interval(3)};
    CHECK_THAT(excluded_between(paving, narrow, 0), WithinAbs(0.45, 1e-12));
    CHECK(excluded_between(subpaving(prior), empty_box(3), 0) == 0);
}

TEST_CASE("a prior of which all is left has nothing excluded") {
    box const prior{interval(-1, 2)};
    subpaving paving(prior);
    paving.add(box{interval(-1, 0.3)}, box_verdict::undecided);
    paving.add(box{interval(0.3, 2)}, box_verdict::pending);
    CHECK(excluded_between(paving, prior, 0) == 0);
}
