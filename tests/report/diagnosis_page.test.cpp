// SPDX-License-Identifier: MIT
#include "report/diagnosis_example.hpp"
#include "report/well_formed.hpp"
#include "support/catch.hpp"

#include <sivid/report/detail/diagnosis_tables.hpp>
#include <sivid/report/diagnosis_page.hpp>

#include <fstream>
#include <limits>
#include <string>

using namespace sivid::report;
using namespace sivid_tests;
using sivid::interval;

namespace {

std::string written(diagnosis_view const& v, char const* file) {
    std::string const text = diagnosis_page(v).str();
    std::ofstream{file} << text;
    return text;
}

void check_contained(std::string const& page) {
    CHECK(markup_error(body_of(page)) == "");
    CHECK(foreign_part(page) == "");
}

} // namespace

TEST_CASE("diagnosis page: a full page says everything once it is known") {
    std::string const page = written(hovercraft_diagnosis().view(), "diagnosis_page.html");
    check_contained(page);
    CHECK(page.size() < 2'000'000);
    for (auto const* const part : {"Gap (proved)",
                                   "rudder_lag explains the data (proved)",
                                   "3.10 to 3.20",
                                   "0.169\xC2\xA0s",
                                   "0.160 to 0.180, proved",
                                   "98.2 to 100\xC2\xA0%",
                                   "yaw equation",
                                   "sensors r and psi",
                                   "S1: model as it is",
                                   "H1 (held out): with rudder_lag",
                                   "Missing in the sway equation",
                                   "explains (proved)",
                                   "excluded (proved)",
                                   "RMSE of psi",
                                   "samples in the predicted tube",
                                   "What to do now",
                                   "heading_bias",
                                   "The witness",
                                   "0.1690125",
                                   "hovercraft diagnose data/dev000 --out out"}) {
        CHECK_THAT(page, ContainsSubstring(part));
    }
    // Three scenarios of six channels, twice three maps, two equations in two scenarios, one chart.
    CHECK(occurrences(page, ", before and after\"") == 18);
    CHECK(occurrences(page, ": model as it is\"") == 3);
    CHECK(occurrences(page, "aria-label=\"missing in ") == 4);
    CHECK(occurrences(page, "aria-label=\"inflation of the candidates\"") == 1);
}

TEST_CASE("diagnosis page: an empty diagnosis renders") {
    std::string const page = written(view_of(sivid::diagnosis{}), "diagnosis_page_empty.html");
    check_contained(page);
    CHECK_THAT(page, ContainsSubstring("Gap not decided"));
    CHECK(page.find("<figure") == std::string::npos);
    check_contained(diagnosis_page(diagnosis_view{}).str());
}

TEST_CASE("diagnosis page: hostile texts stay texts") {
    std::string const evil = "<script>alert(1)</script>\" onload='x' & \x01\xFF]]>";
    diagnosis_view v = hovercraft_diagnosis().view();
    v.about.dataset = v.about.model = v.about.date = v.about.machine = v.about.command = evil;
    v.about.meanings["rudder_lag"] = evil;
    v.where[0].name = v.where[0].kind = v.where[0].law = v.where[0].regime = evil;
    v.where[0].unit = v.where[0].where.scenario = v.where[0].alternatives[0] = evil;
    v.relations[0].equation = v.relations[0].sensors[0] = v.relations[0].assumptions[0] = evil;
    v.causes[1].effects = {evil, evil};
    v.causes[0].parameters[0].name = v.causes[0].parameters[0].unit = evil;
    v.causes[0].holdout->channels[0] = evil;
    v.causes[0].witness->starts[0].scenario = evil;
    v.confined = {{evil, {evil}, sivid::interval(2, 3)}};
    v.scenario_inflation[0].name = v.unobservable[0] = v.next->manoeuvre = evil;
    v.plots.missing_rates[0].equation = v.plots.missing_rates[0].scenario =
        v.plots.missing_rates[0].rate.unit = evil;
    v.plots.scenarios[0].name = v.plots.scenarios[0].channels[0].name =
        v.plots.scenarios[0].channels[0].unit = evil;
    v.assumptions = v.about.warnings = {evil};
    std::string const page = diagnosis_page(v).str();
    check_contained(page);
    CHECK(occurrences(page, " onload=") == occurrences(page, "&quot; onload="));
    CHECK(occurrences(page, "&lt;script&gt;") > 20);
}

