// SPDX-License-Identifier: MIT
#include <sivid/paving/contract/detail/explaining_starts.hpp>

#include "support/catch.hpp"
#include "support/random_response.hpp"
#include "support/sweep.hpp"

#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;
using support::rational;

namespace {

/// Polynomials in two parameters (0, 1) and two starts (2, 3), with random coefficients; a third
/// parameter and a third start are points.
struct random_experiment : support::random_response<4, 3> {
    random_experiment(draws& d, std::size_t outputs, double curvature)
        : random_response(d, box{between(-1, 1), between(2, 2), between(5, 5.01)},
                          box{between(0.5, 2), between(1, 1), between(-3, 0.25)}, outputs,
                          curvature, 0.01) {}

    /// Where a rule starts for d in [-1,1]^2 over the part: all variables, exactly.
    [[nodiscard]] std::vector<rational> follow(start_rule const& rule, box const& part,
                                               std::vector<double> const& d) const {
        std::vector<rational> q(4, rational(0));
        std::size_t j = 0;
        for (std::size_t const side : {std::size_t{0}, std::size_t{2}}) {
            double middle = 0, reach = 0;
            paving_detail::normalise(known.unknowns.parameters[side], part[side], middle, reach);
            q[known.unknowns.parameters[side].variable] =
                rational(middle) + rational(reach) * rational(d[j++]);
        }
        for (std::size_t i = 0; i < 2; ++i) {
            auto& s = q[known.unknowns.initial[2 * i].variable];
            s = rational(rule.middle[i]);
            for (j = 0; j < 2; ++j) s += rational(rule.slope[i * 2 + j]) * rational(d[j]);
        }
        return q;
    }
    [[nodiscard]] bool holds(std::size_t y, std::vector<rational> const& q) const {
        auto const exact = value(y, q);
        rational const r(known.radius[y]);
        return rational(known.bounds[y].lower()) <= exact - r &&
               exact + r <= rational(known.bounds[y].upper());
    }
};

} // namespace

TEST_CASE("for every parameter of a proved part the rule's start explains the measurements") {
    draws d(21);
    std::size_t proved = 0, following = 0;
    auto const trials = support::swept(40U, 400U);
    for (unsigned trial = 0; trial < trials; ++trial) {
        std::size_t const outputs = 3 + d.below(6);
        random_experiment x(d, outputs, d.coin() ? 0.02 : 0.3);
        x.known.allowed = d.below(3);
        // A point explains the bounds but for outliers, and may lie at the end of a start's box.
        std::vector<rational> q;
        for (int v = 0; v < 4; ++v) {
            q.emplace_back(v == 3 && d.below(4) == 0 ? 1.0 : d.uniform(-0.9, 0.9));
        }
        double const e = d.uniform(0.02, 0.3);
        for (std::size_t y = 0; y < outputs; ++y) {
            double const at = static_cast<double>(x.value(y, q)) + d.uniform(-0.7, 0.7) * e +
                              (y < d.below(3) ? d.uniform(-5, 5) : 0);
            x.known.bounds.push_back(between(at - e, at + e));
        }
        double const share = std::pow(10, -d.uniform(0.2, 2.5));
        auto part = x.prior;
        for (std::size_t const side : {std::size_t{0}, std::size_t{2}}) {
            auto const& s = x.known.unknowns.parameters[side];
            double const at = s.centre + s.radius * static_cast<double>(q[s.variable]);
            part[side] = intersect(x.prior[side], between(at - share, at + share));
        }
        auto const rule = explaining_starts(x.known, part)();
        if (!rule) continue;
        ++proved;
        bool fixed_would_do = false;
        {
            auto fixed = *rule;
            fixed.slope.assign(4, 0.0);
            fixed_would_do = true;
            for (int corner = 0; corner < 4; ++corner) {
                auto const at =
                    x.follow(fixed, part, {corner % 2 ? 1.0 : -1.0, corner / 2 ? 1.0 : -1.0});
                std::size_t held = 0;
                for (std::size_t y = 0; y < outputs; ++y) held += x.holds(y, at) ? 1 : 0;
                fixed_would_do = fixed_would_do && held + x.known.allowed >= outputs;
            }
        }
        following += fixed_would_do ? 0 : 1;
        for (int sample = 0; sample < 30; ++sample) {
            std::vector<double> const at{sample < 4 ? (sample % 2 ? 1.0 : -1.0) : d.uniform(-1, 1),
                                         sample < 4 ? (sample / 2 ? 1.0 : -1.0) : d.uniform(-1, 1)};
            auto const where = x.follow(*rule, part, at);
            for (std::size_t const side : {std::size_t{0}, std::size_t{2}}) {
                auto const& s = x.known.unknowns.initial[side];
                auto const start = rational(s.centre) + rational(s.radius) * where[s.variable];
                CHECK(rational(x.initial[side].lower()) < start);
                CHECK(start < rational(x.initial[side].upper()));
            }
            std::size_t held = 0;
            for (std::size_t y = 0; y < outputs; ++y) held += x.holds(y, where) ? 1 : 0;
            CHECK(held + x.known.allowed >= outputs);
        }
    }
    INFO(proved << " proved, " << following << " of them only by starts that follow");
    CHECK(proved > trials / 4);
    CHECK(following > trials / 28);
}

