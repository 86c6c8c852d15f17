// SPDX-License-Identifier: MIT
#include <sivid/paving/relation/integrand_set.hpp>

#include "diagnosis/planted_motion.hpp"
#include "support/catch.hpp"

using namespace diagnosis_support;

TEST_CASE("derivatives that are zero are found to be so") {
    graph g;
    expression const x(g, g.leaf(operation::state, 0));
    expression const y(g, g.leaf(operation::state, 1));
    auto const f = (-(0.25 * x) / interval_traits<interval>::bounds(0.5, 0.6) + 1 / y).in(g);
    auto const set = integrand_set::of(g, {f}, 2, 0);
    CHECK(g.is_literal(set.slopes[0][0]));
    CHECK(set.uses(0, 0));
    CHECK(set.uses(0, 1));
}

TEST_CASE("functions that jump are told from those with a kink") {
    graph g;
    expression const x(g, g.leaf(operation::state, 0));
    expression const u(g, g.leaf(operation::input, 0));
    expression const t(g, g.leaf(operation::time, 0));
    auto const jump = (sign(x) + 1).in(g);
    auto const kink = (abs(x) * u + t).in(g);
    auto const set = integrand_set::of(g, {jump, kink}, 1, 1);
    CHECK_FALSE(set.continuous[0]);
    CHECK(set.continuous[1]);
    CHECK_FALSE(set.uses(0, 1));
    for (std::size_t k = 0; k < 3; ++k) CHECK(set.uses(1, k)); // state, input, time
    CHECK(g.is(set.slopes[1][2], 1));
}
