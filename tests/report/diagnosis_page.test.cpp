// SPDX-License-Identifier: MIT
#include "report/diagnosis_example.hpp"
#include "report/well_formed.hpp"
#include "support/catch.hpp"

#include <sivid/report/diagnosis_page.hpp>
#include <sivid/report/page/detail/diagnosis_tables.hpp>

#include <fstream>
#include <limits>
#include <string>

using namespace sivid::report;
using namespace sivid_tests;

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
    v.dataset = v.model = v.version = v.date = v.machine = v.command = evil;
    v.meanings["rudder_lag"] = evil;
    v.places[0].name = v.places[0].kind = v.places[0].law = v.places[0].regime = evil;
    v.places[0].unit = v.places[0].where.scenario = v.places[0].alternatives[0] = evil;
    v.relations[0].equation = v.relations[0].sensors[0] = v.relations[0].assumptions[0] = evil;
    v.candidates[1].effects = {evil, evil};
    v.candidates[0].parameters[0].name = v.candidates[0].parameters[0].unit = evil;
    v.candidates[0].holdout->channels[0].name = evil;
    v.candidates[0].witness->initial[0].scenario = evil;
    v.confined = {{evil, {evil}, {2, 3}}};
    v.scenario_gaps[0].name = v.unobservable[0] = v.next->manoeuvre = evil;
    v.missing_rates[0].equation = v.missing_rates[0].scenario = v.missing_rates[0].unit = evil;
    v.scenarios[0].name = v.scenarios[0].channels[0].name = v.scenarios[0].channels[0].unit = evil;
    v.assumptions = v.warnings = v.absorbed = {evil};
    std::string const page = diagnosis_page(v).str();
    check_contained(page);
    CHECK(occurrences(page, " onload=") == occurrences(page, "&quot; onload="));
    CHECK(occurrences(page, "&lt;script&gt;") > 20);
}

TEST_CASE("diagnosis page: extreme and undefined numbers, long names") {
    double const inf = std::numeric_limits<double>::infinity(),
                 nan = std::numeric_limits<double>::quiet_NaN();
    diagnosis_view v = hovercraft_diagnosis().view();
    v.dataset =
        "campaign_of_a_very_long_night_on_the_lake_with_a_name_that_does_not_end_2026_01_31";
    v.gap = gap_state::open;
    v.inflation = {0.31, inf};
    v.places[0].missing = {-inf, 1e300};
    v.places[1].estimate = nan;
    v.places[2].where = {"a_scenario_with_a_long_name_too", -1e300, 1e300};
    v.candidates[0].inflation = {12.5, 1e12};
    v.candidates[1].inflation = {nan, nan};
    v.candidates[2].fitted = nan;
    v.candidates[3].fitted = inf;
    v.candidates[4].fitted = 1e250;
    v.candidates[5].inflation = {-inf, inf};
    v.candidates[0].parameters[0].value = nan;
    v.candidates[0].parameters[0].hull = {-inf, inf};
    v.candidates[0].holdout->inflation_before = {3, inf};
    v.candidates[0].holdout->channels[1].rmse_before = inf;
    v.candidates[0].holdout->covered_before = nan;
    v.candidates[1].effects = {"quadratic_yaw_damping", "thrust_loss_with_speed",
                               "friction_anisotropy", "linear_surge_damping"};
    v.shrink_holdout = {-inf, 0.4};
    v.shrink_fit = {-0.5, -0.1};
    v.next->separation = inf;
    v.seconds = nan;
    v.interrupted = true;
    v.missing_rates[0].estimate[3] = {nan, nan, {nan, nan}};
    v.missing_rates[0].estimate[9].value = inf;
    v.missing_rates[0].certified[0].value = {-inf, inf};
    v.missing_rates[1].certified[1].value = {-1e300, 1e300};
    v.missing_rates[2].estimate.clear();
    v.missing_rates[3] = {"yaw", "nothing", "", {}, {}};
    v.scenarios[0].channels[0].before[7] = {nan, inf};
    v.scenarios[0].channels[1].before[7].y = 1e300;
    v.scenarios[0].channels[2].misfit_before[3] = {nan, nan};
    v.scenarios[0].channels[2].misfit_before[4].y = inf;
    v.scenarios[0].channels[2].misfit_after[5].y = 1e200;
    v.scenarios[0].channels[3].measured[2] = {nan, {nan, nan}};
    v.scenarios[1].channels.clear();
    v.scenarios[2].channels[0] = {};
    std::string const page = written(v, "diagnosis_page_extreme.html");
    check_contained(page);
    CHECK_THAT(page, ContainsSubstring("at least 0.309"));
    CHECK_THAT(page, ContainsSubstring("stopped early"));
}

TEST_CASE("diagnosis page: more candidates than rows") {
    diagnosis_view v = hovercraft_diagnosis().view();
    for (int k = 0; k < 80; ++k) {
        v.candidates.insert(v.candidates.begin(),
                            {.effects = {"effect_" + std::to_string(k)}, .fitted = 40.0 + k});
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
    v.answer = answer_state::unexplained;
    v.effects.clear();
    v.indistinguishable.clear();
    v.shrink_fit = v.shrink_holdout = {};
    v.next.reset();
    for (candidate_view& c : v.candidates) {
        c.state = candidate_state::excluded;
        c.inflation = {1.8, 2.1};
        c.witness.reset();
    }
    for (compared_scenario& s : v.scenarios) {
        for (comparison_series& c : s.channels) {
            c.after.clear();
            c.misfit_after.clear();
            c.tube.clear();
        }
    }
    v.confined = {{"", {"S4", "S7"}, {3.1, 3.3}}, {"v", {}, {0, 4.25}}};
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
    for (auto const kind : {answer_state::unexplained, answer_state::open}) {
        diagnosis_view v = hovercraft_diagnosis().view();
        v.answer = kind;
        v.effects.clear();
        v.indistinguishable.clear();
        v.shrink_fit = {0.493, 0.494};
        v.shrink_holdout = {0.262, 0.538};
        auto const cards = diagnosis_cards(v);
        for (auto const& c : cards) CHECK_THAT(c.name, !ContainsSubstring("gap removed"));
        CHECK(diagnosis_page(v).str().find("of the gap (proved)") == std::string::npos);
    }
}

TEST_CASE("diagnosis page: every constant, and those at the end of their prior") {
    diagnosis_view v = hovercraft_diagnosis().view();
    v.constants = {{"Sv", "m^2", 0.25, {}, {0.2, 0.25}, true},
                   {"rudder_lag.tau", "s", 0.169, {0.16, 0.18}, {0, 1}, true}};
    v.at_ends = {{{"rudder_lag"}, v.constants[0], true}};
    std::string const page = written(v, "diagnosis_page_constants.html");
    check_contained(page);
    CHECK_THAT(page, ContainsSubstring("All constants of the model with rudder_lag"));
    CHECK_THAT(page, ContainsSubstring("at the upper end of its prior: widen it"));
    CHECK_THAT(page, ContainsSubstring("upper end of its prior [0.2, 0.25] (with rudder_lag)"));
}
