// SPDX-License-Identifier: MIT
#include <sivid/model/graph/tape.hpp>

#include "support/catch.hpp"
#include "support/formulas.hpp"

using namespace sivid;

TEST_CASE("a tape separates literals, parameters and what varies") {
    graph g;
    expression const x(g, g.leaf(operation::state, 0));
    expression const p(g, g.leaf(operation::constant, 0));
    (void)exp(expression(g, g.leaf(operation::state, 5))); // not needed
    tape const program(g, {(exp(p) * 2.5 * sin(x)).in(g), sqr(p).in(g)});
    CHECK(program.literals().size() == 1);
    CHECK(program.literals()[0].nearest == 2.5);
    CHECK(program.constant().size() == 4); // p, exp p, times 2.5, p^2
    CHECK(program.varying().size() == 4);  // x, sin x, its companion cos x, the product
    CHECK(program.slots() == 9);
    CHECK(program.output_varies(0));
    CHECK_FALSE(program.output_varies(1));
    for (auto const& i : program.varying()) {
        if (i.op == operation::mul) CHECK(i.a_varies != i.b_varies);
    }
}

TEST_CASE("operands are computed before they are used") {
    support::draws d(141);
    for (int round = 0; round < 200; ++round) {
        auto const f = support::random_formula(d, 12, false);
        graph g;
        auto const root = support::recorded_if_defined(f, g);
        if (!root) continue;
        tape const program(g, {*root});
        std::vector<bool> known(program.slots(), false);
        for (auto const s : program.literal_slots()) known[s] = true;
        bool ordered = true;
        auto const run = [&](std::vector<instruction> const& part) {
            for (auto const& i : part) {
                if (i.is_sum()) {
                    auto const* const terms = program.terms(i);
                    for (std::size_t n = 0; n < i.last_term - i.first_term; ++n) {
                        ordered = ordered && known[terms[n].a];
                        if (terms[n].product) ordered = ordered && known[terms[n].b];
                    }
                } else if (!is_leaf(i.op)) {
                    ordered = ordered && known[i.a];
                    if (is_binary(i.op)) ordered = ordered && known[i.b];
                }
                known[i.target] = true;
            }
        };
        run(program.constant());
        run(program.varying());
        CHECK(ordered);
        CHECK(known[program.output(0)]);
    }
}

TEST_CASE("sums of products are gathered, unless something else needs a part") {
    graph g;
    auto const state = [&g](std::size_t i) { return expression(g, g.leaf(operation::state, i)); };
    auto const x = state(0);
    auto const y = state(1);
    auto const z = state(2);
    auto const shared = x * z;
    auto const root = x * y - (shared + (z - y * z));
    tape const program(g, {root.in(g), sin(shared).in(g)});
    std::size_t sums = 0;
    for (auto const& i : program.varying()) {
        if (!i.is_sum()) continue;
        ++sums;
        auto const* const t = program.terms(i);
        REQUIRE(i.last_term - i.first_term == 4); // x y - shared - z + y z
        CHECK(t[0].product);
        CHECK_FALSE(t[0].minus);
        CHECK_FALSE(t[1].product);
        CHECK(t[1].minus);
        CHECK_FALSE(t[2].product);
        CHECK(t[2].minus);
        CHECK(t[3].product);
        CHECK_FALSE(t[3].minus);
    }
    CHECK(sums == 1);
}
