// SPDX-License-Identifier: MIT
#include "report/well_formed.hpp"
#include "support/catch.hpp"

#include "decision/planar_models.hpp"

#include <sivid/report/ranking_page.hpp>

using namespace sivid::report;
using namespace sivid_tests;
using namespace decision_support;

TEST_CASE("a ranking shows a bar for what acts and says what cannot matter") {
    auto const p = decay({{between(0.5, 1)}}, {sivid::interval(2.0)}, 2);
    sivid::identification_problem problem{p.model, p.choice, p.sets[0], {}};
    problem.model.about.constants.push_back(problem.model.about.constants[0]);
    problem.model.about.constants[1].name = "idle <1>";
    problem.choice.unknown.push_back("idle <1>");
    problem.prior = {between(0.5, 1), between(0, 9)};
    sivid::experiment e;
    e.name = "run & more";
    e.initial = p.initial;
    e.measurements = {{1, 0, between(1, 2)}, {2, 0, between(0, 1)}};
    problem.experiments = {e};
    auto const found = sivid::rank(problem);
    auto const text = ranking_page(problem, found, {.dataset = "d <2>"}).str();
    CHECK(markup_error(body_of(text)) == "");
    CHECK_THAT(text, ContainsSubstring("run &amp; more") && ContainsSubstring("d &lt;2&gt;") &&
                         ContainsSubstring("idle &lt;1&gt; cannot matter") &&
                         ContainsSubstring("Proved from both sides"));
    auto const cut = sivid::rank(problem, {.keep_going = [] { return false; }});
    auto const open = ranking_page(problem, cut, {.dataset = "d"}).str();
    CHECK(markup_error(body_of(open)) == "");
    CHECK_THAT(open, ContainsSubstring("some bounds still apart"));
}
