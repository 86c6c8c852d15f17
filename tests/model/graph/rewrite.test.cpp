// SPDX-License-Identifier: MIT
#include <sivid/model/graph/rewrite.hpp>

#include "support/catch.hpp"
#include "support/formulas.hpp"

#include <cstddef>
#include <optional>
#include <vector>

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
        auto const image = copy_into(to, from, {*root, *root}, same_leaf{});
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

TEST_CASE("leaves of a kind are told by their numbers, once, and not below what is replaced") {
    graph g;
    auto const a = g.leaf(operation::constant, 3), b = g.leaf(operation::constant, 1);
    auto const x = g.leaf(operation::state, 0);
    (void)g.leaf(operation::constant, 2); // idle
    auto const inner = g.unary(operation::exp, g.mul(b, x));
    auto const root = g.add(g.mul(a, inner), g.mul(a, x));
    using numbers = std::vector<std::size_t>;
    CHECK(leaves_of(g, {root}, operation::constant) == numbers{3, 1});
    CHECK(leaves_of(g, {root, inner}, operation::state) == numbers{0});
    CHECK(leaves_of(g, {root}, operation::input).empty());
    CHECK(leaves_of(g, {root}, operation::constant, {{inner, std::nullopt}}) == numbers{3});
    CHECK(leaves_of(g, {inner}, operation::state, {{inner, x}}) == numbers{0});
}

TEST_CASE(
    "nodes that stand in for others are made of what they name, and nothing below is copied") {
    graph from;
    auto const x = from.leaf(operation::state, 0), p = from.leaf(operation::constant, 3);
    auto const z = from.unary(operation::sqr, x);
    auto const curve = from.unary(operation::sin, from.binary(operation::mul, p, z));
    auto const sum = from.binary(operation::add, curve, x);
    stand_ins const instead{{curve, z}};
    auto const needed = operands_of(from, {sum}, instead);
    CHECK(needed[z]);
    CHECK(needed[x]);
    CHECK_FALSE(needed[p]);
    auto const same = [](node const& n, graph& h) {
        REQUIRE(n.op != operation::constant);
        return h.leaf(n.op, static_cast<std::size_t>(n.index));
    };
    graph to;
    auto const image = copy_into(to, from, {sum, curve}, same, same_operation{}, instead,
                                 [&](node_id i, node_id of, graph& h) {
                                     CHECK(i == curve);
                                     return h.binary(operation::mul, h.constant(2.0), of);
                                 });
    graph expected; // 2 x^2 + x
    auto const y = expected.leaf(operation::state, 0);
    auto const twice =
        expected.binary(operation::mul, expected.constant(2.0), expected.unary(operation::sqr, y));
    (void)expected.binary(operation::add, twice, y);
    CHECK(to.size() == expected.size());
    CHECK(to[image[0]].op == operation::add);
    CHECK(to[image[1]].op == operation::mul);
    // Made of nothing.
    graph small;
    auto const number =
        copy_into(small, from, {sum}, same, same_operation{}, {{curve, std::nullopt}},
                  [](node_id, node_id, graph& h) { return h.constant(0.0); });
    CHECK(small[number[0]].op == operation::state);
}
