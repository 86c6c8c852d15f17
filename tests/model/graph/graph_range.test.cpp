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
