// SPDX-License-Identifier: MIT
#include "report/hovercraft_view.hpp"
#include "report/well_formed.hpp"
#include "support/catch.hpp"

#include <sivid/report/page/detail/identification_parameters.hpp>

using namespace sivid::report;
using namespace sivid_tests;

TEST_CASE("identification parameters: table, chart, combinations and pavings with zooms") {
    page p{{.kind = "k", .title = "t"}};
    identification_view const v = hovercraft_view(2'000, false);
    detail::add_parameters(p, v);
    detail::add_pavings(p, v);
    std::string const text = p.str();
    CHECK(markup_error(body_of(text)) == "");
    CHECK_THAT(text,
               ContainsSubstring("<td class=\"number\" data-head=\"prior\">[0.2, 0.25]</td>"));
    CHECK_THAT(text, ContainsSubstring("Combinations that the data fix"));
    CHECK(occurrences(text, ": whole prior</text>") == 3);
    CHECK(occurrences(text, ": closer</text>") == 3);
}

TEST_CASE("identification parameters: a set proved empty is said to be, not drawn") {
    page p{{.kind = "k", .title = "t"}};
    identification_view v = hovercraft_view(100, false);
    for (paving_projection& one : v.pavings) {
        one.boxes = {{{0, 1}, {0, 1}, region::outside}};
    }
    detail::add_pavings(p, v);
    CHECK_THAT(p.str(), ContainsSubstring("It is empty"));
    CHECK(p.str().find("<figure") == std::string::npos);
}
