// SPDX-License-Identifier: MIT
#include <sivid/approximate/simulate/late_signal.hpp>

#include "support/catch.hpp"

#include <cmath>

using namespace sivid;

TEST_CASE("a late signal stands still until its delay is over") {
    sampled_signal const ramp({0, 1, 2}, {1, 3, 2}, interpolation::linear);
    late_signal s(ramp, 0);
    CHECK_FALSE(s.jumps());
    for (double const tau : {0.0, 0.3, 1.7}) {
        for (double t = 0; t < 3; t += 0.11) {
            CHECK_THAT(s.at({tau}, t), WithinAbs(ramp.approximate(std::max(0.0, t - tau)), 1e-9));
        }
        std::vector<double> knots;
        s.knots({tau}, 0, 3, knots);
        std::sort(knots.begin(), knots.end());
        REQUIRE(knots.size() == (tau > 0 ? (tau > 1 ? 2u : 3u) : 2u));
        CHECK(knots[0] == (tau > 0 ? tau : 1));
        auto const piece = s.on({tau}, knots[0], knots[0] + 0.5);
        CHECK_THAT(piece.value, WithinAbs(s.at({tau}, knots[0]), 1e-9));
        CHECK_THAT(piece.slope, WithinAbs(tau > 0 ? 2 : -1, 1e-9));
        if (tau > 0) CHECK(s.on({tau}, 0, tau).slope == 0);
    }
}

TEST_CASE("hold signals jump, late or not, and formulas are late too") {
    late_signal held(sampled_signal({0, 1}, {4, 5}, interpolation::hold), 0);
    CHECK(held.jumps());
    CHECK(held.at({0.5}, 1.4) == 4);
    CHECK(held.at({0.5}, 1.5) == 5);
    CHECK(held.on({0.5}, 1.5, 2).value == 5);
    CHECK(held.on({0.5}, 1, 1.5).value == 4);
    late_signal wave(analytic_signal::from([](auto const& t) { return sin(t); }), 0.2);
    CHECK(wave.is_formula());
    CHECK_THAT(wave.at({0}, 1), WithinAbs(std::sin(1.0), 1e-9));
    CHECK_THAT(wave.at({0.4}, 1), WithinAbs(std::sin(0.6), 1e-9));
    CHECK_THAT(wave.at({0.4}, 0.5), WithinAbs(std::sin(0.2), 1e-9));
}

TEST_CASE("a signal whose clock runs slow is ever later") {
    sampled_signal const ramp({-1, 0.5, 1, 2, 3}, {0, 1, 3, 2, 2.5}, interpolation::linear);
    double const begin = -0.5;
    for (dead_time const late : {dead_time{0, 0.2}, {0.3, 0.1}, {0.1, 0.6}}) {
        late_signal s(ramp, begin);
        std::vector<double> knots;
        s.knots(late, begin, 6, knots);
        std::sort(knots.begin(), knots.end());
        knots.insert(knots.begin(), begin);
        knots.push_back(6);
        for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
            auto const piece = s.on(late, knots[k], knots[k + 1]);
            for (double const share : {0.01, 0.5, 0.99}) {
                double const t = knots[k] + share * (knots[k + 1] - knots[k]);
                double const past = t - late.delay - late.drift * (t - begin);
                double const want = ramp.approximate(std::max(begin, past));
                CHECK_THAT(s.at(late, t), WithinAbs(want, 1e-12));
                CHECK_THAT(piece.value + piece.slope * (t - knots[k]), WithinAbs(want, 1e-12));
            }
        }
    }
}
