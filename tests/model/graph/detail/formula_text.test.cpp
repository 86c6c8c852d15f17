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

TEST_CASE("a formula is readable where it has few parts, and costs little where it has many") {
    graph g;
    expression const a(g, g.leaf(operation::constant, 0));
    CHECK(readable_formula(g, (a + sqr(a)).in(g), {{"a"}}) == "a + a^2");
    CHECK(readable_formula(g, (a + sqr(a)).in(g), {{"a"}}, 3) ==
          "something that is too long to be shown");
    auto root = a;
    for (int k = 0; k < 60; ++k) root = root - (root * root - 2) / (2 * root); // 5^60 parts
    CHECK(readable_formula(g, root.in(g), {{"a"}}) == "something that is too long to be shown");
}
