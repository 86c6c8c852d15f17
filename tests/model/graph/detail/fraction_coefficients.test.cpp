// SPDX-License-Identifier: MIT
#include <sivid/model/graph/detail/fraction_coefficients.hpp>

#include "support/catch.hpp"

#include <cstdint>

using namespace sivid;
using model_detail::fraction_coefficients;
using model_detail::small_fraction;

TEST_CASE("small fractions are in lowest terms, and refuse what would overflow") {
    auto const half = small_fraction::of(-3, -6);
    REQUIRE(half);
    CHECK(half->above == 1);
    CHECK(half->below == 2);
    auto const sum = small_fraction::sum(*half, {1, 3});
    REQUIRE(sum);
    CHECK(sum->above == 5);
    CHECK(sum->below == 6);
    CHECK_FALSE(small_fraction::of(0, 0));
    small_fraction const large{std::int64_t{1} << 61, 1};
    CHECK_FALSE(small_fraction::product(large, {4, 1}));
    CHECK_FALSE(small_fraction::sum({std::int64_t{1} << 62, 1}, {std::int64_t{1} << 62, 1}));
}

TEST_CASE("coefficients are the exact literals") {
    graph g;
    fraction_coefficients const c(g);
    auto const known = c.known(g.constant(-2.5));
    REQUIRE(known);
    CHECK(known->above == -5);
    CHECK(known->below == 2);
    CHECK_FALSE(c.known(g.constant(0.1))); // no multiple of 1/1024
    CHECK_FALSE(c.known(g.leaf(operation::state, 0)));
    CHECK_FALSE(c.quotient({1, 1}, {0, 1}));
    auto const cube = c.power({2, 3}, 3);
    REQUIRE(cube);
    CHECK(cube->above == 8);
    CHECK(cube->below == 27);
}
