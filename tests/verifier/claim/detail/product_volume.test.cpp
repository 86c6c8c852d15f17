// SPDX-License-Identifier: MIT
#include <sivid/paving/products/detail/preimage_volume.hpp>
#include <sivid/verifier/claim/detail/product_volume.hpp>

#include "io/small_identification.hpp"
#include "support/catch.hpp"
#include "support/power_series.hpp"
#include "support/products.hpp"

using namespace sivid;
using support::between;

TEST_CASE("the volume under a hyperbola is enclosed sharply") {
    auto problem = io_support::two_rates_problem();
    problem.prior = box{between(1, 3), between(1, 2)};
    auto const rebuilt = rebuild_products<interval>(problem, {"a*b"});
    REQUIRE(rebuilt.unproved.empty());
    product_volume<interval> const volume(rebuilt, problem.prior);
    // 2 <= a b <= 3: for every b in [1, 2], a in [2/b, 3/b], within [1, 3].
    auto const middle = volume({box{between(2, 3)}}, 1000);
    CHECK(support::encloses(middle, log(support::mp(2)) / 2));
    CHECK(width(middle) < 1e-6);
    // 5 <= a b <= 6: a in [5/b, 3], clipped: 3 (2 - 5/3) - 5 ln(2 / (5/3)) of 2.
    auto const corner = volume({box{between(5, 6)}}, 1000);
    CHECK(support::encloses(corner, (1 - 5 * log(support::mp(6) / 5)) / 2));
    CHECK(width(corner) < 1e-6);
    auto const whole = volume({box{between(1, 2)}, box{between(2, 6)}}, 1000);
    CHECK(contains(whole, 1.0));
    CHECK(width(whole) < 1e-6);
}

TEST_CASE("factors that are known, negative ones, and ratios") {
    auto problem = io_support::two_rates_problem();
    problem.prior = box{between(1, 3), interval(2.0)};
    auto const at_two = rebuild_products<interval>(problem, {"a*b"});
    // 3 <= 2 a <= 5 of a in [1, 3].
    auto const known = product_volume<interval>(at_two, problem.prior)({box{between(3, 5)}}, 100);
    CHECK(support::encloses(known, support::mp(0.5)));
    CHECK(width(known) < 1e-12);
    problem.prior = box{between(1, 3), between(-2, -1)};
    auto const below = rebuild_products<interval>(problem, {"a*b"});
    auto const mirrored =
        product_volume<interval>(below, problem.prior)({box{between(-6, -5)}}, 1000);
    CHECK(support::encloses(mirrored, (1 - 5 * log(support::mp(6) / 5)) / 2));
    CHECK(width(mirrored) < 1e-6);
    auto ratio = rebuild_products<interval>(problem, {"a/b"});
    ratio.unproved.clear(); // the volume of a set of ratios, whatever the equations
    auto const quotient =
        product_volume<interval>(ratio, problem.prior)({box{between(-1.5, -1)}}, 1000);
    // -a/b in [1, 1.5] with s = -b in [1, 2]: the integral of s/2 over [1, 2] of 2, none clipped.
    CHECK(support::encloses(quotient, support::mp(0.375)));
    CHECK(width(quotient) < 1e-6);
}

TEST_CASE("two ways to the volume of a preimage agree") {
    support::draws d(881);
    auto const map = support::reduction_of_products();
    auto const& prior = support::prior_of_products();
    auto original = map.problem();
    original.prior = prior;
    original.choice = {support::all_constants(3), {}};
    auto const rebuilt = rebuild_products<interval>(original, map.side_names());
    REQUIRE(rebuilt.malformed.empty());
    product_volume<interval> const anew(rebuilt, prior);
    preimage_volume const first(map, prior);
    for (int round = 0; round < 20; ++round) {
        auto const paving = support::random_paving(d, map.problem().prior);
        std::vector<box> some;
        for (auto const& b : paving.boxes()) {
            if (b.verdict == box_verdict::inside) some.push_back(b.set);
        }
        auto const a = anew(some, 200), b = first(some, 200);
        CHECK_FALSE(disjoint(a, b));
        CHECK(width(a) < 1e-3);
    }
}
