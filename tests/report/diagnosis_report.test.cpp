// SPDX-License-Identifier: MIT
#include "report/diagnosis_example.hpp"
#include "support/catch.hpp"

#include <sivid/model/effects.hpp>
#include <sivid/report/diagnosis_report.hpp>

#include <cmath>
#include <limits>

using namespace sivid::report;
using namespace sivid_tests;

TEST_CASE("diagnosis report: the view says what the diagnosis says") {
    auto const e = hovercraft_diagnosis();
    diagnosis_view const v = e.view();
    CHECK(v.gap == gap_state::present);
    CHECK(v.inflation == range{3.1024, 3.1987});
    REQUIRE(v.candidates.size() == e.found.causes.size());
    CHECK(v.candidates[0].state == candidate_state::explains);
    CHECK(v.candidates[1].state == candidate_state::open);
    CHECK(v.candidates[3].state == candidate_state::excluded);
    CHECK(v.candidates[0].parameters[0].prior == range{0, 1});
    CHECK(v.candidates[0].parameters[0].value == 0.1690125); // the witness's, not the fit's 0.169
    CHECK(v.candidates[0].parameters[0].verified);
    CHECK_FALSE(v.candidates[1].parameters[0].verified);
    CHECK(is_empty(v.candidates[1].parameters[0].hull));
    CHECK(is_empty(v.candidates[3].parameters[0].prior));
    REQUIRE(v.candidates[0].witness);
    CHECK(v.candidates[0].witness->initial[1].scenario == "S4");
    REQUIRE(v.candidates[0].holdout);
    CHECK(v.candidates[0].holdout->channels[2].unit == "rad/s");
    CHECK(v.places[0].missing == range{-0.4217, -0.1803});
    CHECK(is_empty(v.places[1].missing));
    CHECK(v.relations[0].windows.size() == 2);
    CHECK(is_empty(v.scenario_gaps[2].inflation));
    CHECK(v.shrink_holdout == range{0.9825, 1});
    CHECK(v.next->settings[1].value == 0.82);
}

TEST_CASE("diagnosis report: plot data become lines, intervals and misfits") {
    diagnosis_plot_data plots;
    plots.scenarios = {{.name = "S", .holdout = true}};
    plots.scenarios[0].channels = {{.name = "r",
                                    .unit = "rad/s",
                                    .times = {0, 1, 2},
                                    .values = {1, 2, 3},
                                    .bounds = {0.5, 0.5, 0.5},
                                    .base = {2, 2, 2},
                                    .after = {1, 2},
                                    .outliers = {false, true}}};
    plots.missing_rates = {{"yaw", "S", "rad/s^2", {0, 1}, {3, 4}, {0.5}, {{0, 1, {2, 5}}}}};
    diagnosis_view const v = view_of({}, plots);
    REQUIRE(v.scenarios.size() == 1);
    CHECK(v.scenarios[0].holdout);
    auto const& c = v.scenarios[0].channels[0];
    CHECK(c.measured.size() == 3);
    CHECK(c.measured[0].value == range{0.5, 1.5});
    CHECK(c.measured[1].state == sample_state::suspect);
    REQUIRE(c.misfit_before.size() == 2); // the suspected outlier is left out
    CHECK(c.misfit_before[0].y == 2);
    CHECK(c.misfit_before[1].x == 2);
    CHECK(c.misfit_after.size() == 1);
    CHECK(c.before.size() == 3); // without a finer line the samples are joined
    CHECK(c.after.size() == 2);
    auto const& m = v.missing_rates[0];
    CHECK(m.estimate[0].band == range{2.5, 3.5});
    CHECK(is_empty(m.estimate[1].band));
    CHECK(m.certified[0].value == range{2, 5});
}

TEST_CASE(
    "diagnosis report: the model as it is joins the candidates as what they are measured by") {
    sivid::diagnosis d;
    d.gap = sivid::gap_verdict::certified;
    d.inflation = sivid::interval(2, 3);
    d.causes.resize(1);
    d.causes[0].effects = {"wind"};
    diagnosis_view const v = view_of(d, {}, {.base_fitted = 2.5});
    REQUIRE(v.candidates.size() == 2);
    CHECK(v.candidates[1].effects.empty());
    CHECK(v.candidates[1].state == candidate_state::excluded);
    CHECK(v.candidates[1].inflation == range{2, 3});
    CHECK(v.candidates[1].fitted == 2.5);
    d.causes.clear();
    CHECK(view_of(d).candidates.empty());
}

TEST_CASE("diagnosis report: a catalogue gives meanings and priors") {
    using namespace sivid::literals;
    sivid::effect e;
    e.name = "wind";
    e.about = "steady wind";
    e.parameters = {{"wx", "m/s", -2_dec, 2_dec, 0_dec}};
    diagnosis_report_options o;
    describe({e}, o);
    CHECK(o.meanings.at("wind") == "steady wind");
    CHECK_THAT(o.priors.at("wind.wx").lower(), WithinAbs(-2, 1e-12));
    CHECK_THAT(o.priors.at("wind.wx").upper(), WithinAbs(2, 1e-12));
}

TEST_CASE("diagnosis report: nothing known stays nothing") {
    diagnosis_view const v = view_of(sivid::diagnosis{});
    CHECK(v.gap == gap_state::open);
    CHECK_FALSE(says_something(v.inflation));
    CHECK(is_empty(v.shrink_fit));
    CHECK(v.candidates.empty());
    sivid::diagnosis d;
    d.causes.resize(1);
    d.causes[0].holdout = sivid::holdout_figures{};
    CHECK(std::isnan(view_of(d).candidates[0].holdout->covered_after)); // no tube was computed
}
