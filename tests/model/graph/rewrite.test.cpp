// SPDX-License-Identifier: MIT
#include <sivid/model/graph/rewrite.hpp>

#include "support/catch.hpp"
#include "support/formulas.hpp"

using namespace sivid;
using support::draws;
using support::encloses;

TEST_CASE("a copied graph has the values of the original") {
    draws d(121);
    int compared = 0;
    for (int round = 0; round < 300; ++round) {
        auto const f = support::random_formula(d, 8, false);
        graph from;
        auto const root = support::recorded_if_defined(f, from);
        if (!root) continue;
        graph to;
        (void)to.leaf(operation::input, 7); // node numbers differ
        auto const same = [](node const& n, graph& h) {
            return h.leaf(n.op, static_cast<std::size_t>(n.index));
        };
        auto const image = copy_into(to, from, {*root, *root}, same);
        REQUIRE(image.size() == 2);
        CHECK(image[0] == image[1]);
        auto const where = support::random_places(d, 0.3);
        auto const a = support::evaluate(from, {*root}, where);
        auto const b = support::evaluate(to, {image[0]}, where);
        CHECK(a.undefined == b.undefined);
        try {
            auto const exact = support::exact_value(f, support::random_place(d, where));
            CHECK(encloses(b.outputs[0], exact));
            ++compared;
        } catch (support::not_defined const&) {
        } catch (support::too_large const&) {
        }
    }
    CHECK(compared > 50);
}

TEST_CASE("replacing leaves lets the rules act again") {
    graph from;
    expression const x(from, from.leaf(operation::state, 0));
    expression const p(from, from.leaf(operation::constant, 0));
    auto const root = (p * x + p * p).in(from);
    graph to;
    auto const zero = [](node const& n, graph& h) {
        return n.op == operation::constant ? h.constant(0.0) : h.leaf(n.op, 0);
    };
    CHECK(to.is(copy_into(to, from, {root}, zero)[0], 0));
    graph other;
    auto const two = [](node const& n, graph& h) {
        return n.op == operation::constant ? h.constant(2.0) : h.leaf(n.op, 0);
    };
    auto const image = copy_into(other, from, {root}, two)[0];
    support::place_box where;
    where.x[0] = interval(3.0);
    CHECK(support::evaluate(other, {image}, where).outputs[0].lower() == 10);
}

TEST_CASE("reachable nodes include companions and nothing idle") {
    graph g;
    auto const x = g.leaf(operation::state, 0);
    auto const idle = g.unary(operation::exp, g.leaf(operation::state, 1));
    auto const s = g.unary(operation::sin, x);
    auto const needed = reachable(g, {s});
    CHECK(needed[s]);
    CHECK(needed[g[s].companion]);
    CHECK(needed[x]);
    CHECK_FALSE(needed[idle]);
}
