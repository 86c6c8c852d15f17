// SPDX-License-Identifier: MIT
#include <sivid/model/graph/detail/linear_solution.hpp>

#include <sivid/model/graph/detail/formula_text.hpp>
#include <sivid/model/graph/graph_range.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"

#include <Eigen/LU>

#include <cmath>

using namespace sivid;
using support::draws;

namespace {

using traits = interval_traits<interval>;

/// Equations whose entries are zeros, numbers, states and products of them.
linear_equations drawn(graph& g, draws& d, std::size_t n, std::size_t states, bool symmetric) {
    auto const entry = [&](double none) {
        if (d.uniform(0, 1) < none) return g.constant(0.0);
        auto const x = g.leaf(operation::state, d.below(states));
        switch (d.below(4)) {
        case 0:
            return g.constant(std::round(d.uniform(-8, 8)) / 4);
        case 1:
            return x;
        case 2:
            return g.mul(x, g.leaf(operation::state, d.below(states)));
        default:
            return g.unary(operation::cos, x);
        }
    };
    linear_equations e;
    double const none = d.uniform(0, 0.8);
    e.matrix.assign(n, std::vector<node_id>(n));
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
            e.matrix[i][j] = symmetric && j < i ? e.matrix[j][i] : entry(none);
        }
        // Pivots do not vanish where the diagonal dominates.
        if (symmetric) e.matrix[i][i] = g.add(g.constant(20.0), e.matrix[i][i]);
        e.right.push_back(entry(0.2));
    }
    return e;
}

/// Whether b lies in A y at a point, all in intervals.
void check_solution(graph const& g, linear_equations const& e, std::vector<node_id> const& y,
                    std::vector<double> const& at, std::size_t& checked) {
    auto nodes = y;
    for (auto const& row : e.matrix) nodes.insert(nodes.end(), row.begin(), row.end());
    nodes.insert(nodes.end(), e.right.begin(), e.right.end());
    graph_range range(g, nodes);
    range.evaluate({interval(0.0), point_box(at), {}, {}});
    for (auto const i : y) {
        if (range.undefined(i)) return; // singular there
    }
    ++checked;
    for (std::size_t i = 0; i < y.size(); ++i) {
        auto sum = traits::point(0.0);
        for (std::size_t j = 0; j < y.size(); ++j) {
            sum = traits::add(sum, traits::mul(range.value(e.matrix[i][j]), range.value(y[j])));
        }
        auto const b = range.value(e.right[i]);
        CHECK(sum.lower() <= b.upper());
        CHECK(b.lower() <= sum.upper());
        CHECK(width(sum) < 1e-6 * (1 + mag(sum)));
    }
}

/// Singular wherever one looks.
void check_singular(graph const& g, linear_equations const& e, draws& d) {
    auto const n = e.right.size();
    std::vector<node_id> nodes;
    for (auto const& row : e.matrix) nodes.insert(nodes.end(), row.begin(), row.end());
    graph_range range(g, nodes);
    for (int point = 0; point < 3; ++point) {
        std::vector<double> at;
        for (int i = 0; i < 3; ++i) at.push_back(d.uniform(-1.5, 1.5));
        range.evaluate({interval(0.0), point_box(at), {}, {}});
        Eigen::MatrixXd a(n, n);
        for (std::size_t k = 0; k < nodes.size(); ++k) {
            a(static_cast<Eigen::Index>(k / n), static_cast<Eigen::Index>(k % n)) =
                mid(range.value(nodes[k]));
        }
        CHECK(std::abs(a.determinant()) < 1e-9);
    }
}

} // namespace

TEST_CASE("what solve_linear gives solves the equations wherever it is defined") {
    draws d(91);
    std::size_t checked = 0, refused = 0;
    for (int round = 0; round < 400; ++round) {
        graph g;
        auto const n = 1 + d.below(7);
        bool const symmetric = n > 4 || d.coin();
        auto const e = drawn(g, d, n, 3, symmetric);
        CAPTURE(round, n, symmetric);
        std::vector<node_id> y;
        try {
            y = solve_linear(g, e, {});
        } catch (std::invalid_argument const&) {
            ++refused;
            CHECK_FALSE(symmetric);
            check_singular(g, e, d);
            continue;
        }
        REQUIRE(y.size() == n);
        for (int point = 0; point < 4; ++point) {
            std::vector<double> at;
            for (int i = 0; i < 3; ++i) at.push_back(d.uniform(-1.5, 1.5));
            check_solution(g, e, y, at, checked);
        }
    }
    CHECK(checked > 600);
    CHECK(refused > 5);
}

TEST_CASE("a matrix that is singular whatever its entries are is refused with the equation") {
    graph g;
    auto const x = g.leaf(operation::state, 0);
    auto const zero = g.constant(0.0), one = g.constant(1.0);
    CHECK_THROWS_WITH(solve_linear(g, {{{x, zero}, {one, zero}}, {one, one}, {"p'", "q'"}}, {}),
                      ContainsSubstring("singular") &&
                          ContainsSubstring("equation 2 (in the place of q')"));
    CHECK_THROWS_AS(solve_linear(g, {{{x, one}}, {one}}, {}), std::invalid_argument);
    CHECK_THROWS_AS(solve_linear(g, {{{x}, {one}}, {one, one}}, {}), std::invalid_argument);
}

TEST_CASE("equations that follow each other are solved in their order, without determinants") {
    graph g;
    auto const x = g.leaf(operation::state, 0);
    auto const zero = g.constant(0.0), one = g.constant(1.0);
    // y1 + x y0 = 1, y0 = x: given the wrong way round.
    auto const y = solve_linear(g, {{{x, one}, {one, zero}}, {one, x}}, {});
    leaf_names const names{{}, {"x"}};
    CHECK(formula_text(g, y[0], names) == "x");
    CHECK(formula_text(g, y[1], names) == "1 - x^2");
}

TEST_CASE("products that cancel in a determinant do not widen it") {
    graph g;
    auto const a = g.leaf(operation::constant, 0), b = g.leaf(operation::constant, 1),
               c = g.leaf(operation::constant, 2);
    auto const bc = g.mul(b, g.unary(operation::cos, g.leaf(operation::state, 0)));
    auto const off = g.add(c, bc);
    auto const one = g.constant(1.0);
    auto const literal_of = [](double v) { return literal{interval(v), v}; };
    auto const y =
        solve_linear(g, {{{g.add(a, g.mul(g.constant(2.0), bc)), off}, {off, c}}, {one, one}},
                     {literal_of(0.6), literal_of(0.12), literal_of(0.15)});
    auto const below = g[y[0]].b;
    CHECK(below == g[y[1]].b);
    graph_range range(g, {below});
    range.evaluate(
        {interval(0.0),
         box{traits::bounds(-10, 10)},
         box{traits::bounds(0.48, 0.72), traits::bounds(0.096, 0.144), traits::bounds(0.12, 0.18)},
         {}});
    CHECK(range.value(below).lower() > 0); // regular over a fifth about the nominal constants
    // What is not defined everywhere is left as it is: a factor that cancels might hide it.
    auto const root = g.unary(operation::sqrt, a);
    auto const w = solve_linear(g, {{{root, one}, {one, root}}, {one, one}}, {literal_of(1.0)});
    graph_range at(g, w);
    at.evaluate({interval(0.0), {}, box{traits::bounds(-2, -1)}, {}});
    CHECK(at.undefined(w[0]));
}
