// SPDX-License-Identifier: MIT
#include <sivid/paving/static/static_test.hpp>

#include "paving/static_models.hpp"
#include "support/catch.hpp"

#include <sivid/paving/invert.hpp>
#include <sivid/paving/static_inversion.hpp>

#include <numbers>

using namespace sivid;

TEST_CASE("the general search finds the ring, as the fast one does") {
    auto const problem = static_models::ring_problem();
    static_test test(problem);
    inversion_options options;
    options.accuracy = 1.0 / 512;
    options.sufficient_ratio = 1;
    auto const found = invert(test, problem.prior, options);
    double const inner = 100 * found.paving.inner_volume().lower();
    double const outer = 100 * found.paving.outer_volume().upper();
    CHECK(inner < std::numbers::pi);
    CHECK(std::numbers::pi < outer);
    CHECK(outer - inner < 0.5);
    static_inversion_options fast;
    fast.accuracy = 1.0 / 512;
    auto const flat = invert_static(problem, fast);
    CHECK(100 * flat.inner_volume().lower() < outer);
    CHECK(100 * (flat.inner_volume().upper() + flat.uncertain_volume().upper()) > inner);
}

TEST_CASE("boxes are judged and contracted") {
    auto const problem = static_models::ring_problem();
    static_test test(problem);
    CHECK(test(box{interval(0, 0.5), interval(0, 0.5)}).verdict == box_verdict::outside);
    CHECK(test(box{interval(1.1, 1.2), interval(0, 0.1)}).verdict == box_verdict::inside);
    auto const edge = test(box{interval(0.9, 1.2), interval(0, 0.1)});
    CHECK(edge.verdict == box_verdict::undecided);
    CHECK(edge.rest[0].lower() > 0.95);
    CHECK(edge.smear.size() == 2);
    // What was judged before does not matter.
    CHECK(test(box{interval(0, 0.5), interval(0, 0.5)}).verdict == box_verdict::outside);
}
