// SPDX-License-Identifier: MIT
#include <sivid/measurement/signal.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/power_series.hpp"
#include "support/random.hpp"

#include <cmath>
#include <limits>

using namespace sivid;
using support::between;
using support::draws;
using support::encloses;
using support::mp;

namespace {

/// The line of piece k in 100 digits.
mp on_piece(sampled_signal const& s, std::size_t k, mp const& t) {
    auto const& times = s.times();
    auto const& values = s.values();
    if (s.kind() == interpolation::hold || times.size() == 1) return values[k];
    mp const slope = (mp(values[k + 1]) - mp(values[k])) / (mp(times[k + 1]) - mp(times[k]));
    return mp(values[k]) + slope * (t - mp(times[k]));
}

} // namespace

TEST_CASE("pieces and knots of a sampled signal") {
    sampled_signal const line({0, 1, 3}, {0, 2, 1}, interpolation::linear);
    CHECK(line.piece(-5) == 0);
    CHECK(line.piece(0) == 0);
    CHECK(line.piece(0.5) == 0);
    CHECK(line.piece(1) == 1);
    CHECK(line.piece(3) == 1); // the last piece goes on to the right
    CHECK(line.piece(9) == 1);
    CHECK(line.next_knot(-1) == 0);
    CHECK(line.next_knot(0) == 1);
    CHECK(line.next_knot(2.5) == 3);
    CHECK(line.next_knot(3) == HUGE_VAL);
    CHECK(line.approximate(0.5) == 1);
    CHECK(line.approximate(2) == 1.5);
    sampled_signal const step({0, 1, 3}, {0, 2, 1}, interpolation::hold);
    CHECK(step.piece(0.999) == 0);
    CHECK(step.piece(1) == 1);
    CHECK(step.piece(3) == 2);
    CHECK(step.approximate(0.5) == 0);
    CHECK(step.approximate(1) == 2);
    CHECK(step.approximate(7) == 1);
    sampled_signal const single({2}, {5}, interpolation::linear);
    CHECK(single.piece(0) == 0);
    CHECK(single.approximate(9) == 5);
    CHECK(single.value<interval>(0, interval(9.0)).lower() == 5);
    CHECK(single.slope<interval>(0).upper() == 0);
}

TEST_CASE("values and slopes of pieces are enclosed") {
    draws d(41);
    for (int round = 0; round < 200; ++round) {
        std::vector<double> times{d.uniform(-1, 1)};
        std::vector<double> values{d.uniform(-3, 3)};
        for (std::size_t i = 0; i < 4; ++i) {
            times.push_back(times.back() + d.uniform(0.01, 1));
            values.push_back(d.coin() ? d.uniform(-3, 3) : values.back());
        }
        auto const kind = d.coin() ? interpolation::linear : interpolation::hold;
        sampled_signal const s(times, values, kind);
        for (std::size_t k = 0; k < 4; ++k) {
            interval const over = between(times[k], times[k + 1]);
            double const t = d.in(over);
            auto const exact = on_piece(s, k, t);
            CHECK(encloses(s.value<interval>(k, interval(t)), exact));
            CHECK(encloses(s.value<interval>(k, over), exact));
            CHECK(std::abs(s.approximate_on(k, t) - static_cast<double>(exact)) < 1e-13);
            auto const slope = s.slope<interval>(k);
            mp const run = mp(times[k + 1]) - mp(times[k]);
            mp const rise = kind == interpolation::hold ? mp(0) : mp(values[k + 1]) - mp(values[k]);
            CHECK(encloses(slope, rise / run));
            CHECK(width(slope) < 1e-11);
            // Beyond its piece a polynomial goes on.
            CHECK(encloses(s.value<interval>(k, interval(times[k + 1] + 1)),
                           on_piece(s, k, mp(times[k + 1] + 1))));
        }
    }
}

