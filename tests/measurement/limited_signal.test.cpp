// SPDX-License-Identifier: MIT
#include <sivid/measurement/limited_signal.hpp>

#include "measurement/drawn_signal.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

using namespace sivid;
using measurement_support::drawn;
using support::draws;

namespace {

/// The limited input by its definition, at these increasing times, between which u is straight.
/// @param sign  where u lies within its bounds, from -1 to 1
std::vector<double> by_definition(sampled_signal const& u, std::vector<double> const& times,
                                  double limit, double sign) {
    std::vector<double> result;
    auto const value = [&](std::size_t piece, double t) {
        return u.approximate_on(piece, t) + sign * u.error_bound(piece, t);
    };
    result.push_back(value(u.piece(times[0]), times[0]));
    for (std::size_t i = 0; i + 1 < times.size(); ++i) {
        auto const piece = u.piece(times[i]);
        double const from = value(piece, times[i]), to = value(piece, times[i + 1]);
        double left = times[i + 1] - times[i];
        double const slope = (to - from) / left;
        double y = result.back(), gap = from - y;
        if (gap != 0) {
            double const way = gap > 0 ? 1 : -1;
            double const closing = limit - way * slope;
            double const until = closing > 0 ? std::min(left, std::abs(gap) / closing) : left;
            y += way * limit * until;
            left -= until;
            if (left > 0) y = to - slope * left; // met
        }
        if (left > 0) y += std::clamp(slope, -limit, limit) * left;
        result.push_back(y);
    }
    return result;
}

} // namespace

TEST_CASE("an input behind a rate limit lies within its slice, for every limit and every error") {
    draws d(191);
    for (int n = 0; n < 1500; ++n) {
        auto const kind = n % 2 == 0 ? interpolation::linear : interpolation::hold;
        auto const u = drawn(d, kind, d.below(2) == 0);
        double const begin = d.below(3) == 0 ? u.times().front() : d.uniform(-0.5, 0.5);
        double const end = begin + d.uniform(0, 4);
        double const low = std::exp(d.uniform(-4, 3));
        double const high = low * (d.below(3) == 0 ? 1.0 : 1 + std::exp(d.uniform(-8, 0)));
        auto const y = rate_limited(u, begin, end, interval(low, high));
        auto const lines = rate_limited_line(u, begin, end, interval(low, high));
        REQUIRE(lines.about.times() == y.within.times());
        REQUIRE(y.slope_by_limit.size() + 1 == y.within.times().size());
        REQUIRE(y.slope_change.size() == y.slope_by_limit.size());
        std::vector<double> times{begin};
        for (double const t : u.times()) {
            if (begin < t && t < end) times.push_back(t);
        }
        for (int i = 0; i < 40; ++i) times.push_back(d.uniform(begin, end));
        times.push_back(end);
        std::sort(times.begin(), times.end());
        times.erase(std::unique(times.begin(), times.end()), times.end());
        for (double const sign : {-1.0, 0.0, 1.0}) {
            double const r = d.below(3) == 0 ? low : d.below(2) == 0 ? high : d.uniform(low, high);
            auto const truth = by_definition(u, times, r, sign);
            for (std::size_t i = 0; i < times.size(); ++i) {
                auto const k = y.within.piece(times[i]);
                CAPTURE(n, times[i], r, low, high, sign);
                double const off = std::abs(truth[i] - y.within.approximate_on(k, times[i]));
                REQUIRE(off <= y.within.error_bound(k, times[i]) + 1e-13);
                // And about its line in the limit.
                auto const& line = lines.about;
                double const there =
                    line.approximate_on(k, times[i]) +
                    lines.by_limit.approximate_on(k, times[i]) * (r - mid(interval(low, high)));
                REQUIRE(std::abs(truth[i] - there) <= line.error_bound(k, times[i]) + 1e-13);
            }
        }
    }
}

