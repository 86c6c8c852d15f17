// SPDX-License-Identifier: MIT
#include <sivid/space/linear_program/constraint_blocks.hpp>

#include "support/catch.hpp"

using namespace sivid;

namespace {

/// f0 = 1 + 2 d0 - d2, f1 = -3 + d2 with margins 0.5 and 0; then g = 4 d1 of margin 1.
std::vector<minimax_block> const blocks{{{0, 2}, {2, 0, -1, 1}, {1, -3}, {0.5, 0}},
                                        {{1}, {4}, {0}, {1}}};

std::vector<double> point(double a, double b, double c) { return {a, b, c}; }

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
    half_space h;
    all.write(below, h, 4);
    // -(1 + 2 d0 - d2) <= 0.5
    CHECK(h.normal == std::vector<double>{-2, 0, 1, 0});
    CHECK(h.reach == 1.5);
    signed_constraint const side{true, 0, 2, false};
    auto const function = h.name;
    all.write(side, h, 3);
    CHECK(h.normal == std::vector<double>{0, 0, -1});
    CHECK(h.reach == 1);
    CHECK(h.name != function);
}

TEST_CASE("the functions of a combination take part in a proof, bounds do not") {
    constraint_blocks all(3, blocks);
    std::vector<std::pair<std::uint64_t, double>> combination;
    for (signed_constraint const m :
         {signed_constraint{true, 0, 1, true}, signed_constraint{false, 1, 0, false},
          signed_constraint{false, 0, 1, true}}) {
        half_space h;
        all.write(m, h, 3);
        combination.emplace_back(h.name, 0.25);
    }
    auto const weights = constraint_blocks::weights(combination);
    REQUIRE(weights.size() == 2);
    CHECK((weights[0].block == 1 && weights[0].function == 0 && weights[0].value == -0.25));
    CHECK((weights[1].block == 0 && weights[1].function == 1 && weights[1].value == 0.25));
}
