// SPDX-License-Identifier: MIT
#include "support/catch.hpp"

#include <sivid/report/draw/axes.hpp>

#include <cmath>
#include <limits>
#include <set>
#include <string>

using namespace sivid::report;

TEST_CASE("ticks: any range can be shown") {
    double const inf = std::numeric_limits<double>::infinity(),
                 big = std::numeric_limits<double>::max();
    for (range const r :
         {range{}, range{NAN, 1}, range{-inf, inf}, range{inf, inf}, range{3, 3}, range{0, 0},
          range{1, inf}, range{-inf, 2}, range{-big, big}, range{1, std::nextafter(1.0, 2)},
          range{5e-324, 1e-323}, range{-1e-300, 1e-300}}) {
        range const shown = axis_range(r);
        CAPTURE(r.lo, r.hi);
        CHECK(std::isfinite(shown.lo));
        CHECK(std::isfinite(shown.hi));
        CHECK(shown.lo < shown.hi);
        tick_set const t = nice_ticks(r, 5);
        CHECK(t.ticks.size() >= 1);
        CHECK(t.ticks.size() <= 17);
    }
    CHECK(axis_range({1, 2}) == range{1, 2});
}

TEST_CASE("ticks: round numbers with exact labels") {
    tick_set const t = nice_ticks({0.2, 0.25}, 5);
    REQUIRE(t.ticks.size() == 6);
    CHECK(t.ticks.front().label == "0.20");
    CHECK(t.ticks[1].label == "0.21");
    CHECK(t.ticks.back().label == "0.25");
    tick_set const negative = nice_ticks({-1, 1}, 4);
    CHECK(negative.ticks.front().label == "\xE2\x88\x92"
                                          "1.0");
    CHECK(negative.ticks[2].label == "0.0");
}

TEST_CASE("ticks: very large and small numbers carry a common power") {
    tick_set const t = nice_ticks({0, 3e-7}, 3);
    CHECK(t.exponent == -7);
    CHECK(t.ticks.back().label == "3");
    CHECK(nice_ticks({0, 4e9}, 4).exponent == 9);
    CHECK(nice_ticks({0, 5000}, 4).exponent == 0);
}

TEST_CASE("ticks: in the range, evenly spaced, labels all different") {
    for (int k = -40; k < 40; ++k) {
        range const r{std::pow(1.7, k), std::pow(1.7, k) * (1 + 0.03 * (k + 41))};
        tick_set const t = nice_ticks(r, 6);
        std::set<std::string> labels;
        double const slack = 1e-5 * (r.hi - r.lo);
        for (tick const& one : t.ticks) {
            CHECK(one.value >= r.lo - slack);
            CHECK(one.value <= r.hi + slack);
            labels.insert(one.label);
        }
        CHECK(labels.size() == t.ticks.size());
        CHECK(t.ticks.size() >= 2);
    }
}

TEST_CASE("ticks: the axis text has the power and the unit in one pair of brackets") {
    CHECK(axis_text("u", "m/s", 0) == "u [m/s]");
    CHECK(axis_text("u", "", 0) == "u");
    CHECK(axis_text("u", "m^2", -3) == "u [10\xE2\x81\xBB\xC2\xB3 m\xC2\xB2]");
    CHECK(axis_text("u", "", 6) == "u [10\xE2\x81\xB6]");
}
