// SPDX-License-Identifier: MIT
#include "report/diagnosis_example.hpp"
#include "support/catch.hpp"

#include <sivid/model/effects.hpp>
#include <sivid/report/diagnosis_page.hpp>

using namespace sivid::report;
using namespace sivid_tests;

TEST_CASE("diagnosis report: the view says what the diagnosis says") {
    auto const e = hovercraft_diagnosis();
    diagnosis_view const v = e.view();
    CHECK(v.gap == sivid::gap_verdict::certified);
    CHECK(range{v.inflation} == range{3.1024, 3.1987});
    REQUIRE(v.causes.size() == e.found.causes.size());
    CHECK(v.causes[0].verdict == sivid::cause_verdict::explains);
    CHECK(v.causes[1].verdict == sivid::cause_verdict::undecided);
    CHECK(v.causes[3].verdict == sivid::cause_verdict::excluded);
    CHECK(v.plots.scenarios.size() == e.plots.scenarios.size());
    CHECK(v.about.dataset == "dev000");
}

TEST_CASE(
    "diagnosis report: the model as it is joins the candidates as what they are measured by") {
    sivid::diagnosis d;
    d.gap = sivid::gap_verdict::certified;
    d.inflation = sivid::interval(2, 3);
    d.causes.resize(1);
    d.causes[0].effects = {"wind"};
    diagnosis_view const v = view_of(d, {}, {.base_fitted = 2.5});
    REQUIRE(v.causes.size() == 2);
    CHECK(v.causes[1].effects.empty());
    CHECK(v.causes[1].verdict == sivid::cause_verdict::excluded);
    CHECK(range{v.causes[1].inflation} == range{2, 3});
    CHECK(v.causes[1].fitted_inflation == 2.5);
    d.causes.clear();
    CHECK(view_of(d).causes.empty());
}

TEST_CASE("diagnosis report: a catalogue gives meanings") {
    using namespace sivid::literals;
    sivid::effect e;
    e.name = "wind";
    e.about = "steady wind";
    e.parameters = {{"wx", "m/s", -2_dec, 2_dec, 0_dec}};
    diagnosis_report_options o;
    describe({e}, o);
    CHECK(o.meanings.at("wind") == "steady wind");
}

TEST_CASE("diagnosis report: nothing known stays nothing") {
    diagnosis_view const v = view_of(sivid::diagnosis{});
    CHECK(v.gap == sivid::gap_verdict::undecided);
    CHECK_FALSE(says_something(v.inflation));
    CHECK_FALSE(v.shrink_fit);
    CHECK(v.causes.empty());
}
