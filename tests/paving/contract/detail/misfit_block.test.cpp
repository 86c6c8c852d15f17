// SPDX-License-Identifier: MIT
#include <sivid/paving/contract/detail/misfit_block.hpp>

#include "support/catch.hpp"
#include "support/polynomial_experiments.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

using namespace sivid;
using support::draws;
using support::polynomial_experiments;

TEST_CASE("the functions and their margins cover the misfits of all points of a part") {
    draws d(301);
    std::size_t looked = 0;
    for (int trial = 0; trial < 100; ++trial) {
        polynomial_experiments const e(d, 2, 5, d.uniform(0, 0.3), 0.02, 0);
        auto const part = e.part(d);
        shared_unknowns const unknowns(e.known, part);
        for (std::size_t s = 0; s < e.known.size(); ++s) {
            auto const& r = *e.known[s];
            auto const local = expand(r, part);
            auto const found =
                misfits_of(r, local, unknowns.places[s], 0.5, [](std::size_t y) { return y != 1; });
            auto const& f = found.functions;
            auto const ranges = output_ranges(r, local);
            REQUIRE(f.functions() == r.outputs());
            for (std::size_t y = 0; y < r.outputs(); ++y) {
                double const half = 0.5 * width(r.bounds[y]);
                CHECK(found.scale[y] == 1 / half);
                if (y == 1) {
                    CHECK(f.margin[y] == std::numeric_limits<double>::infinity());
                    continue;
                }
                ++looked;
                double spread = f.margin[y] - 0.5;
                for (std::size_t v = 0; v < f.variable.size(); ++v) {
                    spread += std::abs(f.slope[v * f.functions() + y]);
                }
                double const scale = found.scale[y], off = f.offset[y];
                CHECK_THAT((ranges[y].upper() - mid(r.bounds[y])) * scale,
                           WithinAbs(off + spread, 1e-6 * (1 + std::abs(off) + spread)));
                CHECK_THAT((ranges[y].lower() - mid(r.bounds[y])) * scale,
                           WithinAbs(off - spread, 1e-6 * (1 + std::abs(off) + spread)));
            }
        }
    }
    CHECK(looked > 300);
}

TEST_CASE("infinite bounds and rests are no functions") {
    draws d(302);
    polynomial_experiments const e(d, 1, 3, 0.1, 0.02, 0);
    auto const part = e.part(d);
    shared_unknowns const unknowns(e.known, part);
    auto r = *e.known[0];
    constexpr double infinite = std::numeric_limits<double>::infinity();
    r.bounds[0] = interval_traits<interval>::bounds(0, infinite);
    auto local = expand(r, part);
    local.rest[1] = infinite;
    std::size_t asked = 0;
    auto const found =
        misfits_of(r, local, unknowns.places[0], 1, [&](std::size_t) { return ++asked > 0; });
    CHECK(asked == r.outputs());
    CHECK(found.scale[0] == 0);
    for (std::size_t y : {0u, 1u}) {
        CHECK(found.functions.margin[y] == infinite);
        CHECK(found.functions.offset[y] == 0);
        for (std::size_t v = 0; v < found.functions.variable.size(); ++v) {
            CHECK(found.functions.slope[v * r.outputs() + y] == 0);
        }
    }
    CHECK(found.functions.margin[2] >= 1);
}
