// SPDX-License-Identifier: MIT
#include "report/well_formed.hpp"
#include "support/catch.hpp"

#include "decision/planar_models.hpp"

#include <sivid/report/decision_page.hpp>

#include <memory>
#include <string>

using namespace sivid::report;
using namespace sivid_tests;
using namespace decision_support;

namespace {

std::unique_ptr<sivid::stored_prediction> about(sivid::prediction_problem const& p) {
    auto result = std::make_unique<sivid::stored_prediction>();
    result->problem = p;
    result->direct = p;
    result->sides = p.choice.unknown;
    result->assumptions = {"inputs <exact>"};
    return result;
}

/// The page of a requirement over x0' = -p0 x0.
std::string page_of(std::string const& text, sivid::verification& found) {
    auto p = decay({{between(0.5, 1)}}, {sivid::interval(2.0)}, 2);
    auto const what = sivid::parse_requirement(text, p.model, p.end);
    found = sivid::verify(p, what, all_feasible(p), {.seconds = 1});
    auto const tubes = sivid::predict(p, {.seconds = 1, .cells = 10}, what.margins);
    decision_page_options o;
    o.dataset = "d";
    o.scenario = "S <1>";
    o.set = {"Ff in [0, 1]"};
    return verification_page(*about(p), what, found, tubes, o).html;
}

} // namespace

TEST_CASE("pages of all three answers are well formed and say them") {
    sivid::verification found;
    auto const proved = page_of("always(x0 > 0.2)", found);
    CHECK(markup_error(body_of(proved)) == "");
    CHECK_THAT(proved, ContainsSubstring("always(x0 &gt; 0.2)") && ContainsSubstring("Proved") &&
                           ContainsSubstring("S &lt;1&gt;") &&
                           ContainsSubstring("inputs &lt;exact&gt;"));
    auto const refuted = page_of("x0 at 1 > 0.8", found);
    REQUIRE(found.witness);
    CHECK(markup_error(body_of(refuted)) == "");
    CHECK_THAT(refuted, ContainsSubstring("Refuted") && ContainsSubstring("p0 = "));
    auto const open = page_of("always(log(x0 - 1) < 5)", found);
    CHECK(markup_error(body_of(open)) == "");
    CHECK_THAT(open, ContainsSubstring("Where it is open"));
    CHECK_THAT(open, !ContainsSubstring("Proved</"));
}

TEST_CASE("a prediction that ends early says so") {
    auto const p = explosion(between(0.9, 1.1), 2);
    auto const found = sivid::predict(p, {.seconds = 0.5, .cells = 20});
    auto const text = prediction_page(*about(p), found, {.dataset = "d", .scenario = "S"}).html;
    CHECK(markup_error(body_of(text)) == "");
    CHECK_THAT(text, ContainsSubstring("Proved up to t = ") && ContainsSubstring("not known"));
}

TEST_CASE("a witness is told with its start and with what its proof allows") {
    auto p = decay({{between(0.5, 1)}}, {between(1, 2)}, 1);
    auto const what = sivid::parse_requirement("x0 at 1 > 0.4", p.model, p.end);
    auto const found = sivid::verify(p, what, all_feasible(p));
    REQUIRE(found.witness);
    auto said = about(p);
    CHECK_THAT(answer_sentence(*said, found), ContainsSubstring("from the start x0 = 1.0"));
    said->feasible_with = "at most 2 of 9 measurements of S may lie outside of their bounds";
    CHECK_THAT(answer_sentence(*said, found), ContainsSubstring("2 of 9 measurements"));
    said->direct.initial = {sivid::interval(1.5)}; // nothing to tell
    CHECK_THAT(answer_sentence(*said, found), !ContainsSubstring("start"));
}

TEST_CASE("assumptions say whether the scenario's inputs are exact") {
    auto p = decay({{between(0.5, 1)}}, {sivid::interval(2.0)}, 1);
    auto const last = [&] { return decision_assumptions(*about(p)).back(); };
    CHECK_THAT(last(), ContainsSubstring("exactly as stated"));
    p.inputs = {sivid::sampled_signal({0}, {0}, sivid::interpolation::hold, {0.5})};
    CHECK_THAT(last(), ContainsSubstring("within their stated errors"));
}
