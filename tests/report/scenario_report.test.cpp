// SPDX-License-Identifier: MIT
#include <sivid/report/identification_report.hpp>

#include "io/small_identification.hpp"
#include "support/catch.hpp"

#include <cmath>

using namespace sivid::report;
using io_support::two_rates_problem;
using io_support::two_rates_result;

TEST_CASE("measurements, tube and reference line of an experiment") {
    auto const problem = two_rates_problem(true);
    auto const found = two_rates_result(problem);
    auto const motion = sivid::find_explaining_motion(problem, found, 60);
    REQUIRE(motion);
    auto const s = view_of(problem, found, &*motion, {}).scenarios.at(0);
    CHECK(s.name == "run");
    CHECK(s.measurements == 6);
    REQUIRE(s.channels.size() == 1);
    auto const& c = s.channels[0];
    CHECK(c.name == "x");
    REQUIRE(c.measured.size() == 6);
    for (std::size_t i = 0; i < 6; ++i) {
        CHECK(c.measured[i].state ==
              (i == 2 ? sample_state::forced_outlier : sample_state::regular));
        CHECK(is_finite(c.measured[i].enclosure));
    }
    // The tube has no gap and contains the exact motion of its middle at every instant.
    REQUIRE(c.tube.size() >= 60);
    auto const p = mid(motion->parameters);
    for (std::size_t k = 0; k < c.tube.size(); ++k) {
        CHECK(c.tube[k].from == (k == 0 ? 0 : c.tube[k - 1].to));
        double const t = (c.tube[k].from + c.tube[k].to) / 2;
        double const x = 2 * std::exp(-p[0] * p[1] * t);
        CHECK(c.tube[k].value.lo <= x);
        CHECK(x <= c.tube[k].value.hi);
    }
    REQUIRE(found.witness);
    auto const& w = found.witness->parameters;
    for (auto const& r : c.reference) {
        CHECK_THAT(r.y, WithinAbs(2 * std::exp(-w[0] * w[1] * r.x), 1e-6));
    }
    CHECK_FALSE(s.plane);
}

TEST_CASE("a plane needs both of its channels") {
    auto const problem = two_rates_problem();
    auto const found = two_rates_result(problem);
    auto const motion = sivid::find_explaining_motion(problem, found, 20);
    REQUIRE(motion);
    auto const in_plane = [&](plane_channels const& names) {
        return view_of(problem, found, &*motion, {.plane = names}).scenarios.at(0).plane;
    };
    CHECK_FALSE(in_plane({"x", "y", "psi"}));
    auto const diagonal = in_plane({"x", "x", ""});
    REQUIRE(diagonal);
    CHECK(diagonal->tube.size() >= 20);
    CHECK(diagonal->poses.empty());
}

TEST_CASE("without a motion only the measurements are shown") {
    auto const problem = two_rates_problem();
    auto const s = view_of(problem, two_rates_result(problem), nullptr, {}).scenarios.at(0);
    REQUIRE(s.channels.size() == 1);
    CHECK(s.channels[0].tube.empty());
    CHECK(s.channels[0].reference.empty());
    CHECK(is_empty(s.channels[0].measured[0].enclosure));
}
