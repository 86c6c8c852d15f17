// SPDX-License-Identifier: MIT
#include <sivid/model/structure/combination.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/power_series.hpp"
#include "support/random.hpp"

#include <cmath>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;

TEST_CASE("ranges of combinations enclose their values") {
    draws d(172);
    for (int round = 0; round < 200; ++round) {
        combination const c{
            {static_cast<int>(d.below(5)) - 2, static_cast<int>(d.below(5)) - 2}, "", ""};
        box const p{between(0.5, 0.5 + d.uniform(0, 1)), between(-3, -3 + d.uniform(0, 2))};
        auto const range = c.over(p);
        auto const v = d.in(p);
        auto const exact = support::real::pown(support::mp(v[0]), c.exponents[0]) *
                           support::real::pown(support::mp(v[1]), c.exponents[1]);
        CHECK(support::encloses(range, exact, 1e-40));
    }
    // A divisor that may be zero bounds nothing.
    combination const inverse{{-1}, "", ""};
    CHECK(width(inverse.over(box{between(-1, 1)})) == HUGE_VAL);
}

TEST_CASE("a parameter uses the products and sums in which it stands") {
    std::vector<combination> const all{
        {{1, 0, -2}, "", ""}, {{0, 0, 1}, "", ""}, {{0, 0, 0}, "", "", {1, 0, -1}}};
    CHECK(users_of(all, 0) == 2);
    CHECK(users_of(all, 1) == 0);
    CHECK(users_of(all, 2) == 3);
}
