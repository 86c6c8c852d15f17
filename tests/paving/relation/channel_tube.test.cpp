// SPDX-License-Identifier: MIT
#include <sivid/paving/relation/channel_tube.hpp>

#include "diagnosis/planted_motion.hpp"
#include "support/catch.hpp"

using namespace diagnosis_support;

namespace {

channel_tube tube_of(std::vector<double> const& times, std::vector<interval> const& bounds,
                     rate_variation const& law) {
    return channel_tube::of_gaps(times, bounds, channel_tube::in_gaps(law, times));
}

/// A continuous function of straight pieces whose rate varies by at most J within `period`: the
/// rate jumps anywhere, but stays in [-J/2, J/2] around a slow drift of at most J/10 a period.
struct zigzag {
    std::vector<double> times, values;

    zigzag(draws& d, double end, double period, double most) {
        double t = 0, value = d.uniform(-1, 1);
        double drift = 0;
        while (t < end + 1) {
            times.push_back(t);
            values.push_back(value);
            double const h = d.uniform(0.001, 0.7 * period);
            double const slope = drift + (d.coin() ? 0.42 : -0.42) * most;
            drift += d.uniform(-0.07, 0.07) * most * h / period;
            t += h;
            value += h * slope;
        }
    }
    double operator()(double t) const {
        auto const after = std::upper_bound(times.begin(), times.end(), t);
        auto const k = static_cast<std::size_t>(after - times.begin()) - 1;
        double const s = (t - times[k]) / (times[k + 1] - times[k]);
        return values[k] + s * (values[k + 1] - values[k]);
    }
};

} // namespace

TEST_CASE("functions whose rate varies as declared stay in the tube") {
    draws d(5);
    for (int n = 0; n < 50; ++n) {
        double const period = d.uniform(0.05, 0.3);
        double const most = d.uniform(0.1, 10);
        zigzag const f(d, 20 * period, period, most);
        std::vector<double> times;
        std::vector<interval> bounds;
        double t = 0;
        for (int k = 0; k < 12; ++k) {
            times.push_back(t);
            double const e = d.uniform(0, 0.1);
            bounds.push_back(around(f(t) + d.uniform(-e, e), e * (1 + 1e-9) + 1e-12));
            t += period * (d.below(5) == 0 ? d.uniform(1, 2.5) : 1); // also longer gaps
        }
        auto const tube = tube_of(times, bounds, {period, most});
        for (int k = 0; k < 100; ++k) {
            double const from = d.uniform(0, times.back());
            double const to = d.uniform(from, std::min(times.back(), from + period / 2));
            double const inside = d.uniform(from, to);
            auto const range = tube.over(from, to);
            CHECK(range.lower() - 1e-9 <= f(inside));
            CHECK(f(inside) <= range.upper() + 1e-9);
        }
    }
}

TEST_CASE("the tube is the bounds at samples and an arch between them") {
    auto const tube =
        tube_of({0.0, 1.0, 3.0}, {between(0, 0), between(1, 2), between(1, 2)}, {1.0, 8.0});
    CHECK(equal(tube.over(1, 1), between(1, 2)));
    CHECK(equal(tube.over(3, 3), between(1, 2)));
    auto const middle = tube.over(0.5, 0.5); // chord [0.5, 1], arch J h/4 = 2
    CHECK_THAT(middle.lower(), WithinAbs(-1.5, 1e-6));
    CHECK_THAT(middle.upper(), WithinAbs(3, 1e-6));
    auto const longer = tube.over(2, 2); // two periods: 16 * 2/4
    CHECK_THAT(longer.lower(), WithinAbs(-7, 1e-6));
    CHECK_THAT(longer.upper(), WithinAbs(10, 1e-6));
    CHECK(subset(hull(middle, longer), tube.over(0, 3)));
    CHECK(tube.covers(0, 3));
    CHECK_FALSE(tube.covers(2, 3.5));
}

TEST_CASE("beside a line only the width is left, and the departure on the average") {
    draws d(50);
    for (int n = 0; n < 100; ++n) {
        double const most = d.uniform(0, 10);
        double const slope = d.uniform(-20, 20);
        auto const tube = tube_of({0.0, 1.0}, {around(0, 0.1), around(slope, 0.1)}, {1.0, most});
        double const from = d.uniform(0, 0.9);
        double const to = d.uniform(from + 0.01, 1);
        auto const [beside, departure] = tube.beside_line(from, to, slope * from, slope * to);
        CHECK(beside.lower() <= -0.1 + 1e-9);
        CHECK(beside.upper() >= 0.1 - 1e-9);
        CHECK(width(beside) < 0.2001);
        double sum = 0;
        for (int k = 0; k < 1000; ++k) {
            double const s = from + (to - from) * (k + 0.5) / 1000;
            sum += most * s * (1 - s) / 1000;
        }
        CHECK_THAT(departure, WithinAbs(sum, 1e-5));
        CHECK(departure >= sum * (1 - 1e-6));
    }
    auto const tube = tube_of({0.0, 1.0, 2.0}, {around(0, 1), around(0, 1), around(0, 1)}, {1, 1});
    CHECK_THROWS_AS(tube.beside_line(0.5, 1.5, 0, 0), std::invalid_argument);
    CHECK_THROWS_AS(tube.beside_line(0.5, 0.5, 0, 0), std::invalid_argument);
    CHECK_THROWS_AS(tube.beside_line(1.5, 2.5, 0, 0), std::invalid_argument);
}

