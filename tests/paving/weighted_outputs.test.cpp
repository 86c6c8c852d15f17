// SPDX-License-Identifier: MIT
#include <sivid/paving/weighted_outputs.hpp>

#include "support/catch.hpp"
#include "support/polynomial_experiments.hpp"

#include <cstddef>
#include <vector>

using namespace sivid;
using support::draws;
using support::polynomial_experiments;

TEST_CASE("a certificate of any weights excludes no feasible point and does exclude others") {
    draws d(2113);
    int excluded = 0, also = 0;
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
        bool const none = weighted_outputs<interval>(e.known, part, weights).positive();
        excluded += none ? 1 : 0;
        also += none && certified_inflation(e.known, unknowns, weights) > 1 ? 1 : 0;
        for (int sample = 0; sample < 300 && none; ++sample) {
            REQUIRE_FALSE(e.feasible(d.in(part), e.draw_starts(d)));
        }
    }
    CHECK(excluded > 10);
    CHECK(also > excluded / 2); // the search's certificate says the same of most
}

TEST_CASE("no weights prove nothing") {
    draws d(2114);
    polynomial_experiments const e(d, 1, 3, 0.1, 0.02, 0);
    CHECK_FALSE(weighted_outputs<interval>(e.known, e.part(d), {}).positive());
}
