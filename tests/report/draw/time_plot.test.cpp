// SPDX-License-Identifier: MIT
#include "report/well_formed.hpp"
#include "support/catch.hpp"

#include <sivid/report/draw/time_plot.hpp>

#include <cmath>
#include <fstream>

using namespace sivid::report;
using namespace sivid_tests;

namespace {

/// Thirty seconds of one channel with two gross outliers, as in the report's Figure 4.1.
channel_series figure_4_1() {
    channel_series c{.name = "r", .unit = "rad/s"};
    for (int k = 0; k < 300; ++k) {
        double const t = 0.1 * k, a = std::sin(0.4 * t) * std::exp(-0.03 * t);
        c.tube.push_back({t, t + 0.1, {a - 0.04 - 0.002 * t, a + 0.06 + 0.002 * t}});
        c.reference.push_back({t, a});
        if (k % 5 == 0 && k > 0) {
            bool const wild = k == 100 || k == 210;
            double const middle =
                a + 0.08 * std::sin(37.0 * k) + (wild ? (k == 100 ? 1.4 : -1.2) : 0);
            c.measured.push_back({t,
                                  {middle - 0.12, middle + 0.12},
                                  wild ? sample_state::forced_outlier : sample_state::regular});
        }
    }
    return c;
}

} // namespace

TEST_CASE("time plot: bars, tube, reference and marked outliers") {
    std::string const text =
        draw_time_plot(figure_4_1(),
                       {.width = 760, .height = 320, .title = "Yaw rate", .legend = true})
            .str();
    std::ofstream{"time_plot.svg"} << text;
    CHECK(markup_error(text) == "");
    CHECK(occurrences(text, "outlier (proved)</title>") == 2);
    CHECK_THAT(text, ContainsSubstring("proven enclosure of the model"));
    CHECK_THAT(text, ContainsSubstring("r [rad/s]"));
    CHECK(occurrences(text, "<title>t = ") == 59);
}

TEST_CASE("time plot: the tube is drawn as a whole and breaks at a gap") {
    channel_series c{.name = "u", .unit = ""};
    c.tube = {{0, 1, {0, 1}}, {1, 2, {0.2, 1.2}}, {3, 4, {0, 1}}};
    std::string const text = draw_time_plot(c).str();
    auto const at = text.find("opacity=\"0.45\"");
    auto const start = text.rfind(" d=\"", at);
    CHECK(occurrences(text.substr(start, at - start), "Z") == 2);
}

TEST_CASE("time plot: many samples are thinned and said to be, outliers stay") {
    channel_series c{.name = "u", .unit = ""};
    for (int k = 0; k < 50'000; ++k) {
        c.measured.push_back(
            {0.001 * k, {-1, 1}, k == 777 ? sample_state::suspect : sample_state::regular});
        c.tube.push_back({0.001 * k, 0.001 * (k + 1), {-0.5, 0.5}});
    }
    std::string const text = draw_time_plot(c).str();
    CHECK(text.size() < 120'000);
    CHECK_THAT(text, ContainsSubstring("drawn</text>"));
    CHECK(occurrences(text, "suspected outlier") == 1);
}

TEST_CASE("time plot: empty, infinite and hostile data") {
    CHECK_THAT(draw_time_plot({}).str(), ContainsSubstring("no data"));
    channel_series c{.name = "<u>", .unit = "\"&"};
    c.measured = {{NAN, {0, 1}}, {0, {NAN, 1}}, {INFINITY, {0, 1}}, {1, {0, 0}}};
    c.tube = {{0, 1, {-INFINITY, INFINITY}}, {1, NAN, {0, 1}}, {2, 1, {0, 1}}, {1, 1, {0, 0}}};
    c.reference = {{0, NAN}, {INFINITY, 0}, {1, 1e300}};
    CHECK(markup_error(draw_time_plot(c, {.title = "<script>", .legend = true}).str()) == "");
    CHECK(markup_error(draw_time_plot({}).str()) == "");
}

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
