// SPDX-License-Identifier: MIT
#include "support/catch.hpp"
#include "support/random_response.hpp"

#include <sivid/paving/response/local_response.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;
using support::rational;

namespace {

constexpr std::size_t degree = 3;

/// A response of random polynomials: three parameters, of which the second is a point, and one
/// unknown start. Variables: p0 -> 0, p2 -> 1, start -> 2.
struct random_response : support::random_response<3, degree> {
    random_response(draws& d, std::size_t outputs, double curvature)
        : support::random_response<3, degree>(
              d, box{between(-1, 1)}, box{between(0.5, 2), between(1, 1), between(-3, 0.25)},
              outputs, curvature, 0.1) {}

    /// Normalised coordinates of parameters and start, exactly.
    [[nodiscard]] std::vector<rational> coordinates(std::vector<double> const& p,
                                                    double start) const {
        std::vector<rational> q(3, rational(start));
        for (std::size_t const j : {std::size_t{0}, std::size_t{2}}) {
            auto const& side = known.unknowns.parameters[j];
            q[side.variable] = (rational(p[j]) - rational(side.centre)) / rational(side.radius);
        }
        return q;
    }
};

box random_part(draws& d, box const& whole) {
    box part = whole;
    for (std::size_t j = 0; j < part.size(); ++j) {
        auto& side = part[j];
        double const w = width(side);
        double const share = std::pow(10, -d.uniform(0, 4));
        double const lo = side.lower() + d.uniform(0, 1 - share) * w;
        switch (d.below(4)) {
        case 0:
            break;
        case 1:
            side = between(std::min(lo, side.upper()), std::min(lo, side.upper()));
            break;
        default:
            side = between(lo, std::min(lo + share * w, side.upper()));
        }
    }
    return part;
}

bool contains_exactly(interval const& x, rational const& v) {
    return (!std::isfinite(x.lower()) || rational(x.lower()) <= v) &&
           (!std::isfinite(x.upper()) || v <= rational(x.upper()));
}

} // namespace

TEST_CASE("a response on a part of its box: affine form and ranges contain the polynomial") {
    draws d(1);
    for (int trial = 0; trial < 60; ++trial) {
        random_response r(d, 3, d.coin() ? 0.05 : 1);
        r.known.bounds.assign(3, interval(0.0));
        auto const part = random_part(d, r.prior);
        auto const local = expand(r.known, part);
        auto const ranges = output_ranges(r.known, part);
        for (std::size_t v = 0; v < 3; ++v) {
            REQUIRE(rational(std::abs(local.middle[v])) + rational(local.reach[v]) <=
                    1 + rational(1e-15));
        }
        for (int sample = 0; sample < 12; ++sample) {
            auto const p = d.in(part);
            auto const q = r.coordinates(p, d.coin() ? 1 : d.uniform(-1, 1));
            for (std::size_t y = 0; y < 3; ++y) {
                rational const exact = r.value(y, q);
                rational const radius(r.known.radius[y]);
                rational affine(local.value[y]);
                for (std::size_t v = 0; v < 3; ++v) {
                    if (local.reach[v] == 0) continue;
                    rational const along =
                        (q[v] - rational(local.middle[v])) / rational(local.reach[v]);
                    REQUIRE(abs(along) <= 1);
                    affine += rational(local.slope[v * 3 + y]) * along;
                }
                CAPTURE(trial, sample, y);
                // the polynomial and all of its radius
                REQUIRE(abs(exact - affine) + radius <= rational(local.rest[y]));
                REQUIRE(contains_exactly(ranges[y], exact + radius));
                REQUIRE(contains_exactly(ranges[y], exact - radius));
            }
        }
    }
}

TEST_CASE("on a point of the box the rest is the radius") {
    draws d(2);
    random_response r(d, 4, 1);
    r.known.bounds.assign(4, interval(0.0));
    box part{between(0.75, 0.75), between(1, 1), between(-1, -1)};
    auto const local = expand(r.known, part);
    // only the start still varies: its even power is halved, its odd ones stay
    REQUIRE(local.reach[0] <= 1e-15);
    REQUIRE(local.reach[1] <= 1e-15);
    REQUIRE(local.reach[2] == 1);
}

