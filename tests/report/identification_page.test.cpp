// SPDX-License-Identifier: MIT
#include "report/hovercraft_view.hpp"
#include "report/well_formed.hpp"
#include "support/catch.hpp"

#include <sivid/report/identification_page.hpp>

#include <fstream>
#include <limits>
#include <string>

using namespace sivid::report;
using namespace sivid_tests;

namespace {

std::string written(identification_view const& v, char const* file) {
    std::string const text = identification_page(v).str();
    std::ofstream{file} << text;
    return text;
}

} // namespace

TEST_CASE("identification page: a full page is well-formed, small and complete") {
    std::string const page = written(hovercraft_view(100'000, false), "identification_page.html");
    CHECK(markup_error(body_of(page)) == "");
    CHECK(page.size() < 2'000'000);
    CHECK(foreign_part(page) == "");
    CHECK_THAT(page, ContainsSubstring("Proved: the model can explain the data"));
    CHECK_THAT(page, ContainsSubstring("at least one proven-inside box"));
    CHECK_THAT(page, ContainsSubstring("Algorithm 1 of the report"));
    // Six time plots, six residual plots, trajectory, intervals, three pavings with zooms.
    CHECK(occurrences(page, "over time\"") == 6);
    CHECK(occurrences(page, "against its bounds\"") == 6);
    CHECK(occurrences(page, ": paving\"") == 6);
    // The hull that the proof did not move is printed as given.
    CHECK_THAT(page, ContainsSubstring("[0.25, 0.35]"));
    CHECK(page.find("0.2499") == std::string::npos);
}

TEST_CASE("identification page: outliers are marked and listed") {
    std::string const page =
        written(hovercraft_view(20'000, true), "identification_page_outliers.html");
    CHECK(markup_error(body_of(page)) == "");
    CHECK_THAT(page, ContainsSubstring("<h2>Outliers</h2>"));
    CHECK_THAT(page, ContainsSubstring("2 measurements are proved to be outliers"));
    CHECK_THAT(page, ContainsSubstring("suspected: violated by the witness; not proved"));
    CHECK_THAT(page, ContainsSubstring("To be noted"));
}

TEST_CASE("identification page: what such data can tell stands there when it is known") {
    identification_view v = hovercraft_view(2'000, false);
    CHECK(identification_page(v).str().find("What such data can tell") == std::string::npos);
    v.identifiability = {"180 measured outputs and 3 unknowns: rank 2, proved",
                         "free: Sg * k, L / k (by the equations)"};
    v.identifiability_at = "at the witness";
    std::string const page = identification_page(v).str();
    CHECK(markup_error(body_of(page)) == "");
    CHECK_THAT(page, ContainsSubstring("<h2>What such data can tell</h2>"));
    CHECK_THAT(page, ContainsSubstring("measured values, at the witness."));
    CHECK_THAT(page, ContainsSubstring("rank 2, proved"));
    CHECK_THAT(page, ContainsSubstring("Sg * k, L / k (by the equations)"));
}

TEST_CASE("identification page: hostile texts stay texts") {
    identification_view v = hovercraft_view(2'000, true);
    std::string const evil = "<script>alert(1)</script>\" onload='x' & \x01\xFF]]>";
    v.dataset = v.model = v.sentence = v.tube_meaning = v.footer[0] = evil;
    v.parameters[0].name = v.parameters[0].unit = v.parameters[0].meaning = evil;
    v.combinations[0].formula = v.combinations[0].note = evil;
    v.scenarios[0].name = v.scenarios[0].channels[0].name = v.scenarios[0].channels[0].unit = evil;
    v.pavings[0].x.label = v.pavings[0].x.unit = evil;
    v.comparison[0].name = v.warnings[0] = v.assumptions[0] = evil;
    v.witness->parameters[0].name = evil;
    v.identifiability = {evil};
    v.identifiability_at = evil;
    std::string const page = identification_page(v).str();
    CHECK(markup_error(body_of(page)) == "");
    CHECK(foreign_part(page) == "");
    CHECK(occurrences(page, " onload=") == occurrences(page, "&quot; onload="));
    CHECK(occurrences(page, "&lt;script&gt;") > 10);
}

TEST_CASE("identification page: nothing known, nothing drawn, nothing breaks") {
    identification_view v{.dataset = "empty", .model = ""};
    std::string const page = identification_page(v).str();
    CHECK(markup_error(body_of(page)) == "");
    CHECK_THAT(page, ContainsSubstring("Not decided"));
    CHECK(page.find("<h2>Parameters</h2>") == std::string::npos);
    CHECK(page.find("<figure") == std::string::npos);
}

TEST_CASE("identification page: a refuted campaign with empty hulls and wild numbers") {
    double const inf = std::numeric_limits<double>::infinity(),
                 nan = std::numeric_limits<double>::quiet_NaN();
    identification_view v = hovercraft_view(500, false);
    v.verdict = outcome::refuted;
    v.sentence.clear();
    v.witness.reset();
    v.volume_inner = v.volume_outer = {0, 0};
    for (parameter_view& p : v.parameters) {
        p.hull = {};
    }
    v.parameters.push_back({"odd", "", {nan, inf}, {-inf, inf}});
    v.combinations.clear();
    for (paving_projection& p : v.pavings) {
        p.boxes.clear();
    }
    v.scenarios[0].channels[0].tube[3].value = {-inf, inf};
    v.scenarios[0].channels[1].tube[5].value = {-1e300, 1e300};
    v.scenarios[0].channels[2].measured[2] = {nan, {nan, nan}};
    v.scenarios[0].channels[3].reference[1] = {nan, inf};
    v.scenarios[0].plane->tube[4] = {{-inf, inf}, {-1e308, 1e308}};
    v.statistics.seconds = nan;
    std::string const page = written(v, "identification_page_refuted.html");
    CHECK(markup_error(body_of(page)) == "");
    CHECK_THAT(page, ContainsSubstring("Proved: the model cannot explain the data"));
    CHECK_THAT(page, ContainsSubstring("every part of the prior was excluded by a proof"));
}
