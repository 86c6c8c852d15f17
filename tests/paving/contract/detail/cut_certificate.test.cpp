// SPDX-License-Identifier: MIT
#include <sivid/paving/contract/detail/cut_certificate.hpp>

#include "support/catch.hpp"
#include "support/polynomial_experiments.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;
using support::polynomial_experiments;

TEST_CASE("whatever the weights, no feasible point lies beyond a certified reach") {
    draws d(211);
    int useful = 0;
    int refuted = 0;
    for (int trial = 0; trial < 400; ++trial) {
        polynomial_experiments const e(d, 1 + d.below(2), 3, d.uniform(0, 0.3), 0.02, 0);
        auto const part = e.part(d);
        shared_unknowns const unknowns(e.known, part);
        std::vector<measurement_weight> weights;
        for (std::size_t s = 0; s < e.known.size(); ++s) {
            for (std::size_t y = 0; y < 3; ++y) {
                if (d.coin()) weights.push_back({s, y, d.uniform(-2, 2)});
            }
        }
        std::size_t const j = d.below(2);
        bool const upwards = d.coin();
        double const reach = certified_reach(e.known, unknowns, weights, j, upwards);
        bool const empty = certified_empty(e.known, unknowns, weights);
        REQUIRE(reach <= 1);
        useful += reach < 1 ? 1 : 0;
        refuted += empty ? 1 : 0;
        for (int sample = 0; sample < 300; ++sample) {
            auto const p = d.in(part);
            if (!e.feasible(p, e.draw_starts(d))) continue;
            REQUIRE_FALSE(empty);
            double const at = (p[j] - mid(part[j])) / rad(part[j]);
            REQUIRE((upwards ? at : -at) <= reach + 1e-12);
        }
    }
    CHECK(useful > 10);
    CHECK(refuted > 10);
}
