// SPDX-License-Identifier: MIT
#include <sivid/paving/contract/detail/oblique_products.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"

#include <cmath>
#include <cstddef>
#include <map>
#include <vector>

using namespace sivid;
using support::draws;

namespace {

double along(std::vector<double> const& q, std::vector<double> const& d) {
    double sum = 0;
    for (std::size_t v = 0; v < d.size(); ++v) sum += q[v] * d[v];
    return sum;
}

/// A function of a block at d and its products.
double value(minimax_block const& b, std::size_t function, std::vector<double> const& d,
             std::map<paving_detail::product, std::size_t> const& columns) {
    auto all = d;
    for (auto const& [product, column] : columns) {
        auto const [u, v] = product;
        all.push_back(u == v ? 2 * d[u] * d[u] - 1 : d[u] * d[v]);
    }
    double sum = b.offset[function];
    for (std::size_t v = 0; v < b.variable.size(); ++v)
        sum += b.slope[v * b.functions() + function] * all[b.variable[v]];
    return sum;
}

} // namespace

TEST_CASE("directions are orthogonal, and those that functions tell best come first") {
    // 3 d0 + 4 d1, and a little of d2
    minimax_block const b{{0, 1, 2}, {3, 0, 4, 0, 0, 0.1}, {0, 0}, {1, 1}};
    auto const q = oblique_products::directions(3, {b});
    REQUIRE(q.size() == 3);
    CHECK_THAT(std::abs(q[0][0]), WithinAbs(0.6, 1e-12));
    CHECK_THAT(std::abs(q[0][1]), WithinAbs(0.8, 1e-12));
    CHECK_THAT(std::abs(q[1][2]), WithinAbs(1, 1e-12));
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            CHECK_THAT(along(q[i], q[j]), WithinAbs(i == j ? 1 : 0, 1e-12));
    CHECK(oblique_products::directions(2, {}).size() == 2); // nothing tells anything
    CHECK(oblique_products::directions(2, {{{0}, {NAN}, {0}, {1}}}).empty());
}

TEST_CASE("products of points that keep the bounds keep the inequalities, others need not") {
    draws d(88);
    int kept = 0, broken = 0;
    for (int trial = 0; trial < 300; ++trial) {
        std::size_t const n = 1 + d.below(4);
        std::map<paving_detail::product, std::size_t> columns;
        std::size_t column = n;
        for (std::size_t u = 0; u < n; ++u)
            for (std::size_t v = u; v < n; ++v) columns[{u, v}] = column++;
        std::vector<oblique_products::combination> all;
        for (std::size_t i = 0; i < n; ++i) {
            std::vector<double> slope;
            for (std::size_t v = 0; v < n; ++v) slope.push_back(d.uniform(-1, 1));
            double const low = d.uniform(-1, 0.5);
            all.push_back({slope, low, d.uniform(low, 1)});
        }
        oblique_products products(all);
        auto const b = products.block(columns);
        for (int sample = 0; sample < 100; ++sample) {
            std::vector<double> x;
            for (std::size_t v = 0; v < n; ++v) x.push_back(d.uniform(-1, 1));
            bool inside = true;
            for (auto const& c : all)
                inside = inside && c.low <= along(c.slope, x) && along(c.slope, x) <= c.high;
            kept += inside ? 1 : 0;
            auto const k = d.below(b.functions());
            double const at = value(b, k, x, columns);
            double const above = at + b.margin[k]; // the inequality's left side
            if (inside) REQUIRE(above >= -1e-12);
            REQUIRE(at <= b.margin[k] + 1e-12);
            broken += above < 0 ? 1 : 0;
            // What a proof takes off is the same, and nowhere below what is bounded.
            combined_polynomial off(n);
            products.take_off(off, k, -0.5);
            REQUIRE(off.lower_bound() <= -0.5 * above + 1e-12);
            combined_polynomial none(n);
            products.take_off(none, k, 0.5);
            REQUIRE(none.lower_bound() == 0);
        }
    }
    CHECK(kept > 500);
    CHECK(broken > 500);
}

TEST_CASE("what is taken off bounds a parabola exactly") {
    // 0 <= (d + 0.5)(0.5 - d) = 0.25 - d^2: so -d^2 >= -0.25 where |d| <= 0.5.
    oblique_products products({{{1}, -0.5, 0.5}});
    std::map<paving_detail::product, std::size_t> const columns{{{0, 0}, 1}};
    auto const b = products.block(columns);
    // The function is scaled so that its largest slope is 1: 2 (0.25 - d^2).
    combined_polynomial p(1);
    p.add_product(0, 0, interval_traits<interval>::point(-1.0));
    products.take_off(p, 0, -0.5);
    CHECK_THAT(p.lower_bound(), WithinAbs(-0.25, 1e-12));
    CHECK_THAT(value(b, 0, {0.3}, columns) + b.margin[0], WithinAbs(2 * (0.25 - 0.09), 1e-12));
}
