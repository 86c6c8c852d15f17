// SPDX-License-Identifier: MIT
#include "report/diagnosis_example.hpp"
#include "support/catch.hpp"

#include <sivid/report/page/detail/holdout_tables.hpp>

#include <limits>

using namespace sivid::report;
using namespace sivid_tests;

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
