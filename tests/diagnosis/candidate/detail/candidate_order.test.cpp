// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/candidate/detail/candidate_order.hpp>

#include "support/catch.hpp"

using namespace sivid;
using indices = std::vector<std::size_t>;

TEST_CASE("the answer first, then rivals, then by inflation, last what only adds to it") {
    auto const order = candidate_order({{{}, 3, 9, 900},
                                        {{0}, 4, 5, 500},
                                        {{1}, 4, 0.9, 90},
                                        {{2}, 4, 0.95, 91},
                                        {{1, 2}, 5, 0.9, 90},
                                        {{0, 2}, 5, 3, 300}},
                                       1000, {});
    CHECK(order.explained());
    CHECK(order.answer() == 2);
    CHECK(order.others() == indices{3});
    CHECK(order.order() == indices{2, 3, 5, 1, 4});
    CHECK(order.of_interest(2));
    CHECK(order.of_interest(3));
    CHECK_FALSE(order.of_interest(4)); // adds to the answer
    CHECK_FALSE(order.of_interest(5));
}

TEST_CASE("where nothing explains the closest is looked at") {
    auto const order =
        candidate_order({{{}, 3, 9, 900}, {{0}, 4, 5, 500}, {{1}, 4, 2, 90}}, 1000, {});
    CHECK_FALSE(order.explained());
    CHECK(order.answer() == 2);
    CHECK(order.order() == indices{2, 1});
    CHECK(order.of_interest(2));
    CHECK_FALSE(order.of_interest(1));
}