TEST_CASE("the worst case is reached: two slopes that meet") {
    // Rate -J/2 then J/2, meeting in the middle of a gap.
    double const most = 4;
    auto const tube = tube_of({0.0, 1.0}, {between(0, 0), between(0, 0)}, {1.0, most});
    auto const range = tube.over(0.5, 0.5);
    CHECK(range.lower() <= -most / 4);
    CHECK(range.lower() >= -most / 4 * 1.001);
}

TEST_CASE("tubes refuse what makes no sense") {
    CHECK_THROWS_AS(tube_of({}, {}, {1, 1}), std::invalid_argument);
    CHECK_THROWS_AS(tube_of({0.0}, {}, {1, 1}), std::invalid_argument);
    CHECK_THROWS_AS(tube_of({1.0, 0.0}, {between(0, 1), between(0, 1)}, {1, 1}),
                    std::invalid_argument);
    CHECK_THROWS_AS(tube_of({0.0}, {between(0, 1)}, {0, 1}), std::invalid_argument);
    CHECK_THROWS_AS(tube_of({0.0}, {between(0, 1)}, {1, -1}), std::invalid_argument);
    auto const tube = tube_of({0.0, 1.0}, {between(0, 1), between(0, 1)}, {1, 1});
    CHECK_THROWS_AS(tube.over(0.5, 1.5), std::invalid_argument);
    CHECK_THROWS_AS(tube.over(0.5, 0.4), std::invalid_argument);
}

TEST_CASE("gaps may differ in what the rate varies by, and be unknown") {
    std::vector<interval> const bounds{between(0, 0), between(1, 1), between(1, 1), between(0, 0)};
    auto const tube = channel_tube::of_gaps({0, 1, 2, 3}, bounds, {0, HUGE_VAL, 2});
    CHECK(width(tube.over(0.5, 0.5)) < 1e-12);
    CHECK_FALSE(is_bounded(tube.over(1.5, 1.5)));
    CHECK(tube.beside_line(1, 2, 1, 1).second == HUGE_VAL);
    CHECK_THAT(tube.over(2.5, 2.5).upper(), WithinAbs(1.0, 1e-12)); // 1/2 + 2 (1/2)(1/2)
    CHECK(equal(tube.over(2, 2), between(1, 1)));
    CHECK_THROWS_AS(channel_tube::of_gaps({0, 1}, {between(0, 1), between(0, 1)}, {}),
                    std::invalid_argument);
    CHECK_THROWS_AS(channel_tube::of_gaps({0, 1}, {between(0, 1), between(0, 1)}, {-1}),
                    std::invalid_argument);
}

TEST_CASE("a rate of the rate bends the tube to one side") {
    draws d(51);
    double narrowest = HUGE_VAL;
    for (int n = 0; n < 200; ++n) {
        // f = a t^2/2 + b t + e sin(w t)
        double const a = d.uniform(-8, 8), b = d.uniform(-3, 3), e = d.uniform(0, 0.3),
                     w = d.uniform(0.5, 4), noise = d.uniform(0, 0.05), gap = d.uniform(0.1, 1);
        auto const f = [&](double t) { return a * t * t / 2 + b * t + e * std::sin(w * t); };
        double const most = e * w * w + d.uniform(0, 0.5);
        std::vector<double> times;
        std::vector<interval> bounds;
        for (int k = 0; k < 4; ++k) {
            times.push_back(k * gap);
            bounds.push_back(around(f(times.back()) + d.uniform(-noise, noise), noise + 1e-12));
        }
        double const variation = d.coin() ? HUGE_VAL : (std::abs(a) + e * w * w) * gap * 1.01;
        auto const tube = channel_tube::of_gaps(times, bounds, {variation, variation, variation},
                                                std::vector(3, between(a - most, a + most)));
        auto const plain = channel_tube::of_gaps(times, bounds, {variation, variation, variation});
        for (int k = 0; k < 30; ++k) {
            double const t = d.uniform(0, 3 * gap);
            auto const range = tube.over(t, t);
            CHECK(range.lower() - 1e-9 <= f(t));
            CHECK(f(t) <= range.upper() + 1e-9);
            CHECK(width(range) <= width(plain.over(t, t)) * (1 + 1e-9) + 1e-12);
            narrowest = std::min(narrowest, width(range) / (width(plain.over(t, t)) + 1e-9));
        }
        double const from = d.uniform(0, 0.8) * gap, to = d.uniform(from / gap + 0.01, 1) * gap;
        double const start = d.uniform(-1, 1), end = d.uniform(-1, 1);
        auto const [beside, departure] = tube.beside_line(from, to, start, end);
        double apart = 0; // on the average, of what is not in `beside`
        for (int k = 0; k < 200; ++k) {
            double const share = (k + 0.5) / 200, t = from + share * (to - from);
            double const off = f(t) - start - share * (end - start);
            apart += std::max({beside.lower() - off, off - beside.upper(), 0.0}) / 200;
        }
        CHECK(apart <= departure + 1e-9);
    }
    CHECK(narrowest < 0.2);
    // What contradicts the variation says nothing.
    auto const odd =
        channel_tube::of_gaps({0, 1}, {between(0, 0), between(0, 0)}, {1}, {between(100, 101)});
    CHECK_THAT(odd.over(0.5, 0.5).upper(), WithinAbs(0.25, 1e-9));
}
