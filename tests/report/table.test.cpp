// SPDX-License-Identifier: MIT
#include "report/well_formed.hpp"
#include "support/catch.hpp"

#include <sivid/report/page.hpp>

using namespace sivid::report;
using namespace sivid_tests;

TEST_CASE("table: numbers to the right, texts escaped, empty columns left out") {
    table const t{
        .columns = {{"name", column_kind::symbol}, {"value <x>", column_kind::number}, {"nothing"}},
        .rows = {{"<a>", "1.5"}, {"b", "2", "", "too long"}},
        .caption = "c & d",
        .chosen_row = 1};
    std::string const text = table_html(t);
    CHECK(markup_error("<p>" + text + "</p>") == "");
    CHECK_THAT(text,
               ContainsSubstring("<td class=\"number\" data-head=\"value &lt;x&gt;\">1.5</td>"));
    CHECK_THAT(text, ContainsSubstring("&lt;a&gt;"));
    CHECK(text.find("nothing") == std::string::npos);
    CHECK(text.find("too long") == std::string::npos);
    CHECK_THAT(text,
               ContainsSubstring("<tr class=\"chosen\"><td class=\"symbol\" data-head=\"name\">b"));
}
