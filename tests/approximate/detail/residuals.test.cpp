// SPDX-License-Identifier: MIT
#include <sivid/approximate/detail/residuals.hpp>

#include "support/catch.hpp"

using namespace sivid;

TEST_CASE("the inflation leaves the largest residuals of each experiment out") {
    residual_lists const r{{1, -5, 2, 0.5}, {3, -4}};
    CHECK(relaxed_maximum(r[0], 0) == 5);
    CHECK(relaxed_maximum(r[0], 1) == 2);
    CHECK(relaxed_maximum(r[0], 4) == 0);
    CHECK(inflation_of(r, {0, 0}) == 5);
    CHECK(inflation_of(r, {1, 0}) == 4);
    CHECK(inflation_of(r, {1, 1}) == 3);
    CHECK(kept_of(r, {1, 0}) == residual_lists{{1, 0, 1, 1}, {1, 1}});
}
