// SPDX-License-Identifier: MIT
#include <sivid/model/graph/operation.hpp>

#include "support/catch.hpp"

#include <set>
#include <string>

using namespace sivid;

TEST_CASE("operations are named and sorted into kinds") {
    std::set<std::string> names;
    int leaves = 0;
    int binary = 0;
    int kinks = 0;
    int partial = 0;
    for (int i = 0; i <= static_cast<int>(operation::max); ++i) {
        auto const op = static_cast<operation>(i);
        names.insert(std::string(name(op)));
        leaves += is_leaf(op) ? 1 : 0;
        binary += is_binary(op) ? 1 : 0;
        kinks += has_kink(op) ? 1 : 0;
        partial += is_total(op) ? 0 : 1;
        CHECK_FALSE((is_leaf(op) && is_binary(op)));
        CHECK_FALSE((is_leaf(op) && has_kink(op)));
    }
    CHECK(names.size() == static_cast<std::size_t>(operation::max) + 1);
    CHECK(leaves == 5);
    CHECK(binary == 6);
    CHECK(kinks == 4);
    CHECK(partial == 4);
    CHECK(name(operation::tanh) == "tanh");
    CHECK(name(operation::max) == "max");
    CHECK_FALSE(is_total(operation::tan));
    CHECK(is_total(operation::pown)); // n >= 3; negative powers are quotients
}
