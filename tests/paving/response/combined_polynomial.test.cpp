// SPDX-License-Identifier: MIT
#include <sivid/paving/response/combined_polynomial.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/random.hpp"
#include "support/sweep.hpp"
#include "support/taylor_models.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;
using support::rational;

namespace {

/// Outputs that are polynomials in three parameters.
response random_response(draws& d, std::size_t outputs, double curvature, double radius) {
    response r{normalised_unknowns(box{}, box{between(-1, 1), between(-1, 1), between(-1, 1)}),
               std::make_shared<monomial_table const>(
                   monomial_table::of(sivid::monomial_space::of(3, 4), 3)),
               {},
               {},
               {},
               std::vector<interval>(outputs, interval(0.0)),
               outputs,
               0};
    auto const& table = *r.table;
    for (std::size_t m = 0; m < table.size(); ++m) {
        std::size_t degree = 0;
        for (auto const e : table.exponents[m]) degree += e;
        for (std::size_t y = 0; y < outputs; ++y) {
            r.coefficients.push_back(d.uniform(-1, 1) * (degree > 1 ? curvature : 1));
        }
    }
    for (std::size_t y = 0; y < outputs; ++y) r.radius.push_back(d.uniform(0, radius));
    return r;
}

rational value(response const& r, std::size_t y, std::vector<rational> const& q) {
    rational sum = 0;
    for (std::size_t m = 0; m < r.table->size(); ++m) {
        rational term(r.coefficients[m * r.outputs() + y]);
        for (std::size_t v = 0; v < q.size(); ++v) {
            for (std::size_t k = 0; k < r.table->exponents[m][v]; ++k) term *= q[v];
        }
        sum += term;
    }
    return sum;
}

/// One variable, one output with these coefficients.
combined_polynomial of_one(std::vector<double> const& c) {
    response r{normalised_unknowns(box{}, box{between(-1, 1)}),
               std::make_shared<monomial_table const>(
                   monomial_table::of(sivid::monomial_space::of(1, 4), 1)),
               c,
               {0},
               {},
               {interval(0.0)},
               1,
               0};
    combined_polynomial p(1);
    p.add(r, {{0, 1.0}}, {combined_polynomial::place{}});
    return p;
}
/// c0 + cu u + cv v + uu u^2 + uv u v + vv v^2, in graded order.
combined_polynomial of_two(std::vector<double> const& c) {
    response r{normalised_unknowns(box{}, box{between(-1, 1), between(-1, 1)}),
               std::make_shared<monomial_table const>(
                   monomial_table::of(sivid::monomial_space::of(2, 2), 2)),
               std::vector<double>(6, 0.0),
               {0},
               {},
               {interval(0.0)},
               1,
               0};
    std::vector<std::vector<std::uint8_t>> const order{{0, 0}, {1, 0}, {0, 1},
                                                       {2, 0}, {1, 1}, {0, 2}};
    for (std::size_t k = 0; k < 6; ++k) {
        auto const at = std::find(r.table->exponents.begin(), r.table->exponents.end(), order[k]);
        REQUIRE(at != r.table->exponents.end());
        r.coefficients[static_cast<std::size_t>(at - r.table->exponents.begin())] = c[k];
    }
    combined_polynomial p(2);
    p.add(r, {{0, 1.0}}, {{0, interval(0.0), interval(1.0)}, {1, interval(0.0), interval(1.0)}});
    return p;
}

} // namespace

TEST_CASE("nowhere in the part does the weighted sum fall below the bound") {
    draws d(81);
    for (int trial = 0; trial < support::swept(25, 80); ++trial) {
        double const curvature = std::pow(10, -d.uniform(0, 3));
        std::vector<response> const known{random_response(d, 3, curvature, 0.01),
                                          random_response(d, 2, curvature, 0.01)};
        // Shared first two unknowns, a third one each.
        combined_polynomial sum(4);
        std::vector<std::vector<std::pair<std::size_t, double>>> weights;
        std::vector<std::vector<combined_polynomial::place>> places;
        for (std::size_t s = 0; s < 2; ++s) {
            auto& mine = weights.emplace_back();
            auto& where = places.emplace_back();
            for (std::size_t y = 0; y < known[s].outputs(); ++y) {
                if (d.below(3) > 0) mine.emplace_back(y, d.uniform(-2, 2));
            }
            for (std::size_t v = 0; v < 3; ++v) {
                double const reach = d.below(5) == 0 ? 0 : std::pow(10, -d.uniform(0, 2));
                double const middle = d.coin() ? 0 : d.uniform(reach - 1, 1 - reach);
                where.push_back({v < 2 ? v : 2 + s, interval(middle), interval(reach)});
            }
            sum.add(known[s], mine, where);
        }
        double const shift = d.uniform(-1, 1);
        sum.add_constant(interval(shift));
        std::vector<combined_polynomial::plane> planes; // any will do
        for (std::size_t v = 1; v < 4; ++v) {
            for (std::size_t u = 0; u < v; ++u) {
                if (d.coin()) planes.push_back({u, v, d.uniform(-2, 2) * curvature});
            }
        }
        double const bound = sum.lower_bound(planes);
        REQUIRE(std::isfinite(bound));
        CHECK(bound >= sum.lower_bound());
        double least = HUGE_VAL;
        for (int sample = 0; sample < 40; ++sample) {
            std::vector<double> unknown;
            for (std::size_t k = 0; k < 4; ++k) unknown.push_back(d.in(between(-1, 1)));
            rational exact(shift);
            for (std::size_t s = 0; s < 2; ++s) {
                std::vector<rational> q;
                for (auto const& p : places[s]) {
                    q.push_back(rational(mid(p.middle)) +
                                rational(mid(p.reach)) * rational(unknown[p.unknown]));
                }
                for (auto const& [y, w] : weights[s]) {
                    auto const off = rational(d.in(between(-1, 1)));
                    exact +=
                        rational(w) * (value(known[s], y, q) + off * rational(known[s].radius[y]));
                }
            }
            REQUIRE(rational(bound) <= exact);
            least = std::min(least, exact.convert_to<double>());
        }
        CHECK(bound <= least);
    }
}