TEST_CASE("a signal refuses what it cannot mean") {
    using s = sampled_signal;
    auto const kind = interpolation::linear;
    double const nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(s({}, {}, kind), std::invalid_argument);
    CHECK_THROWS_AS(s({0, 1}, {0}, kind), std::invalid_argument);
    CHECK_THROWS_AS(s({0, 0}, {0, 1}, kind), std::invalid_argument);
    CHECK_THROWS_AS(s({1, 0}, {0, 1}, kind), std::invalid_argument);
    CHECK_THROWS_AS(s({0, nan}, {0, 1}, kind), std::invalid_argument);
    CHECK_THROWS_AS(s({0, 1}, {nan, 1}, kind), std::invalid_argument);
    CHECK_THROWS_AS(s({0, HUGE_VAL}, {0, 1}, kind), std::invalid_argument);
    CHECK_THROWS_AS(s({0, 1}, {0, HUGE_VAL}, kind), std::invalid_argument);
    CHECK_THROWS_WITH(s({0, 0}, {0, 1}, kind), ContainsSubstring("increase strictly"));
}

TEST_CASE("error bounds run between the samples as the values do") {
    std::vector<double> const times{0, 1, 3}, values{0, 2, 1}, errors{0.5, 0, 0.25};
    sampled_signal const line(times, values, interpolation::linear, errors);
    CHECK_FALSE(line.exact());
    CHECK(line.nominal().exact());
    CHECK(line.nominal().values() == values);
    CHECK(line.error_bound(0, 0) == 0.5);
    CHECK(line.error_bound(1, 1) == 0);
    CHECK(line.error_bound(1, 3) == 0.25);
    CHECK(line.error_bound(0, -7) == 0.5); // the nearest sample's, before and after
    CHECK(line.error_bound(1, 99) == 0.25);
    sampled_signal const step(times, values, interpolation::hold, errors);
    CHECK(step.error_bound(step.piece(0.999), 0.999) == 0.5);
    CHECK(step.error_bound(step.piece(1), 1) == 0);
    CHECK(step.error_bound(step.piece(8), 8) == 0.25);
    draws d(43);
    for (int round = 0; round < 300; ++round) {
        double const t0 = d.uniform(-1, 1), t1 = t0 + d.uniform(1e-6, 2);
        double const e0 = d.below(5) == 0 ? 0 : d.uniform(0, 3), e1 = d.uniform(0, 3);
        sampled_signal const s({t0, t1}, {1, 2}, interpolation::linear, {e0, e1});
        double const t = std::min(t1, d.uniform(t0, t1));
        mp const exact = mp(e0) + (mp(e1) - mp(e0)) * (mp(t) - mp(t0)) / (mp(t1) - mp(t0));
        CHECK(mp(s.error_bound(0, t)) >= exact);
        CHECK(mp(s.error_bound(0, t)) <= exact + 3e-14);
    }
    CHECK(sampled_signal({0}, {1}, interpolation::linear, {0.1}).error_bound(0, 5) == 0.1);
    CHECK(sampled_signal({0}, {1}, interpolation::hold).error_bound(0, 5) == 0);
}

TEST_CASE("error bounds that bound nothing are refused") {
    auto const make = [](std::vector<double> errors) {
        return sampled_signal({0, 1}, {0, 1}, interpolation::hold, std::move(errors));
    };
    CHECK_NOTHROW(make({0, 0.5}));
    double const nan = std::numeric_limits<double>::quiet_NaN();
    double const infinity = std::numeric_limits<double>::infinity();
    for (auto const& bad : std::vector<std::vector<double>>{
             {0.1}, {0.1, -0.1}, {nan, 0.1}, {0.1, infinity}, {0.1, 0.1, 0.1}}) {
        CHECK_THROWS_AS(make(bad), std::invalid_argument);
    }
}

TEST_CASE("a signal whose error bounds are all 0 is exact") {
    auto const held = [](std::vector<double> errors) {
        return sampled_signal({0, 1}, {0, 3}, interpolation::hold, std::move(errors));
    };
    CHECK(held({0, 0}).exact());
    CHECK(held({0, 0}).errors().empty());
    CHECK_FALSE(held({0, 1e-300}).exact());
    CHECK(held({0, 0}).error_bound(1, 2) == 0);
}
