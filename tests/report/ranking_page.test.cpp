// SPDX-License-Identifier: MIT
#include "report/well_formed.hpp"
#include "support/catch.hpp"

#include "decision/planar_models.hpp"

#include <sivid/report/decision_page.hpp>

#include <limits>
#include <string>
#include <vector>

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
    auto const text = ranking_page(problem, found, {.dataset = "d <2>"}).html;
    CHECK(markup_error(body_of(text)) == "");
    CHECK_THAT(text, ContainsSubstring("run &amp; more") && ContainsSubstring("d &lt;2&gt;") &&
                         ContainsSubstring("idle &lt;1&gt; cannot matter") &&
                         ContainsSubstring("Proved from both sides"));
    auto const cut = sivid::rank(problem, {.keep_going = [] { return false; }});
    auto const open = ranking_page(problem, cut, {.dataset = "d"}).html;
    CHECK(markup_error(body_of(open)) == "");
    CHECK_THAT(open, ContainsSubstring("some bounds still apart"));
}

TEST_CASE("a ranking says that nothing matters only of what no equation carries to a measurement") {
    // p1 acts on y1, which is not measured; p2 on y2, of which the one measurement has no width; p3
    // alone moves y0 by less than its bound, and so does p4: together they pass it.
    sivid::identification_problem p;
    p.model = support::model_of(
        {.states = 1, .constants = 5},
        [](auto const&, auto const& x, auto const& c, auto const&) {
            return std::vector{-(c[0] * x[0])};
        },
        [](auto const&, auto const& x, auto const& c, auto const&) {
            return std::vector{x[0] + c[3] + c[4], c[1] * x[0], c[2] * x[0]};
        });
    p.choice.unknown = support::all_constants(5);
    p.prior = {between(0.5, 2), between(1, 9), between(1, 9), between(-0.02, 0.02),
               between(-0.02, 0.02)};
    sivid::experiment e;
    e.name = "run";
    e.initial = {sivid::interval(2.0)};
    e.measurements = {{1, 0, between(0.5, 0.6)}, {1, 2, sivid::interval(1.0)}};
    p.experiments = {e};
    std::string all;
    for (auto const& line : ranking_sentences(p, sivid::rank(p, {.seconds = 5}))) all += line;
    CHECK_THAT(all, ContainsSubstring("p1 cannot matter: no equation carries it to a measured "
                                      "channel.") &&
                        !ContainsSubstring("p2 cannot") && !ContainsSubstring("p2 alone") &&
                        ContainsSubstring("y2 of run: 1 measurement does not count") &&
                        ContainsSubstring("p3 alone moves no measurement by more than") &&
                        ContainsSubstring("p4 alone moves") && !ContainsSubstring("p3 cannot") &&
                        !ContainsSubstring("p0"));
}

TEST_CASE("a ranking shows what measurements are worth") {
    auto const p = decay({{between(0.5, 1)}}, {sivid::interval(2.0)}, 2);
    sivid::identification_problem problem{p.model, p.choice, p.sets[0], {}};
    sivid::experiment e;
    e.name = "run <3>";
    e.initial = p.initial;
    e.measurements = {{1, 0, between(0.9, 1)}, {2, 0, between(0, 1.9)}};
    problem.experiments = {e};
    auto const found = sivid::rank(problem);
    auto const worth = sivid::rank_measurements(problem, {.times = 2});
    auto const text = ranking_page(problem, found, {.dataset = "d"}, worth).html;
    CHECK(markup_error(body_of(text)) == "");
    CHECK_THAT(text, ContainsSubstring("Which measurements matter") &&
                         ContainsSubstring("nothing changes") &&
                         ContainsSubstring("all from 2 s on"));
    auto none = worth;
    none.groups.clear();
    none.explained = sivid::verdict::inconsistent;
    CHECK_THAT(ranking_page(problem, found, {.dataset = "d"}, none).html,
               ContainsSubstring("nothing can grow"));
}

TEST_CASE("groups and growths in words") {
    sivid::identification_problem about;
    about.model.about.channels = {{"psi", "rad"}};
    about.experiments.resize(1);
    about.experiments[0].name = "S3";
    CHECK(group_text(about, {.experiment = {}, .channel = 0}) == "psi");
    CHECK(group_text(about, {.experiment = 0, .channel = 0, .from = 1, .to = 2.5}) ==
          "psi of S3, 1 to 2.5 s");
    CHECK(group_text(about, {.experiment = {}, .channel = {}, .to = 2.5}) == "all before 2.5 s");
    CHECK(group_text(about, {.experiment = 0, .channel = {}, .from = 2.5}) == "S3, from 2.5 s on");
    CHECK(group_text(about, {.experiment = {}, .channel = {}, .from = 1234.5}) ==
          "all from 1234.5 s on");
    CHECK(growth_text({1, 1}) == "nothing changes");
    CHECK(growth_text({2.0534, 2.2588}) == "2.05 to 2.26 times");
    CHECK(growth_text({1, 1.0999}) == "at most 1.10 times");
    CHECK(growth_text({1.5, std::numeric_limits<double>::infinity()}) == "at least 1.50 times");
    CHECK(growth_text({1, std::numeric_limits<double>::infinity()}) == "not bounded");
}
