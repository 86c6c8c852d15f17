// SPDX-License-Identifier: MIT
#include <sivid/report/detail/tried_words.hpp>

#include "support/catch.hpp"

using namespace sivid;

TEST_CASE("a journal has a line for each that was asked, or not, with its reason") {
    using outcome = contraction_record::outcome;
    auto const tried = report::tried_words(
        {{"windows", "delays", outcome::not_applicable},
         {"equations", "early", outcome::gained, 0.413, 3, 1, {{"longest", 2}, {"none", 0}}}});
    REQUIRE(tried.size() == 2);
    CHECK(tried[0].by == "windows");
    CHECK(tried[0].outcome == "not applicable");
    CHECK(tried[0].why == "delays");
    CHECK(tried[0].effort.empty());
    CHECK_THAT(tried[1].outcome, ContainsSubstring("gained: at most 41.3"));
    CHECK_THAT(tried[1].effort, ContainsSubstring("3 integrations, longest 2"));
    CHECK(tried[1].effort.find("none") == std::string::npos);
    auto const table = report::tried_table(tried);
    CHECK(table.rows.size() == 2);
    CHECK(table.rows[0].size() == table.columns.size());
}
