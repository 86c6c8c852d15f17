// SPDX-License-Identifier: MIT
#include "support/catch.hpp"

#include <sivid/report/detail/page_assets.hpp>

#include <algorithm>

using namespace sivid::report;

TEST_CASE("page style: balanced, nothing loaded from elsewhere, fit for phone and print") {
    CHECK(std::count(page_style.begin(), page_style.end(), '{') ==
          std::count(page_style.begin(), page_style.end(), '}'));
    for (auto const* word : {"url(", "@import", "http", "</style", "expression("}) {
        CHECK(page_style.find(word) == std::string_view::npos);
    }
    for (auto const* word : {"@media print", "@media(max-width", ".proved", ".undecided",
                             ".refuted", "tabular-nums"}) {
        CHECK(page_style.find(word) != std::string_view::npos);
    }
}
