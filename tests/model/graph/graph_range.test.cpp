// SPDX-License-Identifier: MIT
#include <sivid/model/graph/graph_range.hpp>

#include "diagnosis/planted_motion.hpp"
#include "support/catch.hpp"

using namespace diagnosis_support;

TEST_CASE("ranges contain the values at points of the leaves") {
    draws d(1);
    auto const m = pendulum(0.3);
    double_rates rate(m);
    graph_range range(m.g, m.rate);
    for (int n = 0; n < 200; ++n) {
        leaf_ranges at{between(0, 1), box{d.interval(-3, 3, 1), d.interval(-3, 3, 1)},
                       box{d.interval(0, 3, 1), d.interval(0, 1, 1), d.interval(0, 1, 1)},
                       box{d.interval(-1, 1, 1)}};
        range.evaluate(at);
        auto const f = rate(0.5, d.in(at.states), d.in(at.constants), d.in(at.inputs));
        for (std::size_t i = 0; i < f.size(); ++i) {
            auto const& enclosed = range.value(m.rate[i]);
            CHECK(enclosed.lower() - 1e-12 <= f[i]);
            CHECK(f[i] <= enclosed.upper() + 1e-12);
            CHECK_FALSE(range.undefined(m.rate[i]));
        }
    }
}

TEST_CASE("what may be undefined is said, also of what is made of it") {
    graph g;
    expression const x(g, g.leaf(operation::state, 0));
    auto const root = sqrt(x).in(g);
    auto const sum = (sqrt(x) + 1).in(g);
    auto const apart = (x + 1).in(g);
    graph_range range(g, {root, sum, apart});
    range.evaluate({interval(0.0), box{between(-1, 4)}, {}, {}});
    CHECK(range.undefined(root));
    CHECK(range.undefined(sum));
    CHECK_FALSE(range.undefined(apart));
    CHECK(range.value(sum).upper() >= 3);
    range.evaluate({interval(0.0), box{between(1, 4)}, {}, {}});
    CHECK_FALSE(range.undefined(sum));
}

TEST_CASE("a direction never leaves -1 to 1, and lies where it is") {
    draws d(2);
    graph g;
    expression const x(g, g.leaf(operation::state, 0));
    expression const y(g, g.leaf(operation::state, 1));
    expression const c(g, g.leaf(operation::constant, 0));
    auto const length = sqrt(sqr(x) + sqr(c) + sqr(y));
    struct form {
        expression value;
        double (*exact)(double x, double y, double c);
    };
    auto const unit = [](double a, double b, double k) {
        return a / std::sqrt(a * a + b * b + k * k);
    };
    std::vector<form> const forms{
        {x / length, +unit},
        {c * x / length,
         [](double a, double b, double k) { return k * a / std::sqrt(a * a + b * b + k * k); }},
        {c / length * x / (c + 5),
         [](double a, double b, double k) {
             return k * a / std::sqrt(a * a + b * b + k * k) / (k + 5);
         }},
        {x * x / length,
         [](double a, double b, double k) { return a * a / std::sqrt(a * a + b * b + k * k); }},
        {x / sqrt(sqr(x) - sqr(y)),
         [](double a, double b, double) { return a / std::sqrt(a * a - b * b); }}};
    std::vector<node_id> roots;
    for (auto const& f : forms) roots.push_back(f.value.in(g));
    graph_range range(g, roots);
    for (int n = 0; n < 3000; ++n) {
        double const size = d.coin() ? 1 : 1e-3;
        leaf_ranges const at{interval(0.0),
                             box{d.interval(-size, size, size), d.interval(-size, size, size)},
                             box{d.interval(0, size, d.coin() ? 0 : size)},
                             {}};
        range.evaluate(at);
        for (int k = 0; k < 4; ++k) {
            auto const s = d.in(at.states);
            auto const p = d.in(at.constants)[0];
            for (std::size_t f = 0; f < forms.size(); ++f) {
                double const v = forms[f].exact(s[0], s[1], p);
                auto const& enclosed = range.value(roots[f]);
                if (!std::isfinite(v)) continue;
                CHECK(enclosed.lower() <= v + 1e-12 * std::abs(v));
                CHECK(v - 1e-12 * std::abs(v) <= enclosed.upper());
            }
        }
        if (!range.undefined(roots[0]) && at.constants[0].lower() > 0) {
            CHECK(mag(range.value(roots[0])) <= 1);
        }
    }
    range.evaluate(
        {interval(0.0), box{between(-1, 1), between(0, 0)}, box{between(0.01, 0.01)}, {}});
    CHECK(mag(range.value(roots[0])) < 1);
    CHECK(mag(range.value(roots[1])) < 0.011);
}

TEST_CASE("factors that stand in a node very often are not counted out") {
    graph g;
    expression x(g, g.leaf(operation::state, 0));
    expression const y(g, g.leaf(operation::state, 1));
    auto product = x;
    auto sum = sqr(x);
    for (int k = 0; k < 60; ++k) { // 2^60 factors, 2^60 summands
        product = product * (product * y);
        sum = sum + (sum + y);
    }
    auto const root = (product * x / sqrt(sum)).in(g);
    graph_range range(g, {root});
    range.evaluate({interval(0.0), box{between(1, 1), between(1, 1)}, {}, {}});
    CHECK(range.value(root).lower() > 0);
    auto deep = x;
    for (int k = 0; k < 100000; ++k) deep = deep * y;
    graph_range const long_one(g, {deep.in(g)}); // no deep recursion
}
