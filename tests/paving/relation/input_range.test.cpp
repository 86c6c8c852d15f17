// SPDX-License-Identifier: MIT
#include <sivid/paving/relation/input_range.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"

using namespace sivid;
using support::between;

TEST_CASE("inputs are enclosed on a piece and formulas by their graph") {
    signal const line = sampled_signal({0.0, 1.0, 2.0}, {0.0, 2.0, 2.0}, interpolation::linear);
    auto const range = input_over(line, 0.25, 0.5);
    CHECK_THAT(range.lower(), WithinAbs(0.5, 1e-12));
    CHECK_THAT(range.upper(), WithinAbs(1, 1e-12));
    signal const hold = sampled_signal({0.0, 1.0}, {3.0, 4.0}, interpolation::hold);
    CHECK(equal(input_over(hold, 0.2, 1.0), between(3, 3)));
    signal const formula = analytic_signal::from([](auto const& t) { return sin(t); });
    auto const wave = input_over(formula, 1, 2);
    CHECK(wave.lower() <= std::sin(1.0));
    CHECK(wave.upper() >= 1);
    signal const bad = analytic_signal::from([](auto const& t) { return sqrt(t - 1); });
    CHECK(is_entire(input_over(bad, 0, 2)));
}

TEST_CASE("between its ends an input is all that it was on the way") {
    signal const peak = sampled_signal({0.0, 0.5, 1.0}, {0.0, 7.0, 0.0}, interpolation::linear);
    auto const range = input_across(peak, 0, 1);
    CHECK(contains(range, 0));
    CHECK(contains(range, 7));
    CHECK(range.upper() < 7.001);
    signal const steps = sampled_signal({0.0, 0.5, 1.0}, {1.0, -4.0, 2.0}, interpolation::hold);
    CHECK(contains(input_across(steps, 0, 0.9), -4));
    CHECK(contains(input_across(steps, 0, 1.0), 2)); // it is there at once
    signal const vague = sampled_signal({0.0, 1.0}, {0.0, 0.0}, interpolation::linear, {0.5, 0.25});
    CHECK(input_across(vague, 0, 1).upper() >= 0.5);
}

TEST_CASE("the moves of an input over a stretch") {
    signal const line = sampled_signal({0.0, 1.0}, {0.0, 2.0}, interpolation::linear);
    CHECK(contains(input_move(line, 0.25, 0.75, false), 1));
    CHECK(width(input_move(line, 0.25, 0.75, false)) < 1e-12);
    signal const hold = sampled_signal({0.0, 1.0, 2.0}, {3.0, 4.0, 9.0}, interpolation::hold);
    CHECK(contains(input_move(hold, 1, 1.5, false), 1));
    CHECK(contains(input_around(hold, 1, 1.5, false), 3));
    CHECK(equal(input_move(hold, 1.25, 1.5, false), between(0, 0)));
    CHECK(equal(input_move(hold, 1, 1.5, true), between(0, 0))); // nothing is before
    CHECK(equal(input_around(hold, 1, 1.5, true), between(4, 4)));
    signal const vague = sampled_signal({0.0, 1.0}, {1.0, 1.0}, interpolation::linear, {0.5, 0.5});
    CHECK(contains(input_move(vague, 0, 1, false), -1));
    // After its jump, too.
    signal const late = sampled_signal({0.0, 1.0}, {0.0, 3.0}, interpolation::hold, {0.5, 0.5});
    CHECK(contains(input_move(late, 1, 2, false), -1));
    CHECK(contains(input_move(late, 1, 2, false), 4));
    signal const steep = sampled_signal({0.0, 1.0}, {0.0, 3.0}, interpolation::linear, {0.1, 0.1});
    CHECK(contains(input_move(steep, 0, 1, false), -0.2));
    signal const formula = analytic_signal::from([](auto const& t) { return sin(t); });
    CHECK(contains(input_move(formula, 1, 2.5, false), -0.2)); // it rises and falls
    CHECK(contains(input_move(formula, 1, 2.5, false), 0.15));
}
