// SPDX-License-Identifier: MIT
#include <sivid/model/graph/detail/formula_text.hpp>

#include <sivid/model/expression.hpp>

#include "support/catch.hpp"

using namespace sivid;

TEST_CASE("formulas of constants as text, with the brackets that they need") {
    graph g;
    expression const a(g, g.leaf(operation::constant, 0));
    expression const b(g, g.leaf(operation::constant, 1));
    auto const text = [&](expression const& e) { return formula_text(g, e.in(g), {{"a", "b"}}); };
    CHECK(text(a) == "a");
    CHECK(text(expression(2.5)) == "2.5");
    CHECK(text(a + b * b) == "a + b^2");
    CHECK(text((a + b) * b) == "b * (a + b)");
    CHECK(text(a - (b - a)) == "a - (b - a)");
    CHECK(text(a / (b / a)) == "a / (b / a)");
    CHECK(text(a / b / a) == "a / b / a");
    CHECK(text(sqr(a + b)) == "(a + b)^2");
    CHECK(text(pown(-a, 3)) == "(-a)^3");
    CHECK(text(-(a + b)) == "-(a + b)");
    CHECK(text(sqrt(a / b)) == "sqrt(a / b)");
    CHECK(text(max(a, b)) == "max(a, b)");
    CHECK(text(4 * atan(expression(1.0)) * sqr(a) / 4) == "3.141592653589793 * a^2 / 4");
}