TEST_CASE("for one limit the lines are what it does, to the rounding") {
    draws d(192);
    for (int n = 0; n < 300; ++n) {
        auto const kind = n % 2 == 0 ? interpolation::linear : interpolation::hold;
        auto const u = drawn(d, kind, false);
        auto const y = rate_limited(u, -0.5, 3, interval(std::exp(d.uniform(-3, 3))));
        for (double const e : y.within.errors()) CHECK(e < 1e-12);
    }
    // A step is a ramp, a slow ramp stays, a fast one is left behind and met again.
    sampled_signal const step({0, 1}, {0, 1}, interpolation::hold);
    auto const ramp = rate_limited(step, 0, 3, interval(2.0));
    CHECK(ramp.within.times() == std::vector<double>{0, 1, 1.5, 3});
    CHECK(ramp.within.values() == std::vector<double>{0, 0, 1, 1});
    CHECK(ramp.slope_by_limit == std::vector<double>{0, 0, 0});
    CHECK(ramp.slope_change == std::vector<double>{0, 1, 0});
    sampled_signal const fast({0, 1, 4}, {0, 3, 3}, interpolation::linear);
    auto const behind = rate_limited(fast, 0, 4, interval(1.5));
    CHECK(behind.within.times() == std::vector<double>{0, 1, 2, 4});
    CHECK(behind.within.values() == std::vector<double>{0, 1.5, 3, 3});
    CHECK(behind.slope_by_limit == std::vector<double>{0, 1, 0});
    auto const slow = rate_limited(fast, 0, 4, interval(3.0));
    CHECK(slow.within.values().back() == 3);
    for (std::size_t k = 0; k < slow.within.times().size(); ++k)
        CHECK_THAT(slow.within.values()[k],
                   WithinAbs(fast.approximate(slow.within.times()[k]), 1e-14));
    CHECK_THROWS_AS(rate_limited(fast, 0, 4, interval(0.0, 1.0)), std::invalid_argument);
    CHECK_THROWS_AS(rate_limited_line(fast, 0, 4, interval(0.0, 1.0)), std::invalid_argument);
    auto const line = rate_limited_line(fast, 0, 4, interval(1.5)); // of one limit
    for (std::size_t k = 0; k < 4; ++k) CHECK(line.about.errors()[k] < 1e-12);
}

TEST_CASE("limits that have caught up are one again") {
    // Steps far apart: a range of limits is told only for as long as one of them has not met.
    sampled_signal const steps({0, 1, 3}, {0, 1, 0}, interpolation::hold);
    auto const y = rate_limited(steps, 0, 5, interval(1.8, 2.2));
    auto const off = [&](double t) { return y.within.error_bound(y.within.piece(t), t); };
    CHECK(off(0.99) < 1e-12);
    CHECK(off(1.5) > 0.09);
    CHECK(off(1.5) < 0.11);
    CHECK(off(1.7) < 1e-9);
    CHECK(off(2.9) < 1e-9);
    CHECK(off(4.9) < 1e-9);
}

TEST_CASE("a line in the limit leaves errors of second order, whether it is met or crossed") {
    std::vector<double> times, values;
    for (int k = 0; k <= 120; ++k) {
        times.push_back(0.05 * k);
        values.push_back(std::sin(2 * times.back()));
    }
    sampled_signal const wave(times, values, interpolation::linear);
    // 0.5: the wave is always too fast; 1.2 and 1.9: it is met.
    for (double const limit : {0.5, 1.2, 1.9}) {
        auto const mean = [&](double share, bool of_line) {
            interval const limits(limit * (1 - share), limit * (1 + share));
            auto const s = of_line ? rate_limited_line(wave, 0, 6, limits).about
                                   : rate_limited(wave, 0, 6, limits).within;
            double sum = 0;
            for (int i = 0; i < 6000; ++i) sum += s.error_bound(s.piece(1e-3 * i), 1e-3 * i) / 6000;
            return sum;
        };
        CAPTURE(limit, mean(4e-3, true), mean(1e-3, true), mean(1e-3, false));
        CHECK(mean(1e-3, true) < 0.1 * mean(4e-3, true));
        CHECK(mean(1e-3, true) < 0.07 * mean(1e-3, false));
    }
}
