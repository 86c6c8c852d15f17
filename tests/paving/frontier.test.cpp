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
