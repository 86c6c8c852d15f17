// SPDX-License-Identifier: MIT
#include "report/diagnosis_example.hpp"
#include "support/catch.hpp"

#include <sivid/report/detail/diagnosis_tables.hpp>
#include <sivid/report/diagnosis_page.hpp>

#include <algorithm>
#include <string>
#include <vector>

using namespace sivid::report;
using namespace sivid_tests;

namespace {

std::string all_of(std::vector<std::string> const& lines) {
    std::string text;
    for (auto const& l : lines) text += l + "\n";
    return text;
}
std::string page_of(diagnosis_view const& v) {
    page out{{.kind = "", .title = "", .lead = ""}};
    add_advice(out, v);
    return out.str();
}

} // namespace

TEST_CASE("advice: a simulator is told the change, its numbers and what it costs to leave it out") {
    auto const v = hovercraft_diagnosis().view();
    auto const t = change_table(v);
    REQUIRE(t.rows.size() == 1);
    CHECK(t.rows[0][0] == "tau");
    CHECK(t.rows[0][1] == "0.169 \xE2\x9C\x93");
    CHECK(t.rows[0][2] == "0.160 to 0.180");
    CHECK(t.rows[0][4] == "rudder_lag");
    auto const costs = cost_table(v);
    REQUIRE(costs.rows.size() == 3);
    CHECK(costs.rows[2][0] == "H1 (held out)");
    for (auto const& row : costs.rows) {
        CHECK(row.size() == costs.columns.size());
        CHECK(std::stod(row[4]) > 2 * std::stod(row[5])); // it costs something everywhere
    }
    auto const text = page_of(v);
    for (auto const* fact : {"What to do now", "Add to the simulator", "delta becomes",
                             "What it costs to leave it out", "zigzag"})
        CHECK_THAT(text, ContainsSubstring(fact));
}

TEST_CASE("advice: the largest misfit is told in the unit of its channel") {
    diagnosis_view v;
    channel_series a{.name = "u", .unit = "m/s"}, b{.name = "psi", .unit = "rad"};
    a.measured = {{.time = 1, .value = {0.9, 1.1}}, {.time = 2, .value = {1.9, 2.1}}};
    a.misfit_before = {{1, 0.5}, {2, 3}};
    a.misfit_after = {{1, 0.5}, {2, 0.25}};
    b.measured = {{.time = 1.5, .value = {0, 0.02}}};
    b.misfit_before = {{1.5, 2}};
    b.misfit_after = {{1.5, 0.75}};
    v.plots.scenarios = {{"S1", false, {a, b}}, {"S2", false, {}}};
    auto const t = cost_table(v);
    REQUIRE(t.rows.size() == 1);
    CHECK(t.rows[0] ==
          std::vector<std::string>{"S1", "u", "2", "0.300\xC2\xA0m/s", "3.00", "0.750"});
}

TEST_CASE("advice: what to do where no effect is the answer") {
    diagnosis_view v;
    v.gap = sivid::gap_verdict::none;
    CHECK_THAT(all_of(advice_lines(v)), StartsWith("Nothing has to be added"));
    v.gap = sivid::gap_verdict::certified;
    v.answer = sivid::answer_kind::open;
    CHECK_THAT(all_of(advice_lines(v)), ContainsSubstring("--budget"));
    v.answer = sivid::answer_kind::unexplained;
    v.where.resize(1);
    v.where[0].kind = "equation";
    v.where[0].name = "yaw";
    v.where[0].where = {"S4", 1, 2};
    CHECK_THAT(all_of(advice_lines(v)),
               ContainsSubstring("Look for an effect of your own in the yaw equation (S4, 1"));
    v.where.clear();
    CHECK_THAT(all_of(advice_lines(v)), ContainsSubstring("no place stands out"));
    sivid::confined_gap c{.channel = "v", .factor = sivid::interval(1.61, 1.66)};
    auto const advice = [&] {
        v.confined = {c};
        return all_of(advice_lines(v));
    };
    CHECK_THAT(advice(), ContainsSubstring("1.61 to 1.66 times as wide") &&
                             !ContainsSubstring("effect of your own"));
    using with = sivid::noise_growth::with;
    c.grows = sivid::noise_growth{with::rate};
    CHECK_THAT(advice(), ContainsSubstring("time stamps of v"));
    c.grows->what = with::value;
    CHECK_THAT(advice(), ContainsSubstring("Calibrate v"));
    c.steps = sivid::reading_steps{0.125};
    CHECK_THAT(advice(), ContainsSubstring("wider by half a step"));
    c.steps->cut_off = true;
    CHECK_THAT(advice(), ContainsSubstring("wider by a step"));
    c = {.scenarios = {"S3"}, .factor = sivid::interval(4, 5)};
    CHECK_THAT(advice(), ContainsSubstring("what was different in S3"));
    CHECK(advice_lines({}).empty());
    CHECK(page_of({}).find("What to do now") == std::string::npos);
}

TEST_CASE("advice: whether an experiment has to tell explanations apart") {
    auto v = hovercraft_diagnosis().view();
    CHECK_THAT(all_of(advice_lines(v)), ContainsSubstring("sets the explanations apart"));
    v.next.reset();
    CHECK_THAT(all_of(advice_lines(v)), ContainsSubstring("cannot tell it from"));
    v.indistinguishable.clear();
    CHECK_THAT(all_of(advice_lines(v)),
               ContainsSubstring("far less well on the whole (estimate): input_delay"));
    // What holds the answer is no other explanation.
    std::erase_if(v.causes, [](sivid::cause const& c) {
        return c.effects == std::vector<std::string>{"input_delay"};
    });
    CHECK_THAT(all_of(advice_lines(v)), ContainsSubstring("No other candidate was found") &&
                                            ContainsSubstring("no experiment has to tell"));
    v.tried.singles = {.tried = 8, .planned = 8};
    v.tried.pairs = {.tried = 0, .planned = 28};
    CHECK_THAT(all_of(advice_lines(v)), ContainsSubstring("no pair): a larger --budget") &&
                                            !ContainsSubstring("no experiment has to tell"));
}
