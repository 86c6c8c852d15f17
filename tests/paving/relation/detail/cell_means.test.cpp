// SPDX-License-Identifier: MIT
#include <sivid/paving/relation/detail/cell_means.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/random.hpp"

#include <cmath>

using namespace sivid;
using support::between;

TEST_CASE("means over a cell contain those along lines, and frozen ones those without a rate") {
    graph g;
    expression const x(g, g.leaf(operation::state, 0)), r(g, g.leaf(operation::state, 1)),
        t(g, g.leaf(operation::time, 0));
    auto const f = (sin(x) * r + t).in(g);
    auto const set = integrand_set::of(g, {f}, 2, 0);
    support::draws d(3);
    for (int n = 0; n < 200; ++n) {
        double const from = d.uniform(0, 1), to = from + d.uniform(0.01, 0.3);
        double const x0 = d.uniform(-2, 2), x1 = x0 + d.uniform(-0.5, 0.5), r0 = d.uniform(-2, 2),
                     r1 = r0 + d.uniform(-0.5, 0.5), open = d.uniform(0, 0.1);
        leaf_ranges at{between(from, to),
                       box{between(std::min(x0, x1) - open, std::max(x0, x1) + open),
                           between(std::min(r0, r1), std::max(r0, r1))},
                       {},
                       {}};
        time_cell const cell{from,
                             to,
                             at,
                             {cell_line::of(x0, x1, between(-open, open)),
                              cell_line::of(r0, r1, interval(0.0)),
                              cell_line::of(from, to, interval(0.0))}};
        auto const means = means_over(set, {cell}, {{1, 0}});
        REQUIRE((means.size() == 1 && means[0].size() == 1));
        auto const& m = means[0][0];
        double const beside = d.uniform(-open, open);
        double sum = 0, frozen = 0, least = HUGE_VAL, most = -HUGE_VAL;
        for (int k = 0; k < 400; ++k) {
            double const s = (k + 0.5) / 400, xs = x0 + s * (x1 - x0) + beside,
                         rs = r0 + s * (r1 - r0), ts = from + s * (to - from);
            double const v = std::sin(xs) * rs + ts;
            sum += v / 400;
            frozen += (std::sin(xs) * (r0 + r1) / 2 + ts) / 400;
            least = std::min(least, v);
            most = std::max(most, v);
        }
        CHECK(m.whole.lower() - 1e-5 <= sum);
        CHECK(sum <= m.whole.upper() + 1e-5);
        CHECK(m.frozen.lower() - 1e-5 <= frozen);
        CHECK(frozen <= m.frozen.upper() + 1e-5);
        CHECK((most - least) / 2 <= m.swing + 1e-9);
        REQUIRE(m.slopes.size() == 1);
        CHECK(m.slopes[0].lower() <= std::sin(x0 + beside));
        CHECK(std::sin(x0 + beside) <= m.slopes[0].upper());
    }
    CHECK(contains(mean_product(between(1, 3), cell_line::of(-1, 1, interval(0.0))), 0.25));
}
