// SPDX-License-Identifier: MIT
#include "report/well_formed.hpp"
#include "support/catch.hpp"

#include <sivid/report/draw/residual_plot.hpp>

#include <cmath>

using namespace sivid::report;
using namespace sivid_tests;

TEST_CASE("residual plot: the enclosure in units of the bound") {
    measured_sample const m{.time = 1, .value = {1, 3}, .enclosure = {1.5, 3}};
    REQUIRE(has_residual(m));
    CHECK_THAT(approximate_residual(m).lo, WithinAbs(-0.5, 1e-9));
    CHECK_THAT(approximate_residual(m).hi, WithinAbs(1, 1e-9));
    CHECK_FALSE(has_residual({.time = 1, .value = {1, 1}, .enclosure = {0, 1}}));
    CHECK_FALSE(has_residual({.time = 1, .value = {1, 2}}));
}

TEST_CASE("residual plot: drawn for each comparable sample, outliers marked") {
    channel_series c{.name = "u", .unit = "m/s"};
    for (int k = 0; k < 20; ++k) {
        c.measured.push_back({0.1 * k,
                              {0, 1},
                              k == 7 ? sample_state::forced_outlier : sample_state::regular,
                              {k == 7 ? 90.0 : 0.4, k == 7 ? 91.0 : 0.6}});
    }
    c.measured.push_back({3, {0, 1}});
    std::string const text = draw_residual_plot(c).str();
    CHECK(markup_error(text) == "");
    CHECK(occurrences(text, "<title>t = ") == 20);
    CHECK(occurrences(text, "outlier (proved)") == 1);
}

TEST_CASE("residual plot: nothing to compare, and infinite enclosures") {
    CHECK_THAT(draw_residual_plot({}).str(), ContainsSubstring("no enclosure at the samples"));
    channel_series c;
    c.measured = {{0, {0, 1}, sample_state::regular, {-INFINITY, INFINITY}},
                  {NAN, {0, 1}, sample_state::suspect, {0, 1}},
                  {1, {0, 1}, sample_state::regular, {-1e308, 1e308}}};
    CHECK(markup_error(draw_residual_plot(c).str()) == "");
}