TEST_CASE("coefficients that are not finite leave nothing known") {
    draws d(3);
    for (double const bad : {HUGE_VAL, -HUGE_VAL, std::nan("")}) {
        for (std::size_t const m : {std::size_t{0}, std::size_t{2}, std::size_t{9}}) {
            random_response r(d, 2, 0.1);
            r.known.bounds = {between(-1e-3, 1e-3), between(-1e300, 1e300)};
            r.known.coefficients[m * 2] = bad;
            auto part = r.prior;
            auto const ranges = output_ranges(r.known, part);
            REQUIRE(width(ranges[0]) == HUGE_VAL);
            REQUIRE(std::isfinite(width(ranges[1])));
            auto const says = assess(r.known, part);
            REQUIRE_FALSE(says.refuted);
            REQUIRE_FALSE(says.explained);
            REQUIRE(says.sharpness == 1);
        }
    }
}

TEST_CASE("what an unknown start spreads does not hide a remainder") {
    draws d(6);
    for (double const start : {0.0, 1.0, 100.0}) {
        random_response r(d, 1, 0);
        std::fill(r.known.coefficients.begin(), r.known.coefficients.end(), 0.0);
        auto const& exponents = r.known.table->exponents;
        for (std::size_t m = 0; m < exponents.size(); ++m) {
            if (exponents[m] == std::vector<std::uint8_t>{1, 0, 0}) r.known.coefficients[m] = 0.1;
            if (exponents[m] == std::vector<std::uint8_t>{0, 0, 1}) r.known.coefficients[m] = start;
        }
        r.known.radius = {0.3};
        r.known.bounds = {between(-0.2, 0.2)};
        auto part = r.prior;
        auto const says = assess(r.known, part);
        REQUIRE_FALSE(says.refuted);
        REQUIRE(std::abs(says.sharpness - 0.75) < 1e-9);
    }
}