TEST_CASE("diagnosis page: extreme and undefined numbers, long names") {
    double const inf = std::numeric_limits<double>::infinity(),
                 nan = std::numeric_limits<double>::quiet_NaN();
    diagnosis_view v = hovercraft_diagnosis().view();
    v.about.dataset =
        "campaign_of_a_very_long_night_on_the_lake_with_a_name_that_does_not_end_2026_01_31";
    v.gap = sivid::gap_verdict::undecided;
    v.inflation = interval(0.31, inf);
    v.where[0].missing = interval(-inf, 1e300);
    v.where[1].estimate = nan;
    v.where[2].where = {"a_scenario_with_a_long_name_too", -1e300, 1e300};
    v.causes[0].inflation = interval(12.5, 1e12);
    v.causes[1].inflation = intersect(interval(0, 1), interval(2, 3)); // empty
    v.causes[2].fitted_inflation = nan;
    v.causes[3].fitted_inflation = inf;
    v.causes[4].fitted_inflation = 1e250;
    v.causes[5].inflation = interval(-inf, inf);
    v.causes[0].parameters[0].value = nan;
    v.causes[0].parameters[0].hull = interval(-inf, inf);
    v.causes[0].holdout->inflation_before = interval(3, inf);
    v.causes[0].holdout->rmse_before[1] = inf;
    v.causes[0].holdout->covered_before = nan;
    v.causes[1].effects = {"quadratic_yaw_damping", "thrust_loss_with_speed", "friction_anisotropy",
                           "linear_surge_damping"};
    v.shrink_holdout = interval(-inf, 0.4);
    v.shrink_fit = interval(-0.5, -0.1);
    v.next->separation = inf;
    v.seconds = nan;
    v.interrupted = true;
    v.plots.missing_rates[0].rate.after[3] = {nan, nan};
    v.plots.missing_rates[0].rate.band[3] = {nan, nan, {nan, nan}};
    v.plots.missing_rates[0].rate.after[9].y = inf;
    v.plots.missing_rates[0].rate.windows[0].value = {-inf, inf};
    v.plots.missing_rates[1].rate.windows[1].value = {-1e300, 1e300};
    v.plots.missing_rates[2].rate.after.clear();
    v.plots.missing_rates[3] = {"yaw", "nothing", {}};
    v.plots.scenarios[0].channels[0].before[7] = {nan, inf};
    v.plots.scenarios[0].channels[1].before[7].y = 1e300;
    v.plots.scenarios[0].channels[2].misfit_before[3] = {nan, nan};
    v.plots.scenarios[0].channels[2].misfit_before[4].y = inf;
    v.plots.scenarios[0].channels[2].misfit_after[5].y = 1e200;
    v.plots.scenarios[0].channels[3].measured[2] = {nan, {nan, nan}};
    v.plots.scenarios[1].channels.clear();
    v.plots.scenarios[2].channels[0] = {};
    std::string const page = written(v, "diagnosis_page_extreme.html");
    check_contained(page);
    CHECK_THAT(page, ContainsSubstring("at least 0.309"));
    CHECK_THAT(page, ContainsSubstring("stopped early"));
}

TEST_CASE("diagnosis page: more candidates than rows") {
    diagnosis_view v = hovercraft_diagnosis().view();
    for (int k = 0; k < 80; ++k) {
        sivid::cause c;
        c.effects = {"effect_" + std::to_string(k)};
        c.fitted_inflation = 40.0 + k;
        v.causes.insert(v.causes.begin(), c);
    }
    std::string const page = written(v, "diagnosis_page_many.html");
    check_contained(page);
    CHECK_THAT(page, ContainsSubstring("Shown are 25 of 93 candidates."));
    CHECK(occurrences(page, "(logarithmic)") == 1);
    CHECK(occurrences(page, ">rudder_lag</text>") == 1);
    CHECK(occurrences(page, ">the model as it is</text>") == 1);
}

TEST_CASE("diagnosis page: a gap that nothing explains") {
    diagnosis_view v = hovercraft_diagnosis().view();
    v.answer = sivid::answer_kind::unexplained;
    v.effects.clear();
    v.indistinguishable.clear();
    v.shrink_fit = v.shrink_holdout = {};
    v.next.reset();
    for (sivid::cause& c : v.causes) {
        c.verdict = sivid::cause_verdict::excluded;
        c.inflation = interval(1.8, 2.1);
        c.witness.reset();
    }
    for (compared_scenario& s : v.plots.scenarios) {
        for (channel_series& c : s.channels) {
            c.after.clear();
            c.misfit_after.clear();
            c.tube.clear();
        }
    }
    v.confined = {{"", {"S4", "S7"}, interval(3.1, 3.3)}, {"v", {}, interval(0, 4.25)}};
    std::string const page = written(v, "diagnosis_page_unexplained.html");
    check_contained(page);
    CHECK_THAT(page, ContainsSubstring("Gap (proved); no candidate explains it"));
    CHECK_THAT(page, ContainsSubstring("all but S4 and S7 is explained (proved)"));
    CHECK_THAT(page, ContainsSubstring("Which measurements stand alone"));
    CHECK_THAT(page,
               ContainsSubstring("those of v, whose bounds must grow by a factor of at most 4.25"));
    CHECK_THAT(page, ContainsSubstring("12 are excluded (proved)"));
    CHECK(page.find("with the closest candidate, best fit") == std::string::npos);
    CHECK(page.find("of the gap (proved)") == std::string::npos);
}

TEST_CASE("diagnosis page: where no effect is found nothing removes a part of the gap") {
    for (auto const kind : {sivid::answer_kind::unexplained, sivid::answer_kind::open}) {
        diagnosis_view v = hovercraft_diagnosis().view();
        v.answer = kind;
        v.effects.clear();
        v.indistinguishable.clear();
        v.shrink_fit = interval(0.493, 0.494);
        v.shrink_holdout = interval(0.262, 0.538);
        auto const cards = diagnosis_cards(v);
        for (auto const& c : cards) CHECK_THAT(c.name, !ContainsSubstring("gap removed"));
        CHECK(diagnosis_page(v).str().find("of the gap (proved)") == std::string::npos);
    }
}

TEST_CASE("diagnosis page: every constant, and those at the end of their prior") {
    diagnosis_view v = hovercraft_diagnosis().view();
    v.constants = {{"Sv", "m^2", 0.25, {}, interval(0.2, 0.25)},
                   {"rudder_lag.tau", "s", 0.169, interval(0.16, 0.18), interval(0, 1)}};
    v.constants_verified = true;
    v.at_ends = {{{"rudder_lag"}, v.constants[0], sivid::prior_end::upper}};
    std::string const page = written(v, "diagnosis_page_constants.html");
    check_contained(page);
    CHECK_THAT(page, ContainsSubstring("All constants of the model with rudder_lag"));
    CHECK_THAT(page, ContainsSubstring("at the upper end of its prior: widen it"));
    CHECK_THAT(page, ContainsSubstring("upper end of its prior [0.2, 0.25] (with rudder_lag)"));
}