TEST_CASE("nothing is claimed where some parameter would need a start beyond its box") {
    // y = d + 1.25 s within 0.3: up to |d| <= 1.55, but with |s| <= 0.5 as drawn only 0.925.
    for (double const reach : {0.9, 0.95}) {
        box const prior{between(-2, 2)}, initial{between(-0.5, 0.5)};
        response r{normalised_unknowns(initial, prior),
                   std::make_shared<monomial_table const>(
                       monomial_table::of(sivid::monomial_space::of(2, 2), 2)),
                   {},
                   {0.0},
                   {},
                   {between(-0.3, 0.3)},
                   1,
                   0};
        r.coefficients = {0, 2, 0.625, 0, 0, 0}; // 1, q0, q1, and the squares
        auto const rule = explaining_starts(r, box{between(-reach, reach)})();
        CHECK(rule.has_value() == (reach < 0.925));
    }
}

TEST_CASE("nothing is claimed without starts, with outputs that were not reached or not bounded") {
    box const prior{between(-1, 1)}, initial{between(-1, 1)};
    auto const table = std::make_shared<monomial_table const>(
        monomial_table::of(sivid::monomial_space::of(2, 2), 2));
    response r{normalised_unknowns(initial, prior),
               table,
               {0, 1, 1, 0, 0, 0},
               {0.0},
               {},
               {between(-0.1, 0.1)},
               1,
               0};
    box const part{between(-0.5, 0.5)};
    CHECK(explaining_starts(r, part)());
    r.measurements = 2;
    CHECK_FALSE(explaining_starts(r, part)());
    r.allowed = 1;
    CHECK(explaining_starts(r, part)());
    r.measurements = 1;
    r.allowed = 0;
    r.radius[0] = HUGE_VAL;
    CHECK_FALSE(explaining_starts(r, part)());
    response const still{normalised_unknowns(box{interval(0)}, prior),
                         std::make_shared<monomial_table const>(
                             monomial_table::of(sivid::monomial_space::of(1, 2), 1)),
                         {0, 1, 0},
                         {0.0},
                         {},
                         {between(-0.1, 0.1)},
                         1,
                         0};
    CHECK_FALSE(explaining_starts(still, part)());
    CHECK_FALSE(explaining_starts(still, box{between(-0.01, 0.01)})()); // `assess` says so
}

TEST_CASE("outputs from starts that follow the parameters lie within their affine forms") {
    draws d(22);
    std::size_t followed = 0;
    for (unsigned trial = 0; trial < support::swept(20U, 1000U); ++trial) {
        random_experiment e(d, 5, trial % 2 == 0 ? 0.05 : 0.5);
        for (std::size_t y = 0; y < 5; ++y) e.known.bounds.push_back(between(-0.1, 0.1));
        box part{between(-0.4, 0.7), between(2, 2), between(5.002, 5.008)};
        if (trial % 3 == 0) part[0] = interval(0.25); // a point of a side
        start_follower follower(e.known, part);
        auto const rule = start_rule_search().propose(follower.forms());
        REQUIRE(rule.middle.size() == 2);
        REQUIRE(rule.slope.size() == 4);
        auto const outputs = follower(rule);
        REQUIRE(outputs); // its starts stay within their boxes
        ++followed;
        for (int point = 0; point < 20; ++point) {
            std::vector<double> at;
            for (int j = 0; j < 2; ++j)
                at.push_back(point < 4 ? ((point >> j) & 1) * 2 - 1 : d.uniform(-1, 1));
            auto const q = e.follow(rule, part, at);
            for (std::size_t y = 0; y < 5; ++y) {
                auto const exact = e.value(y, q);
                rational least(outputs->value[y]), most = least;
                for (std::size_t j = 0; j < 2; ++j) {
                    auto const& slope = outputs->slope[j * 5 + y];
                    rational const one = rational(slope.lower()) * rational(at[j]);
                    rational const other = rational(slope.upper()) * rational(at[j]);
                    least += std::min(one, other);
                    most += std::max(one, other);
                }
                rational const own(e.known.radius[y]), rest(outputs->rest[y]);
                CHECK((least - rest <= exact - own && exact + own <= most + rest));
            }
        }
    }
    CHECK(followed > 0);
}
