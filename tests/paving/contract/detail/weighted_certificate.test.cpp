// SPDX-License-Identifier: MIT
#include <sivid/paving/contract/detail/weighted_certificate.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/random.hpp"

#include "support/polynomial_experiments.hpp"
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;

namespace {

/// Two outputs of one parameter: c0 + c1 q + c2 q^2 each.
std::shared_ptr<response const> two_parabolas(box const& region, std::vector<double> const& first,
                                              std::vector<double> const& second,
                                              std::vector<interval> const& bounds, double radius) {
    response r{normalised_unknowns(box{}, region),
               std::make_shared<monomial_table const>(
                   monomial_table::of(sivid::monomial_space::of(1, 2), 1)),
               {},
               {radius, radius},
               {},
               bounds,
               2,
               0};
    for (std::size_t m = 0; m < 3; ++m) {
        r.coefficients.push_back(first[m]);
        r.coefficients.push_back(second[m]);
    }
    return std::make_shared<response const>(std::move(r));
}

} // namespace

TEST_CASE("whatever the weights, no more is certified than is true") {
    draws d(95);
    int useful = 0;
    for (int trial = 0; trial < 300; ++trial) {
        // Each experiment knows of another region around the same part.
        box const part{between(0.5, 1)};
        response_list known;
        std::vector<measurement_weight> weights;
        for (std::size_t s = 0; s < 2; ++s) {
            box const region{between(d.uniform(-1, 0.5), d.uniform(1, 2))};
            auto const c = [&] {
                return std::vector{d.uniform(-3, 3), d.uniform(-1, 1), d.uniform(-1, 1)};
            };
            known.push_back(
                two_parabolas(region, c(), c(), {between(-0.25, 0.25), between(0, 1)}, 0.015625));
            for (std::size_t y = 0; y < 2; ++y) weights.push_back({s, y, d.uniform(-1, 1)});
        }
        double const lower = certified_inflation(known, shared_unknowns(known, part), weights);
        useful += lower > 0 ? 1 : 0;
        for (int sample = 0; sample <= 50; ++sample) {
            double const p = 0.5 + 0.01 * sample;
            double worst = 0;
            for (auto const& r : known) {
                auto const& side = r->unknowns.parameters[0];
                double const q = (p - side.centre) / side.radius;
                for (std::size_t y = 0; y < 2; ++y) {
                    double const value = r->coefficients[y] + r->coefficients[2 + y] * q +
                                         r->coefficients[4 + y] * q * q;
                    double const off = std::abs(value - mid(r->bounds[y])) - r->radius[y];
                    worst = std::max(worst, off / rad(r->bounds[y]));
                }
            }
            REQUIRE(lower <= worst * (1 + 1e-12) + 1e-12);
        }
    }
    CHECK(useful > 60);
}

TEST_CASE("opposite curvatures cancel in a certificate") {
    box const part{between(-1, 1)};
    // Both are 3 q^2: one measured 1 above, one 1 below; e = 1/4.
    response_list const known{
        two_parabolas(part, {0, 0, 3}, {2, 0, 3}, {between(-0.25, 0.25), between(-0.25, 0.25)}, 0)};
    shared_unknowns const unknowns(known, part);
    CHECK_THAT(certified_inflation(known, unknowns, {{0, 0, -1}, {0, 1, 1}}), WithinAbs(4, 1e-9));
    CHECK(certified_inflation(known, unknowns, {{0, 0, -1}}) == 0);
    CHECK_THAT(certified_inflation(known, unknowns, {{0, 1, 2}}), WithinAbs(8, 1e-9));
    CHECK(certified_inflation(known, unknowns, {}) == 0);
}

TEST_CASE("unknowns: parameters are shared, starts are not, points have none") {
    box const region{between(0, 2), interval(1.0), between(0, 4)};
    auto const about = [&](box const& start) {
        response r{normalised_unknowns(start, region), nullptr, {}, {}, {}, {}, 0, 0};
        r.table = std::make_shared<monomial_table const>(
            monomial_table::of(sivid::monomial_space::of(4, 1), r.unknowns.variables));
        return std::make_shared<response const>(std::move(r));
    };
    response_list const known{about({between(0, 1), interval(0.0)}),
                              about({between(0, 1), between(0, 1)})};
    shared_unknowns const unknowns(known, {between(0, 1), interval(1.0), between(3, 4)});
    CHECK(unknowns.count == 6);
    REQUIRE(unknowns.places[0].size() == 3);
    REQUIRE(unknowns.places[1].size() == 4);
    CHECK(unknowns.places[0][0].unknown == 0);
    CHECK(unknowns.places[0][1].unknown == 2);
    CHECK(unknowns.places[0][2].unknown == 3);
    CHECK(unknowns.places[1][2].unknown == 4);
    CHECK(unknowns.places[1][3].unknown == 5);
    CHECK(contains(unknowns.places[0][0].middle, -0.5));
    CHECK(contains(unknowns.places[0][0].reach, 0.5));
    CHECK(contains(unknowns.places[0][1].middle, 0.75));
    CHECK(contains(unknowns.places[0][1].reach, 0.25));
}

using support::polynomial_experiments;

TEST_CASE("whatever the weights, no feasible point lies beyond a certified reach") {
    draws d(211);
    int useful = 0;
    int refuted = 0;
    for (int trial = 0; trial < 400; ++trial) {
        polynomial_experiments const e(d, 1 + d.below(2), 3, d.uniform(0, 0.3), 0.02, 0);
        auto const part = e.part(d);
        shared_unknowns const unknowns(e.known, part);
        auto const weights = e.draw_weights(d);
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
