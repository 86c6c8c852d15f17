// SPDX-License-Identifier: MIT
#include "report/diagnosis_example.hpp"
#include "report/well_formed.hpp"
#include "support/catch.hpp"

#include <sivid/report/detail/diagnosis_tables.hpp>
#include <sivid/report/diagnosis_page.hpp>

using namespace sivid::report;
using namespace sivid_tests;

TEST_CASE("diagnosis figures: before and after stand side by side with one key") {
    auto const f = misfit_figure(hovercraft_diagnosis().view());
    REQUIRE(f.panels.size() == 6);
    CHECK(f.panels[0].height() == f.panels[1].height());
    CHECK(f.panels[2].height() < f.panels[0].height());
    CHECK_THAT(f.panels[5].str(), ContainsSubstring("H1 (held out): with rudder_lag"));
    CHECK(misfit_figure({}).panels.empty());
}

TEST_CASE("diagnosis figures: one for each equation, scenarios on one scale") {
    auto const all = missing_rate_figures(hovercraft_diagnosis().view().plots.missing_rates);
    REQUIRE(all.size() == 2);
    CHECK(all[0].title == "Missing in the yaw equation.");
    CHECK(all[0].panels.size() == 2);
    CHECK(missing_rate_figures({}).empty());
}

TEST_CASE("diagnosis figures: motions and candidates") {
    auto const v = hovercraft_diagnosis().view();
    CHECK(motion_figure(v.plots.scenarios[0]).panels.size() == 6);
    CHECK(motion_figure(v.plots.scenarios[0]).caption.empty());
    CHECK_THAT(motion_figure(v.plots.scenarios[2]).caption, ContainsSubstring("Held-out data"));
    CHECK(motion_figure({}).panels.empty());
    auto const f = candidate_figure(v, 4);
    REQUIRE(f.panels.size() == 1);
    CHECK(occurrences(f.panels[0].str(), ", best fit</title>") == 4);
    CHECK_THAT(f.caption, ContainsSubstring("Shown are 4 of 13 candidates."));
    CHECK(candidate_figure({}).panels.empty());
}