TEST_CASE("nonlinear terms of different outputs cancel") {
    draws d(82);
    auto known = random_response(d, 2, 1, 0);
    auto const& table = *known.table;
    for (std::size_t m = 0; m < table.size(); ++m)
        known.coefficients[2 * m + 1] = known.coefficients[2 * m];
    combined_polynomial sum(3);
    sum.add_constant(interval(1.0));
    std::vector<combined_polynomial::place> places;
    for (std::size_t v = 0; v < 3; ++v) places.push_back({v, interval(0.25), interval(0.75)});
    sum.add(known, {{0, 1.0}, {1, -1.0}}, places);
    CHECK_THAT(sum.lower_bound(), WithinAbs(1, 1e-12));
}

TEST_CASE("parabolas and paraboloids are bounded by their minimum") {
    CHECK_THAT(of_one({0, 1, 1, 0, 0}).lower_bound(), WithinAbs(-0.25, 1e-9)); // within
    CHECK_THAT(of_one({0, 4, 1, 0, 0}).lower_bound(), WithinAbs(-3, 1e-9));    // at an end
    CHECK_THAT(of_one({0, 1, -1, 0, 0}).lower_bound(), WithinAbs(-2, 1e-9));   // concave
    CHECK_THAT(of_one({2, 0, 0, 0, 1}).lower_bound(), WithinAbs(2, 1e-9));     // even
    CHECK_THAT(of_one({2, 0, 0, 1, -1}).lower_bound(), WithinAbs(0, 1e-9)); // the rest one by one
    CHECK_THAT(of_two({1, 0, 0, 1, 1, 1}).lower_bound(),
               WithinAbs(1, 1e-9)); // the mixed term is absorbed
    CHECK_THAT(of_two({1, 0, 0, 4, 2, 0.25}).lower_bound(), WithinAbs(1, 1e-9)); // just so
    CHECK_THAT(of_two({1, 0, 0, 1, 3, 1}).lower_bound(), WithinAbs(-2, 1e-9));   // it is not
    CHECK_THAT(of_two({1, 2, 2, 1, 1, 1}).lower_bound(),
               WithinAbs(-2, 1e-9)); // and costs no more at a corner
}

TEST_CASE("what is not finite proves nothing") {
    CHECK(of_one({0, std::nan(""), 0, 0, 0}).lower_bound() == -HUGE_VAL);
    CHECK(of_one({HUGE_VAL, 0, 0, 0, 0}).lower_bound() == -HUGE_VAL);
    draws d(83);
    for (double const radius : {HUGE_VAL, std::nan("")}) {
        auto known = random_response(d, 1, 1, 0);
        known.radius[0] = radius;
        combined_polynomial sum(3);
        sum.add(known, {{0, 1.0}},
                {{0, interval(0.0), interval(1.0)},
                 {1, interval(0.0), interval(1.0)},
                 {2, interval(0.0), interval(1.0)}});
        CHECK(sum.lower_bound() == -HUGE_VAL);
    }
}

TEST_CASE("a plane bounds a product together with what is linear in its factors") {
    // u v + (u + v) / 2 is least at u = -v = 1, where it is -1; one by one the terms reach -2.
    auto const rising = of_two({0, 0.5, 0.5, 0, 1, 0});
    CHECK_THAT(rising.lower_bound(), WithinAbs(-2.0, 1e-6));
    CHECK_THAT(rising.lower_bound({{0, 1, -0.5}}), WithinAbs(-1.0, 1e-6));
    CHECK(rising.lower_bound({{0, 1, -7}}) >= -2); // no slope is steeper than the product's
    // -u v + (u - v) / 2 with u and -v in its place
    auto const falling = of_two({0, 0.5, -0.5, 0, -1, 0});
    CHECK_THAT(falling.lower_bound({{0, 1, -0.5}}), WithinAbs(-1.0, 1e-6));
}
