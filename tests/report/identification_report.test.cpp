// SPDX-License-Identifier: MIT
#include <sivid/report/identification_report.hpp>

#include "io/small_identification.hpp"
#include "report/well_formed.hpp"
#include "support/catch.hpp"

#include <sivid/report/identification_page.hpp>

using namespace sivid::report;
using io_support::two_rates_problem;
using io_support::two_rates_result;

TEST_CASE("the view says what the identification proved, and no more") {
    auto const problem = two_rates_problem();
    auto const found = two_rates_result(problem);
    auto const motion = sivid::find_explaining_motion(problem, found, 40);
    REQUIRE(motion);
    auto const v =
        view_of(problem, found, &*motion, {.dataset = "small", .meanings = {{"a", "first rate"}}});
    CHECK(v.dataset == "small");
    CHECK(v.model == "two rates");
    CHECK(v.verdict == outcome::proved);
    REQUIRE(v.parameters.size() == 2);
    CHECK(v.parameters[0].meaning == "first rate");
    CHECK(v.parameters[0].hull.lo <= found.hull[0].lower());
    CHECK(v.parameters[0].hull.hi >= found.hull[0].upper());
    REQUIRE(v.combinations.size() == 1);
    CHECK_THAT(v.combinations[0].note, StartsWith("a and b are known only through"));
    CHECK(v.combinations[0].hull.lo <= 0.5);
    CHECK(v.combinations[0].hull.hi >= 0.5);
    CHECK(v.volume_inner.lo <= found.paving.inner_volume().lower());
    CHECK(v.volume_outer.hi >= found.paving.outer_volume().upper());
    REQUIRE(v.witness);
    CHECK(v.witness->parameters[1].value == found.witness->parameters[1]);
    REQUIRE(v.pavings.size() == 1);
    CHECK(v.pavings[0].x.label == "a");
    CHECK_THAT(v.tube_meaning, ContainsSubstring("proved to explain the data"));
    CHECK(v.warnings.empty());
    auto const page = identification_page(v).str();
    CHECK(sivid_tests::markup_error(sivid_tests::body_of(page)) == "");
}

TEST_CASE("what is bridged where samples of an input are missing stands on the page") {
    auto problem = two_rates_problem();
    auto found = two_rates_result(problem);
    problem.experiments[0].bridged = {{"torque", 43, 0.12, false}};
    found.assumptions.front() = sivid::input_assumption(problem.experiments);
    auto const v = view_of(problem, found, nullptr, {.dataset = "small"});
    CHECK_THAT(v.assumptions.front(),
               StartsWith("The recorded inputs are exact") &&
                   EndsWith("nobody knows what the input did there: input torque: straight lines "
                            "over 43 missing samples, longest gap 0.12 s."));
}

TEST_CASE("a forced outlier is marked as proved, and its budget shown") {
    auto const problem = two_rates_problem(true);
    auto const found = two_rates_result(problem);
    auto const v = view_of(problem, found, nullptr, {.dataset = "small"});
    std::vector<std::pair<double, sample_state>> marked;
    for_marked(
        v, [&](auto const&, auto const&, auto const& m) { marked.emplace_back(m.time, m.state); });
    CHECK(marked == std::vector{std::pair{1.5, sample_state::forced_outlier}});
    REQUIRE(v.scenarios.size() == 1);
    CHECK(v.scenarios[0].outlier_budget == 1);
    CHECK(v.tube_meaning.empty());
}

TEST_CASE("an inconsistent result has empty hulls and an honest line") {
    auto const problem = io_support::impossible_problem();
    auto const found = two_rates_result(problem);
    auto const motion = sivid::find_explaining_motion(problem, found, 20);
    auto const v = view_of(problem, found, motion ? &*motion : nullptr, {.dataset = "small"});
    CHECK(v.verdict == outcome::refuted);
    CHECK(is_empty(v.parameters[0].hull));
    if (motion) CHECK_THAT(v.tube_meaning, ContainsSubstring("not proved to explain"));
    auto const page = identification_page(v).str();
    CHECK(sivid_tests::markup_error(sivid_tests::body_of(page)) == "");
}

TEST_CASE("volumes that agree to many digits are widened outward, never beyond the whole") {
    auto found = two_rates_result(two_rates_problem());
    auto const shown = [&](sivid::interval const& volume) {
        found.paving.set_volumes(volume, volume);
        return comparison_of("", found, false).inner_volume;
    };
    auto const r = shown(sivid::interval(0.25, 0.25000000001));
    CHECK(r.lo < 0.25);
    CHECK(r.hi > 0.25000000001);
    CHECK(r.hi < 0.2502);
    CHECK(shown(sivid::interval(0.5, 1.0000001)).hi <= 1);
    CHECK(shown(sivid::interval(0.0)) == range{0, 0});
    CHECK(shown(sivid::interval(0.1, 0.2)) == range{0.1, 0.2});
}

TEST_CASE("a row of the comparison repeats the identification") {
    auto const problem = two_rates_problem();
    auto const found = two_rates_result(problem);
    auto const row = comparison_of("mine", found, true, "note");
    CHECK(row.name == "mine");
    CHECK(row.boxes == found.boxes);
    CHECK(row.chosen);
    CHECK(row.outer_volume.hi >= found.paving.outer_volume().upper());
}
