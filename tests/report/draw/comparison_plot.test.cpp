// SPDX-License-Identifier: MIT
#include "report/well_formed.hpp"
#include "support/catch.hpp"

#include <sivid/report/draw/comparison_plot.hpp>

#include <cmath>

using namespace sivid::report;
using namespace sivid_tests;

namespace {

comparison_series small_series() {
    comparison_series c{.name = "r", .unit = "rad/s"};
    for (int k = 0; k < 10; ++k) {
        c.measured.push_back({.time = 1.0 * k, .value = {k - 0.1, k + 0.1}});
        c.before.push_back({1.0 * k, k + 0.5});
        c.after.push_back({1.0 * k, 1.0 * k});
        c.misfit_before.push_back({1.0 * k, k == 7 ? 9.0 : 0.5});
    }
    c.measured[4].state = sample_state::suspect;
    return c;
}

} // namespace

TEST_CASE("comparison plot: both lines, told apart by dash and colour") {
    std::string const text = draw_comparison_plot(small_series(), {.title = "r"}).str();
    CHECK(markup_error(text) == "");
    CHECK(occurrences(text, line_before_paint.stroke) == 1);
    CHECK(occurrences(text, "stroke-dasharray=\"6 3\"") == 1);
    CHECK(occurrences(text, line_after_paint.stroke) == 1);
    auto const legend = comparison_legend({small_series()});
    CHECK(legend.size() == 4);
    CHECK_THAT(legend[2].label, ContainsSubstring("(estimate)"));
}

TEST_CASE("comparison plot: a diverging line does not flatten the data") {
    comparison_series c = small_series();
    c.before[9].y = 1e9;
    auto const r = detail::value_range(detail::plain_series(c));
    CHECK(r.hi < 100);
    c.before[8] = {NAN, INFINITY};
    c.measured[1].value = {NAN, NAN};
    CHECK(markup_error(draw_comparison_plot(c).str()) == "");
    CHECK(markup_error(draw_comparison_plot({}).str()) == "");
    CHECK_THAT(draw_comparison_plot({}).str(), ContainsSubstring("no data"));
    CHECK(comparison_legend({}).empty());
}

TEST_CASE("misfit map: every sample is in its cell, slow channels leave no gaps") {
    comparison_series slow{.name = "x"};
    for (int k = 0; k < 4; ++k) slow.misfit_before.push_back({3.0 * k, 0.25});
    heat_map const m = misfit_map({small_series(), slow}, false);
    REQUIRE(m.rows.size() == 2);
    REQUIRE(m.times.size() == 11);
    CHECK(largest_value(m) == 9);
    CHECK(*std::max_element(m.values[0].begin(), m.values[0].end()) == 9);
    for (double const v : m.values[1]) CHECK(v == 0.25);
    CHECK(misfit_map({small_series()}, true).times.empty());
    CHECK(misfit_map({}, false).times.empty());
}

TEST_CASE("misfit map: many samples are joined by their largest, undefined ones are skipped") {
    comparison_series c{.name = "u"};
    for (int k = 0; k < 5000; ++k) c.misfit_after.push_back({0.01 * k, k == 4321 ? 7.0 : 0.1});
    c.misfit_after[17].y = NAN;
    c.misfit_after[18].x = INFINITY;
    c.misfit_after[19].y = INFINITY;
    heat_map const m = misfit_map({c}, true, 50);
    CHECK(m.times.size() == 51);
    CHECK(largest_value(m) == 7);
    CHECK(markup_error(draw_heat_map(m).str()) == "");
    comparison_series once{.name = "u", .misfit_after = {{2, 0.5}}};
    CHECK(misfit_map({once}, true).values[0].size() == 1);
}