TEST_CASE(
    "assess neither refutes nor removes a feasible parameter, with outliers and unknown starts") {
    draws d(4);
    int contracted = 0;
    int refuted = 0;
    for (int trial = 0; trial < 150; ++trial) {
        std::size_t const outputs = 8;
        random_response r(d, outputs, d.coin() ? 0.02 : 0.5);
        r.known.allowed = d.below(4);
        // Bounds around the outputs of a truth anywhere in the prior; `allowed` of them are false.
        auto const truth = d.in(r.prior);
        double const truth_start = d.uniform(-1, 1);
        auto const q = r.coordinates(truth, truth_start);
        double const tolerance = std::pow(10, -d.uniform(0, 3));
        for (std::size_t y = 0; y < outputs; ++y) {
            double centre = static_cast<double>(r.value(y, q));
            centre += d.uniform(-0.9, 0.9) * tolerance;
            if (y < r.known.allowed) centre += 5;
            r.known.bounds.push_back(between(centre - tolerance, centre + tolerance));
        }
        auto const whole = random_part(d, r.prior);
        auto part = whole;
        auto const says = assess(r.known, part);
        refuted += says.refuted ? 1 : 0;
        contracted += !says.refuted && width(part[0]) < width(whole[0]) ? 1 : 0;
        REQUIRE((says.refuted || subset(part, whole)));
        REQUIRE(says.held + says.failed <= outputs);

        // A point that satisfies all but `allowed` bounds for some start and some member of the
        // radii.
        auto const feasible = [&](std::vector<double> const& p, double start) {
            auto const at = r.coordinates(p, start);
            std::size_t violated = 0;
            for (std::size_t y = 0; y < outputs; ++y) {
                rational const v = r.value(y, at);
                rational const reach(r.known.radius[y]);
                violated += v + reach < rational(r.known.bounds[y].lower()) ||
                                    v - reach > rational(r.known.bounds[y].upper())
                                ? 1
                                : 0;
            }
            return violated <= r.known.allowed;
        };
        auto const stays = [&](std::vector<double> const& p) {
            CAPTURE(trial, p[0], p[2], tolerance, r.known.allowed);
            REQUIRE_FALSE(says.refuted);
            REQUIRE(contains(part[0], p[0]));
            REQUIRE(contains(part[2], p[2]));
        };
        bool const truth_inside = contains(whole[0], truth[0]) && contains(whole[2], truth[2]);
        if (truth_inside) {
            REQUIRE(feasible(truth, truth_start));
            stays(truth);
        }
        for (int sample = 0; sample < 15; ++sample) {
            auto p = d.in(whole);
            if (truth_inside && d.coin()) { // near the truth
                for (std::size_t const j : {std::size_t{0}, std::size_t{2}}) {
                    p[j] = std::clamp(truth[j] + tolerance * d.uniform(-1, 1), whole[j].lower(),
                                      whole[j].upper());
                }
            }
            double const start = d.coin() ? truth_start : d.uniform(-1, 1);
            if (feasible(p, start)) stays(p);
        }
        // Explained: for every parameter, start and member.
        if (!says.explained) continue;
        for (int sample = 0; sample < 15; ++sample) {
            auto const at = r.coordinates(d.in(whole), d.uniform(-1, 1));
            std::size_t held = 0;
            for (std::size_t y = 0; y < outputs; ++y) {
                rational const v = r.value(y, at);
                rational const reach(r.known.radius[y]);
                held += contains_exactly(r.known.bounds[y], v + reach) &&
                                contains_exactly(r.known.bounds[y], v - reach)
                            ? 1
                            : 0;
            }
            REQUIRE(held + r.known.allowed >= outputs);
        }
    }
    REQUIRE(contracted > 15); // the test is not empty
    REQUIRE(refuted > 5);
}

TEST_CASE("measurements that were not reached count neither for nor against") {
    draws d(5);
    random_response r(d, 2, 0);
    std::fill(r.known.radius.begin(), r.known.radius.end(), 0.0);
    r.known.bounds = {between(-100, 100), between(-100, 100)};
    r.known.measurements = 5;
    r.known.allowed = 2;
    auto part = r.prior;
    REQUIRE_FALSE(assess(r.known, part).explained); // 2 of 5 hold, 3 are needed
    r.known.allowed = 3;
    REQUIRE(assess(r.known, part).explained);
    r.known.bounds = {between(50, 100), between(50, 100)};
    r.known.allowed = 2;
    REQUIRE_FALSE(assess(r.known, part).refuted); // two failures are allowed
    r.known.allowed = 1;
    REQUIRE(assess(r.known, part).refuted);
}

TEST_CASE("a response with variables fixed one by one: ranges contain the polynomial") {
    draws d(4);
    for (int trial = 0; trial < 40; ++trial) {
        random_response r(d, 3, d.coin() ? 0.05 : 1);
        r.known.bounds.assign(3, interval(0.0));
        std::vector<double> middle;
        std::vector<double> reach;
        for (std::size_t v = 0; v < 3; ++v) {
            reach.push_back(d.coin() ? 0 : d.uniform(0, 1));
            middle.push_back(d.uniform(reach[v] - 1, 1 - reach[v]));
        }
        auto const ranges = output_ranges(r.known, expand(r.known, middle, reach));
        for (int sample = 0; sample < 10; ++sample) {
            std::vector<rational> q;
            for (std::size_t v = 0; v < 3; ++v) {
                q.push_back(rational(middle[v]) +
                            rational(reach[v]) * rational(d.in(between(-1, 1))));
            }
            for (std::size_t y = 0; y < 3; ++y) {
                auto const exact = r.value(y, q);
                rational const radius(r.known.radius[y]);
                CHECK(contains_exactly(ranges[y], exact + radius));
                CHECK(contains_exactly(ranges[y], exact - radius));
            }
        }
    }
}
