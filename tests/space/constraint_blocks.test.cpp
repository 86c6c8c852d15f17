// SPDX-License-Identifier: MIT
#include <sivid/space/constraint_blocks.hpp>

#include "support/catch.hpp"

using namespace sivid;

namespace {

/// f0 = 1 + 2 d0 - d2, f1 = -3 + d2 with margins 0.5 and 0; then g = 4 d1 of margin 1.
std::vector<minimax_block> const blocks{{{0, 2}, {2, 0, -1, 1}, {1, -3}, {0.5, 0}},
                                        {{1}, {4}, {0}, {1}}};

Eigen::VectorXd point(double a, double b, double c) {
    Eigen::VectorXd p(3);
    p << a, b, c;
    return p;
}

} // namespace

TEST_CASE("the worst function and the worst bound at a point") {
    constraint_blocks all(3, blocks);
    auto const at_zero = all.worst_function(point(0, 0, 0));
    CHECK((!at_zero.is_bound && at_zero.block == 0 && at_zero.index == 1 && !at_zero.positive));
    CHECK(at_zero.excess == 3);
    auto const far = all.worst_function(point(0, -2, 0));
    CHECK((far.block == 1 && !far.positive && far.excess == 7));
    auto const bound = all.worst_bound(point(0.5, -2, 1.5));
    CHECK((bound.is_bound && bound.index == 1 && !bound.positive && bound.excess == 1));
    std::vector<minimax_block> const none;
    CHECK(constraint_blocks(0, none).worst_function(point(0, 0, 0)).excess < 0);
}

TEST_CASE("a constraint says that its normal times d stays within its reach") {
    constraint_blocks all(3, blocks);
    signed_constraint const below{false, 0, 0, false};
    auto const normal = all.normal(below, 4);
    CHECK(normal.size() == 4);
    // -(1 + 2 d0 - d2) <= 0.5
    CHECK((normal[0] == -2 && normal[1] == 0 && normal[2] == 1 && normal[3] == 0));
    CHECK(all.reach(below) == 1.5);
    signed_constraint const side{true, 0, 2, false};
    CHECK(all.normal(side, 3)[2] == -1);
    CHECK(all.reach(side) == 1);
}

TEST_CASE("the member that leaves a basis is driven to zero first") {
    CHECK(leaving_member(point(1, 2, -1), point(1, 1, 1)) == 1);
    CHECK(leaving_member(point(-1, 0, -1), point(1, 1, 1)) == -1);
    CHECK(leaving_member(point(1, 2, 0), point(0, 0, 0)) == 1); // of equals the steeper one
    double const nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(leaving_member(point(nan, 1, 1), point(1, 1, 1)) < 3);
}

TEST_CASE("only functions with positive multipliers join a proof") {
    std::vector<minimax_weight> weights;
    add_weight(weights, {true, 0, 1, true}, 1);
    add_weight(weights, {false, 0, 1, true}, 0);
    add_weight(weights, {false, 0, 1, true}, std::numeric_limits<double>::infinity());
    CHECK(weights.empty());
    add_weight(weights, {false, 1, 0, false}, 0.25);
    REQUIRE(weights.size() == 1);
    CHECK((weights[0].block == 1 && weights[0].function == 0 && weights[0].value == -0.25));
}
