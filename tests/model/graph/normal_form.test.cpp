// SPDX-License-Identifier: MIT
#include <sivid/model/expression.hpp>
#include <sivid/model/graph/normal_form.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

using namespace sivid;
using support::draws;

namespace {

constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();
using separated = multiplied_out<function_coefficients>;

struct leaves {
    graph g;
    std::vector<expression> p, x;

    explicit leaves(std::size_t parameters) {
        for (std::size_t j = 0; j < parameters; ++j)
            p.emplace_back(g, g.leaf(operation::constant, j));
        for (std::size_t i = 0; i < 2; ++i) x.emplace_back(g, g.leaf(operation::state, i));
    }
};

/// Values of all nodes, in plain doubles.
std::vector<double> values(graph const& g, std::vector<double> const& p,
                           std::vector<double> const& x) {
    std::vector<double> v(g.size());
    for (std::size_t k = 0; k < g.size(); ++k) {
        auto const& n = g.nodes()[k];
        auto const index = static_cast<std::size_t>(n.index);
        bool undefined = false;
        v[k] = n.op == operation::literal    ? g.value(n).nearest
               : n.op == operation::constant ? p[index]
               : is_leaf(n.op)
                   ? x[index]
                   : apply<approximate_arithmetic>(n.op, v[n.a], v[is_binary(n.op) ? n.b : n.a],
                                                   n.index, undefined);
    }
    return v;
}

/// A random expression of leaves.
expression grown(draws& d, leaves& l, int depth) {
    if (depth == 0) {
        return d.below(3) == 0 ? l.x[d.below(2)]
               : d.coin()      ? l.p[d.below(l.p.size())]
                               : expression(0.5 * static_cast<double>(1 + d.below(4)));
    }
    auto const a = grown(d, l, depth - 1);
    auto const b = grown(d, l, depth - 1);
    switch (d.below(9)) {
    case 0:
    case 1:
        return a + b;
    case 2:
        return a - b;
    case 3:
    case 4:
        return a * b;
    case 5:
        return a / (b + 3);
    case 6:
        return pown(a, 3);
    case 7:
        return sqr(a) - b;
    default:
        return sin(a) * b;
    }
}

} // namespace

TEST_CASE("the terms of a node add up to it, and no factor or coefficient is what it must not be") {
    draws d(91);
    std::size_t checked = 0, several = 0;
    for (int trial = 0; trial < 400; ++trial) {
        leaves l(3);
        auto const root = grown(d, l, 4).in(l.g);
        separated multiplied(function_coefficients(l.g), {unlimited, 64});
        auto const terms = multiplied(root);
        std::vector<double> const p{d.uniform(0.3, 1), d.uniform(0.3, 1), d.uniform(0.3, 1)};
        std::vector<double> const x{d.uniform(0.3, 1), d.uniform(0.3, 1)};
        auto const v = values(l.g, p, x);
        double sum = 0, size = 0;
        for (auto const& [product, coefficient] : terms) {
            double term = v[coefficient];
            for (auto const& [factor, e] : product) {
                CHECK(l.g.depends(factor) == on_constant);
                CHECK(e != 0);
                term *= std::pow(v[factor], e);
            }
            sum += term;
            size += std::abs(term);
        }
        several += terms.size() > 3 ? 1 : 0;
        if (!std::isfinite(size) || size > 1e6) continue;
        ++checked;
        CHECK_THAT(sum, WithinAbs(v[root], 1e-10 * (1 + size)));
    }
    CHECK(checked > 300);
    CHECK(several > 50);
}

TEST_CASE("what does not multiply out is named") {
    leaves l(2);
    auto const sine = sin(l.p[0] * l.x[0]);
    auto const divisor = l.p[0] + l.p[1] * l.x[0];
    auto const root = (l.p[1] * sine + l.p[0] / divisor).in(l.g);
    separated multiplied(function_coefficients(l.g), {unlimited, 64});
    CHECK(multiplied(root).size() == 2);
    CHECK(multiplied.opaque() == std::set<node_id>{sine.in(l.g), divisor.in(l.g)});
    CHECK(multiplied.indivisible(sine.in(l.g)));
    CHECK_FALSE(multiplied.indivisible(divisor.in(l.g))); // it has terms of its own
    CHECK_FALSE(multiplied.indivisible(root));
}

TEST_CASE("too many products, and powers that are too large, are left as they are") {
    leaves l(8);
    auto sum = l.p[0] * l.x[0];
    for (std::size_t j = 1; j < 8; ++j) sum = sum + l.p[j] * l.x[j % 2];
    auto const product = (sum * (sum + 1)).in(l.g);
    separated few(function_coefficients(l.g), {unlimited, 64});
    CHECK(few(product).size() == 1);
    CHECK(few.indivisible(product));
    separated many(function_coefficients(l.g), {unlimited, 100});
    CHECK(many(product).size() == 44); // 36 of two factors, 8 of one
    separated short_sums(function_coefficients(l.g), {40, 100});
    CHECK(short_sums(product).size() == 1);

    auto power = l.p[0];
    for (int k = 0; k < 20; ++k) power = sqr(power);
    auto const largest = power.in(l.g), next = sqr(power).in(l.g), times = (power * l.p[0]).in(l.g);
    separated multiplied(function_coefficients(l.g), {unlimited, 64});
    CHECK(multiplied(largest).begin()->first == node_product{{l.p[0].in(l.g), most_power}});
    CHECK(multiplied(next).begin()->first == node_product{{next, 1}});
    CHECK(multiplied(times).begin()->first == node_product{{times, 1}});
}

TEST_CASE("common factors cancel") {
    node_product const a{{2, 3}, {5, -1}}, b{{2, 3}, {4, 1}};
    CHECK(quotient(a, b) == node_product{{4, -1}, {5, -1}});
    CHECK(quotient(a, b, 1) == node_product{{2, 6}, {4, 1}, {5, -1}});
    CHECK(quotient(a, a).empty());
}

TEST_CASE("a sum of a hundred thousand terms needs no deep stack") {
    leaves l(1);
    auto sum = l.p[0];
    for (int k = 0; k < 100000; ++k) sum = l.x[0] * sin(sum) + l.p[0];
    separated multiplied(function_coefficients(l.g), {unlimited, 64});
    CHECK(multiplied(sum.in(l.g)).size() == 2);
}
