// SPDX-License-Identifier: MIT
#include "report/hovercraft_view.hpp"
#include "report/well_formed.hpp"
#include "support/catch.hpp"

#include <sivid/report/identification_page.hpp>

using namespace sivid::report;
using namespace sivid_tests;

TEST_CASE("identification parameters: table, chart, combinations and pavings with zooms") {
    std::string const text = identification_page(hovercraft_view(2'000, false)).str();
    CHECK(markup_error(body_of(text)) == "");
    CHECK_THAT(text,
               ContainsSubstring("<td class=\"number\" data-head=\"prior\">[0.2, 0.25]</td>"));
    CHECK_THAT(text, ContainsSubstring("Combinations that the data fix"));
    CHECK(occurrences(text, ": whole prior</text>") == 3);
    CHECK(occurrences(text, ": closer</text>") == 3);
}

TEST_CASE("identification parameters: a set proved empty is said to be, not drawn") {
    identification_view v = hovercraft_view(100, false);
    for (paving_projection& one : v.pavings) {
        one.boxes = {{{0, 1}, {0, 1}, region::outside}};
    }
    v.product_pavings.clear();
    auto const text = identification_page(v).str();
    CHECK_THAT(text, ContainsSubstring("It is empty"));
    CHECK(text.find("whole prior") == std::string::npos);
}
