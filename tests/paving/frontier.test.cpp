// SPDX-License-Identifier: MIT
#include <sivid/paving/frontier.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"

using namespace sivid;
using support::between;

TEST_CASE("waiting boxes come by volume or by age, and their hull is known") {
    using paving_detail::frontier;
    for (auto const order : {search_order::largest_first, search_order::first_in}) {
        frontier<int> waiting(order);
        waiting.push(box{between(0, 1)}, 1, 0);
        waiting.push(box{between(4, 6)}, 2, 0);
        CHECK(waiting.volume() == 3);
        auto const all = waiting.hull(box{between(-1, -1)});
        CHECK(all[0].lower() == -1);
        CHECK(all[0].upper() == 6);
        bool const by_age = order == search_order::first_in;
        CHECK(waiting.pop().volume == (by_age ? 1 : 2));
        CHECK(waiting.pop().volume == (by_age ? 2 : 1));
        CHECK(waiting.empty());
    }
}

TEST_CASE("the side to split is the one with the strongest smear that is still wide enough") {
    box const whole{between(0, 1), between(0, 10)};
    box const x{between(0, 0.5), between(0, 1)};
    using paving_detail::side_to_split;
    CHECK(side_to_split(x, whole, {}, 0.01) == 0);
    CHECK(side_to_split(x, whole, {1, 2}, 0.01) == 1);
    CHECK(side_to_split(x, whole, {1, 2}, 0.2) == 0);
    CHECK_FALSE(side_to_split(x, whole, {}, 0.6));
}

TEST_CASE("a hull rests at the second look in a row at which no side has shrunk") {
    double wide = 8, high = 1;
    std::size_t looks = 0;
    auto const hull = [&] {
        ++looks;
        return box{between(0, wide), between(0, high)};
    };
    paving_detail::hull_rest rest{.last = box{between(0, 8), between(0, 1)}};
    CHECK_FALSE(rest(7, 0.02, hull));
    CHECK(looks == 0);
    CHECK_FALSE(rest(8, 0.02, hull)); // rests, once
    CHECK_FALSE(rest(15, 0.02, hull));
    CHECK(looks == 1);
    high = 0.9; // a slanting sheet: what was cut at first left the hull as it was
    CHECK_FALSE(rest(16, 0.02, hull));
    wide = 4;
    CHECK_FALSE(rest(32, 0.02, hull));
    wide = 3.95;
    CHECK_FALSE(rest(64, 0.02, hull));
    CHECK_FALSE(rest(127, 0.02, hull));
    CHECK(rest(128, 0.02, hull));
    CHECK(rest(128, 0.02, hull)); // also when asked again
    paving_detail::hull_rest never{.last = hull()};
    CHECK_FALSE(never(1000, 0, hull));
    CHECK_FALSE(never(4000, 0, hull));
}
