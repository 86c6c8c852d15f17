// SPDX-License-Identifier: MIT
#include "report/diagnosis_example.hpp"
#include "support/catch.hpp"

#include <sivid/report/detail/diagnosis_tables.hpp>
#include <sivid/report/diagnosis_page.hpp>
#include <sivid/report/diagnosis_words.hpp>

#include <limits>
#include <string>

using namespace sivid::report;
using namespace sivid_tests;

TEST_CASE("diagnosis tables: cards say how each figure is known") {
    diagnosis_view v = hovercraft_diagnosis().view();
    auto const cards = diagnosis_cards(v);
    REQUIRE(cards.size() == 5);
    CHECK_THAT(cards[0].note, ContainsSubstring("proved"));
    CHECK(cards[2].value == "rudder_lag");
    CHECK_THAT(cards[2].name, ContainsSubstring("proved"));
    v.inflation = sivid::unknown_inflation();
    v.causes[0].verdict = sivid::cause_verdict::undecided;
    v.where[0].proved = false;
    auto const guesses = diagnosis_cards(v);
    CHECK_THAT(guesses[0].note, ContainsSubstring("estimate"));
    CHECK_THAT(guesses[1].note, ContainsSubstring("estimate"));
    CHECK_THAT(guesses[2].name, ContainsSubstring("likeliest"));
    CHECK(diagnosis_cards({}).empty());
}

TEST_CASE("diagnosis tables: the summary point by point") {
    diagnosis_view v = hovercraft_diagnosis().view();
    auto const t = summary_table(v);
    REQUIRE(t.rows.size() == 6);
    CHECK(t.rows[2][0] == "Effect");
    CHECK_THAT(t.rows[2][1], ContainsSubstring("2 of the 12 candidates tried are excluded"));
    CHECK_THAT(t.rows[5][1], EndsWith("(prediction, not proved)."));
    CHECK(summary_table({}).rows.size() == 1);
    v.confined = {{.channel = "v", .factor = sivid::interval(1.5, 2)}};
    CHECK(summary_table(v).rows.size() == 6); // the effect explains them
    v.tried.singles = {12, 12};
    CHECK(summary_table(v).rows[2][1] == t.rows[2][1]);
    v.tried.singles = {10, 10}; // two more were tried when these did not explain
    CHECK_THAT(summary_table(v).rows[2][1],
               ContainsSubstring("2 of the 12 candidates tried, those beyond the plan among them"));
}

TEST_CASE("diagnosis tables: parameters with hull and prior") {
    auto const t = causes_table(hovercraft_diagnosis().view());
    REQUIRE(t.rows.size() == 7);
    CHECK(t.chosen_row == 0u);
    CHECK(t.rows[0][3] == "0.169 \xE2\x9C\x93"); // of the witness
    CHECK(t.rows[0][4] == "0.160 to 0.180");
    CHECK(t.rows[0][5] == "[0, 1]");
    CHECK(t.rows[1][4] == "");
    CHECK(t.rows[3][0] == ""); // the second parameter of a pair
    CHECK(t.rows[3][6] == "N\xC2\xA0m\xC2\xA0s\xC2\xB2");
}

TEST_CASE("diagnosis tables: products that are told better than their factors") {
    diagnosis_view v = hovercraft_diagnosis().view();
    using sivid::interval;
    v.combinations = {
        {{"tau/Iz", "s/(kg m^2)", 2.5, interval(2.5, 2.75), interval(0, 20)}, {}, false, true},
        {{"D33/Iz", "1/s", 1.5, interval(1.4, 1.6), interval(1, 2)}, {}, false, false}};
    auto const t = constants_table(v);
    REQUIRE(t.rows.size() >= 2);
    auto const& row = t.rows[t.rows.size() - 2];
    CHECK(row[0] == "tau/Iz");
    CHECK(row[2] == "2.50 to 2.75");
    CHECK_THAT(row[5], ContainsSubstring("better than its parts"));
    CHECK_THAT(diagnosis_cards(v)[2].note, ContainsSubstring("tau/Iz = 2.50"));
    CHECK(diagnosis_cards(v)[2].note.find("D33") == std::string::npos);
    CHECK_THAT(answer_clause(v), ContainsSubstring("tau/Iz = 2.50"));
}

TEST_CASE("diagnosis tables: places and shares of the gap") {
    diagnosis_view v = hovercraft_diagnosis().view();
    auto const t = places_table(v);
    REQUIRE(t.rows.size() == 3);
    CHECK(t.rows[0][0] == "yaw equation");
    CHECK_THAT(t.rows[0][3], EndsWith("(proved)"));
    CHECK_THAT(t.rows[1][3], EndsWith("(estimate)"));
    CHECK_THAT(t.rows[1][4], EndsWith(", where |delta| > 0.1 rad"));
    CHECK(t.rows[2][3] == "");
    v.where.resize(40);
    CHECK(places_table(v).rows.size() == 20);
    CHECK_THAT(places_table(v).caption, ContainsSubstring("first 20 of 40"));
    CHECK(gap_shares_table(v).rows.size() == 5);
    CHECK(gap_shares_table(v).rows[2][1] == "");
}

TEST_CASE("hold-out tables: figures, known and not") {
    diagnosis_view const v = hovercraft_diagnosis().view();
    auto const t = holdout_table(v, *v.causes[0].holdout);
    REQUIRE(t.rows.size() == 11);
    CHECK(t.rows[1][0] == "the same, for every parameter that fits");
    CHECK(t.rows[2][2] == "98.2 to 100\xC2\xA0%");
    CHECK(t.rows[9][2] == "97.8\xC2\xA0%");
    CHECK_THAT(t.rows[5][2], EndsWith("rad/s"));
    CHECK(holdout_table({}, {}).rows.empty()); // no tube was computed
    sivid::holdout_figures nearly;
    nearly.width_before = nearly.width_after = 1;
    nearly.covered_before = 1;
    nearly.covered_after = 2499.0 / 2500;
    CHECK(holdout_table({}, nearly).rows[0][1] == "100\xC2\xA0%");
    CHECK(holdout_table({}, nearly).rows[0][2] == "99.9\xC2\xA0%");
    sivid::holdout_figures open;
    open.inflation_before = sivid::interval(3, std::numeric_limits<double>::infinity());
    CHECK(holdout_table({}, open).rows[0][1] == "at least 3.00");
    CHECK(holdout_table({}, open).rows[0][2] == "not bounded");
}

TEST_CASE("hold-out tables: several candidates on hold-out data") {
    diagnosis_view v = hovercraft_diagnosis().view();
    CHECK(holdout_candidates_table(v).rows.empty()); // one alone is no comparison
    v.causes[1].holdout.emplace().inflation_after = sivid::interval(0, 1.5);
    auto const t = holdout_candidates_table(v);
    REQUIRE(t.rows.size() == 2);
    CHECK(t.chosen_row == 0u);
    CHECK(t.rows[0][2] == "97.8\xC2\xA0%");
    CHECK(t.rows[1][1] == "at most 1.50");
    CHECK(t.rows[1][3] == "");
}
