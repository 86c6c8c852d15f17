// SPDX-License-Identifier: MIT
#include <sivid/model/expression.hpp>

#include "support/catch.hpp"
#include "support/formulas.hpp"
#include "support/models.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>

using namespace sivid;
using namespace sivid::literals;
using support::encloses;
using support::mp;

TEST_CASE("literals stand for their exact values") {
    graph g;
    auto const literal_of = [&g](expression const& e) { return g.value(g[e.in(g)]); };
    CHECK(is_point(literal_of(0.1).enclosure));
    CHECK(literal_of(0.1).enclosure.lower() == 0.1);
    CHECK_FALSE(is_point(literal_of(0.1_dec).enclosure));
    CHECK(encloses(literal_of(0.1_dec).enclosure, mp("0.1")));
    CHECK(literal_of(0.1_dec).nearest == 0.1);
    CHECK(is_point(literal_of(3).enclosure));
    CHECK(literal_of(support::between(1, 3)).nearest == 2);
}

TEST_CASE("an expression neither compares nor converts to a number") {
    STATIC_REQUIRE_FALSE(std::is_convertible_v<expression, bool>);
    STATIC_REQUIRE_FALSE(std::is_convertible_v<expression, double>);
    STATIC_REQUIRE_FALSE(std::is_constructible_v<bool, expression>);
}

TEST_CASE("an expression refuses values that are no numbers") {
    double const nan = std::numeric_limits<double>::quiet_NaN();
    graph g;
    expression const x(g, g.leaf(operation::state, 0));
    (void)g.constant(5.0);
    CHECK_THROWS_AS(x + expression(nan), std::domain_error);
    CHECK_THROWS_AS(x + expression(HUGE_VAL), std::domain_error);
    CHECK_THROWS_AS(x + expression(interval_traits<interval>::empty()), std::domain_error);
    CHECK_THROWS_AS(expression(nan).in(g), std::domain_error);
    CHECK_THROWS_AS(expression(nan) + 1.0, std::domain_error);
}

TEST_CASE("expressions of different recordings do not mix") {
    graph g;
    graph h;
    expression const x(g, g.leaf(operation::state, 0));
    expression const y(h, h.leaf(operation::state, 0));
    CHECK_THROWS_AS(x + y, std::logic_error);
    CHECK_THROWS_AS(y.in(g), std::logic_error);
    CHECK((x + 1.0).in(g) == (1.0 + x).in(g));
}

TEST_CASE("saturation and dead band have the values of the number floor") {
    graph g;
    expression const x(g, g.leaf(operation::state, 0));
    auto const s = saturate(x, -1, 2).in(g);
    auto const b = deadband(x, 0.5).in(g);
    for (double const v : {-3.0, -1.0, -0.5, -0.25, 0.0, 0.25, 0.5, 1.0, 2.0, 3.0}) {
        support::place_box where;
        where.x[0] = interval(v);
        auto const e = support::evaluate(g, {s, b}, where);
        CHECK(e.outputs[0].lower() == std::fmin(std::fmax(v, -1.0), 2.0));
        CHECK(is_point(e.outputs[0]));
        double const band = v > 0.5 ? v - 0.5 : v < -0.5 ? v + 0.5 : 0;
        CHECK(e.outputs[1].lower() == band);
        CHECK(e.outputs[1].upper() == band);
    }
}

TEST_CASE("integer powers of expressions") {
    graph g;
    expression const x(g, g.leaf(operation::state, 0));
    for (int n = -5; n <= 7; ++n) {
        support::place_box where;
        where.x[0] = interval(-1.5);
        auto const y = support::evaluate(g, {pown(x, n).in(g)}, where).outputs[0];
        CAPTURE(n);
        CHECK(encloses(y, support::real::pown(mp(-1.5), n)));
        CHECK(width(y) < 1e-13);
    }
}

TEST_CASE("large powers are recorded without a deep stack, larger ones are refused") {
    graph g;
    expression const x(g, g.leaf(operation::state, 0));
    auto const y = pown(x, 100000).in(g);
    auto const nodes = g.size();
    CHECK(pown(x, 100000).in(g) == y);
    CHECK(pown(x, 50000).in(g) == g[y].companion);
    CHECK(g.size() == nodes);
    CHECK(pown(expression(2.0), -4).in(g) == g.constant(0.0625));
    for (int const n : {most_power + 1, -most_power - 1, std::numeric_limits<int>::max(),
                        std::numeric_limits<int>::min()}) {
        CHECK_THROWS_WITH(pown(x, n), ContainsSubstring("a power of " + std::to_string(n)));
        CHECK_THROWS_AS(pown(expression(1.0), n), std::invalid_argument);
    }
}

TEST_CASE("compound assignment") {
    graph g;
    expression x(g, g.leaf(operation::state, 0));
    auto const start = x;
    x += 2;
    x *= 3;
    x -= 1;
    x /= 4;
    CHECK(x.in(g) == (((start + 2) * 3 - 1) / 4).in(g));
    CHECK((+x).in(g) == x.in(g));
}
