// SPDX-License-Identifier: MIT
#include "report/well_formed.hpp"
#include "support/catch.hpp"

#include <sivid/report/draw/detail/motion_plot.hpp>

#include <cmath>
#include <limits>

using namespace sivid::report;
using namespace sivid_tests;

namespace {

motion_series margin() {
    motion_series m;
    m.tube.name = "u";
    m.tube.unit = "m/s";
    for (int k = 0; k < 50; ++k) {
        double const t = 0.1 * k;
        m.tube.tube.push_back({t, t + 0.1, {std::sin(t) - 0.1, std::sin(t) + 0.2}});
        m.tube.reference.push_back({t, std::sin(t)});
        m.single.push_back({t, std::sin(t) + 0.1});
    }
    return m;
}

} // namespace

TEST_CASE("a motion is drawn with its tube and its lines") {
    auto m = margin();
    auto const picture = draw_motion_plot(m, {.title = "surge <speed>"}).str();
    CHECK(markup_error(picture) == "");
    CHECK_THAT(picture, ContainsSubstring("surge &lt;speed&gt;"));
    CHECK(motion_plot_legend({m}).size() == 3);
    m.zero = true;
    auto const against = draw_motion_plot(m).str();
    CHECK(markup_error(against) == "");
    CHECK_THAT(against, ContainsSubstring("violated below this line"));
    CHECK_THAT(picture, !ContainsSubstring("violated below this line"));
}

TEST_CASE("nothing and nonsense are drawn, too") {
    CHECK(markup_error(draw_motion_plot({}).str()) == "");
    motion_series m;
    m.zero = true;
    m.tube.tube = {{0, 1, {-HUGE_VAL, HUGE_VAL}}, {NAN, 1, {0, 1}}};
    m.single = {{0, NAN}, {1, HUGE_VAL}};
    CHECK(markup_error(draw_motion_plot(m).str()) == "");
    CHECK(motion_plot_legend({}).empty());
}
