// SPDX-License-Identifier: MIT
#include <sivid/verifier/claim/detail/stated_range.hpp>

#include "support/catch.hpp"

using namespace sivid;
using io_detail::leaves;

TEST_CASE("a box beside a prior leaves it, however close it is") {
    box const prior{interval(0.5, 2.0)};
    CHECK_FALSE(leaves(box{interval(0.5, 1.0)}, prior));
    CHECK_FALSE(leaves(box{interval(1.0, 2.0 + 0x1p-51)}, prior)); // read outward
    CHECK_FALSE(leaves(box{interval(2.0, 2.0 + 0x1p-51)}, prior)); // its face
    CHECK(leaves(box{interval(2.0 + 0x1p-51, 2.0 + 0x1p-50)}, prior));
    CHECK(leaves(box{interval(1.0, 2.1)}, prior));
    CHECK(leaves(box{interval(0.4, 1.0)}, prior));
}
