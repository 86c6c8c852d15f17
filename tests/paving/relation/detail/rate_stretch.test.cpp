// SPDX-License-Identifier: MIT
#include <sivid/paving/relation/detail/rate_stretch.hpp>

#include "support/catch.hpp"

#include <cmath>

using namespace sivid;

TEST_CASE("what stretches add up to within a time") {
    // It rises by 1, 2 and 3 in steps of 1 s, and falls by 4.
    std::vector<rate_stretch> const all{{0, 1, 1, 0, 0, 0, interval(0, 1)},
                                        {1, 2, 2, 0, 0, 0, interval(1, 3)},
                                        {2, 3, 3, 0, 0, 0, interval(3, 6)},
                                        {3, 4, 0, 4, 0, 0, interval(2, 6)}};
    CHECK_THAT(most_change(all, 1), WithinRel(4, 1e-9));
    CHECK_THAT(most_change(all, 2), WithinRel(5, 1e-9));
    CHECK_THAT(most_change(all, 1.5), WithinRel(4, 1e-9));
    CHECK_THAT(most_change(all, 3), WithinRel(6, 1e-9));
    CHECK_THAT(most_change(all, 10), WithinRel(6, 1e-9)); // the ranges bound it
    CHECK(most_change({}, 1) == 0);
    // Beyond them nothing is known.
    CHECK(most_change(all, 5, 6) == HUGE_VAL);
}

TEST_CASE("what happens at any moment counts in full and what is not bounded by its range") {
    std::vector<rate_stretch> all{{0, 1, 0, 0, 2, 1, interval(-9, 9)},
                                  {1, 2, 0, 0, 2, 1, interval(-9, 9)}};
    CHECK_THAT(most_change(all, 0.5), WithinRel(2, 1e-9));
    CHECK_THAT(most_change(all, 1), WithinRel(2, 1e-9));
    CHECK_THAT(most_change(all, 1.25), WithinRel(4, 1e-9));
    all[0].up = all[0].down = HUGE_VAL;
    CHECK(most_change(all, 1) == 18);
}
