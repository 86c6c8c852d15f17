// SPDX-License-Identifier: MIT
// What the script may not do; what it does is looked at in a browser (tests/browser).
#include "support/catch.hpp"

#include <sivid/report/detail/page_assets.hpp>

#include <algorithm>

using namespace sivid::report;

TEST_CASE("page script: balanced, asks nothing of a network, enters texts as texts") {
    for (auto const& [open, close] :
         {std::pair{'{', '}'}, std::pair{'(', ')'}, std::pair{'[', ']'}}) {
        // One of each stands in a regular expression, with its partner.
        CHECK(std::count(page_script.begin(), page_script.end(), open) ==
              std::count(page_script.begin(), page_script.end(), close));
    }
    for (auto const* word : {"http", "fetch", "XMLHttpRequest", "WebSocket", "sendBeacon", "import",
                             "eval", "innerHTML", "outerHTML", "insertAdjacent", "document.write",
                             "</script", "localStorage", "cookie"}) {
        CHECK(page_script.find(word) == std::string_view::npos);
    }
    CHECK(page_script.size() < 12'000);
}
