// SPDX-License-Identifier: MIT
#include <sivid/report/identification_page.hpp>

#include "support/catch.hpp"

using namespace sivid;

TEST_CASE("a journal has a line for each that was asked, or not, with its reason") {
    using outcome = contraction_record::outcome;
    auto const tried = report::tried_table(
        {{"windows", "delays", outcome::not_applicable},
         {"equations", "early", outcome::gained, 0.413, 3, 1, {{"longest", 2}, {"none", 0}}}});
    REQUIRE(tried.rows.size() == 2);
    CHECK(tried.rows[0] ==
          std::vector<std::string>{"windows", "not applicable", "delays", std::string{}});
    REQUIRE(tried.rows[1].size() == tried.columns.size());
    CHECK_THAT(tried.rows[1][1], ContainsSubstring("gained: at most 41.3"));
    CHECK_THAT(tried.rows[1][3], ContainsSubstring("3 integrations, longest 2"));
    CHECK(tried.rows[1][3].find("none") == std::string::npos);
}
