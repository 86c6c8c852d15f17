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
            CHECK_THAT(s.at(tau, t), WithinAbs(ramp.approximate(std::max(0.0, t - tau)), 1e-9));
        }
        std::vector<double> knots;
        s.knots(tau, 0, 3, knots);
        std::sort(knots.begin(), knots.end());
        REQUIRE(knots.size() == (tau > 0 ? (tau > 1 ? 2u : 3u) : 2u));
        CHECK(knots[0] == (tau > 0 ? tau : 1));
        auto const piece = s.on(tau, knots[0], knots[0] + 0.5);
        CHECK_THAT(piece.value, WithinAbs(s.at(tau, knots[0]), 1e-9));
        CHECK_THAT(piece.slope, WithinAbs(tau > 0 ? 2 : -1, 1e-9));
        if (tau > 0) CHECK(s.on(tau, 0, tau).slope == 0);
    }
}

TEST_CASE("hold signals jump, late or not, and formulas are late too") {
    late_signal held(sampled_signal({0, 1}, {4, 5}, interpolation::hold), 0);
    CHECK(held.jumps());
    CHECK(held.at(0.5, 1.4) == 4);
    CHECK(held.at(0.5, 1.5) == 5);
    CHECK(held.on(0.5, 1.5, 2).value == 5);
    CHECK(held.on(0.5, 1, 1.5).value == 4);
    late_signal wave(analytic_signal::from([](auto const& t) { return sin(t); }), 0.2);
    CHECK(wave.is_formula());
    CHECK_THAT(wave.at(0, 1), WithinAbs(std::sin(1.0), 1e-9));
    CHECK_THAT(wave.at(0.4, 1), WithinAbs(std::sin(0.6), 1e-9));
    CHECK_THAT(wave.at(0.4, 0.5), WithinAbs(std::sin(0.2), 1e-9));
}
