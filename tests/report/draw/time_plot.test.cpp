// SPDX-License-Identifier: MIT
#include "report/draw/compared_series.hpp"
#include "report/well_formed.hpp"
#include "support/catch.hpp"

#include <sivid/report/draw/time_plot.hpp>

#include <cmath>
#include <fstream>
#include <string>

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

channel_series small_rate() {
    channel_series s{.name = "missing in yaw", .unit = "rad/s^2", .zero = true};
    for (int k = 0; k < 20; ++k) {
        double const t = 0.1 * k, y = -0.3 + 0.01 * k;
        s.after.push_back({t, y});
        s.band.push_back({t, t, {y - 0.05, y + 0.05}});
    }
    s.windows = {{0.2, 0.8, {-0.42, -0.18}}, {1.0, 1.8, {-0.4, 0.1}}};
    return s;
}

channel_series motion() {
    channel_series m{.name = "u", .unit = "m/s"};
    for (int k = 0; k < 50; ++k) {
        double const t = 0.1 * k;
        m.tube.push_back({t, t + 0.1, {std::sin(t) - 0.1, std::sin(t) + 0.2}});
        m.before.push_back({t, std::sin(t)});
        m.after.push_back({t, std::sin(t) + 0.1});
    }
    return m;
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

TEST_CASE("channel series: one wild value does not flatten the others") {
    channel_series c{.name = "r", .unit = "rad/s"};
    for (int k = 0; k < 10; ++k) {
        c.measured.push_back({0.1 * k, {-1, 1}});
    }
    range const calm = value_range(c);
    CHECK(calm.lo < -1);
    CHECK(calm.hi < 1.3);
    c.measured.push_back({0.5, {1e6, 1e6 + 1}, sample_state::forced_outlier});
    c.tube.push_back({0, 1, {-INFINITY, 1e9}});
    range const wild = value_range(c);
    CHECK(wild.hi < 8);
    CHECK(wild.hi > 3);
}

TEST_CASE("channel series: nothing known still has ranges") {
    CHECK(is_finite(value_range({})));
    CHECK(is_finite(time_range({})));
    channel_series c;
    c.measured.push_back({NAN, {NAN, NAN}});
    CHECK(is_finite(value_range(c)));
    CHECK(is_finite(time_range(c)));
}

TEST_CASE("channel series: a sample's tip says what is known") {
    channel_series c{.name = "r", .unit = "rad/s"};
    c.measured = {{0.5, {1, 2}, sample_state::forced_outlier, {3, 4}}};
    std::string const text = draw_time_plot(c).str();
    CHECK_THAT(text, ContainsSubstring("t = 0.5\xC2\xA0s"));
    CHECK_THAT(text, ContainsSubstring("[1.00, 2.00] rad/s"));
    CHECK_THAT(text, ContainsSubstring("model within [3.00, 4.00]"));
    CHECK_THAT(text, ContainsSubstring("outlier (proved)"));
}

TEST_CASE("comparison plot: both lines, told apart by dash and colour") {
    std::string const text = draw_time_plot(compared_series(), {.title = "r"}).str();
    CHECK(markup_error(text) == "");
    CHECK(occurrences(text, line_before_paint.stroke) == 1);
    CHECK(occurrences(text, "stroke-dasharray=\"6 3\"") == 1);
    CHECK(occurrences(text, line_after_paint.stroke) == 1);
    auto const legend = time_plot_legend({compared_series()});
    CHECK(legend.size() == 4);
    CHECK_THAT(legend[2].label, ContainsSubstring("(estimate)"));
}

TEST_CASE("comparison plot: a diverging line does not flatten the data") {
    channel_series c = compared_series();
    c.before[9].y = 1e9;
    auto const r = value_range(c);
    CHECK(r.hi < 100);
    c.before[8] = {NAN, INFINITY};
    c.measured[1].value = {NAN, NAN};
    CHECK(markup_error(draw_time_plot(c).str()) == "");
    CHECK(time_plot_legend({}).empty());
}

TEST_CASE("missing rate: a window without zero looks different from one with it") {
    std::string const text = draw_time_plot(small_rate(), {.title = "S4"}).str();
    CHECK(markup_error(text) == "");
    CHECK_THAT(text, ContainsSubstring("0.2 to 0.8\xC2\xA0s: [\xE2\x88\x92"
                                       "0.420, \xE2\x88\x92"
                                       "0.179]\xC2\xA0rad/s\xC2\xB2, proved"));
    CHECK(occurrences(text, palette::inside) == 2); // ground and outline of one box
    CHECK(occurrences(text, ", proved</title>") == 2);
    auto const legend = time_plot_legend({small_rate()});
    REQUIRE(legend.size() == 4);
    CHECK_THAT(legend[1].label, ContainsSubstring("estimate"));
    CHECK_THAT(legend[2].label, ContainsSubstring("proved"));
}

TEST_CASE("missing rate: zero is always shown, wide bounds do not flatten the curve") {
    channel_series s = small_rate();
    s.windows.push_back({0, 1, {-1e6, 1e6}});
    range const r = value_range(s);
    CHECK(r.lo < -0.3);
    CHECK(r.hi > 0);
    CHECK(r.lo > -2);
    CHECK(r.hi < 2);
}

TEST_CASE("missing rate: undefined and empty") {
    channel_series s = small_rate();
    s.after[3] = {NAN, NAN};
    s.band[3] = {NAN, NAN, {NAN, NAN}};
    s.after[5].y = INFINITY;
    s.band[6].value = {-INFINITY, INFINITY};
    s.windows.push_back({2, 1, {0, 1}});
    s.windows.push_back({0, 1, {}});
    s.windows.push_back({0, INFINITY, {-INFINITY, INFINITY}});
    s.name = "<yaw>";
    CHECK(markup_error(draw_time_plot(s).str()) == "");
    CHECK_THAT(draw_time_plot({.zero = true}).str(), ContainsSubstring("no data"));
    CHECK(time_plot_legend({}).empty());
}

TEST_CASE("a motion is drawn with its tube and its lines") {
    auto m = motion();
    auto const picture = draw_time_plot(m, {.title = "surge <speed>"}).str();
    CHECK(markup_error(picture) == "");
    CHECK_THAT(picture, ContainsSubstring("surge &lt;speed&gt;"));
    CHECK(time_plot_legend({m}).size() == 3);
    m.zero = m.margin = true;
    auto const against = draw_time_plot(m).str();
    CHECK(markup_error(against) == "");
    CHECK_THAT(against, ContainsSubstring("violated below this line"));
    CHECK_THAT(picture, !ContainsSubstring("violated below this line"));
}

TEST_CASE("nothing and nonsense are drawn, too") {
    CHECK(markup_error(draw_time_plot({}).str()) == "");
    channel_series m;
    m.zero = m.margin = true;
    m.tube = {{0, 1, {-HUGE_VAL, HUGE_VAL}}, {NAN, 1, {0, 1}}};
    m.after = {{0, NAN}, {1, HUGE_VAL}};
    CHECK(markup_error(draw_time_plot(m).str()) == "");
    CHECK(time_plot_legend({}).empty());
}
