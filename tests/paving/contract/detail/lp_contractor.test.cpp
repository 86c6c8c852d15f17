// SPDX-License-Identifier: MIT
#include <sivid/paving/contract/detail/lp_contractor.hpp>

#include "support/catch.hpp"
#include "support/polynomial_experiments.hpp"

#include <cstddef>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;
using support::polynomial_experiments;

TEST_CASE("contraction by cuts removes no feasible point, outliers and starts included") {
    draws d(221);
    int contracted = 0;
    int refuted = 0;
    int kept = 0;
    for (int trial = 0; trial < 400; ++trial) {
        auto const q = d.below(3);
        polynomial_experiments const e(d, 1 + d.below(3), 3 + d.below(10), d.uniform(0, 0.3), 0.02,
                                       q);
        auto const part = e.part(d);
        auto rest = part;
        bool const left = lp_contractor()(e.known, rest);
        refuted += left ? 0 : 1;
        contracted += left && relative_volume(rest, part).upper() < 0.9 ? 1 : 0;
        if (left) CHECK(subset(rest, part));
        for (int sample = 0; sample < 300; ++sample) {
            auto const p = d.in(part);
            if (!e.feasible(p, e.draw_starts(d))) continue;
            ++kept;
            REQUIRE(left);
            REQUIRE(contains(rest, p));
        }
    }
    CHECK(contracted > 40);
    CHECK(refuted > 40);
    CHECK(kept > 1000);
}

TEST_CASE("measurements that say little one by one cut together") {
    // p0 + p1 and p0 - p1 within 0.1 of zero: each alone allows all of both sides.
    box const prior{between(-1, 1), between(-1, 1)};
    response r{normalised_unknowns(box{}, prior),
               std::make_shared<monomial_table const>(
                   monomial_table::of(sivid::monomial_space::of(2, 1), 2)),
               {},
               {0, 0},
               {},
               {between(-0.1, 0.1), between(-0.1, 0.1)},
               2,
               0};
    for (auto const& e : r.table->exponents) {
        r.coefficients.push_back(e[0] + e[1]);
        r.coefficients.push_back(e[0] - e[1]);
    }
    response_list const known{std::make_shared<response const>(r)};
    auto rest = prior;
    REQUIRE(lp_contractor()(known, rest));
    for (auto const& side : rest) {
        CHECK(side.upper() < 0.1001);
        CHECK(side.lower() > -0.1001);
        CHECK(contains(side, 0.0999));
    }
    // With an outlier allowed either may be wrong: nothing is cut.
    r.allowed = 1;
    rest = prior;
    REQUIRE(lp_contractor()({std::make_shared<response const>(r)}, rest));
    CHECK(width(rest) >= 2);
}
