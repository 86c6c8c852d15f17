// SPDX-License-Identifier: MIT
#include "report/well_formed.hpp"
#include "support/catch.hpp"

#include <sivid/report/draw/axes.hpp>

#include <set>
#include <string>

using namespace sivid::report;

TEST_CASE("legend: every symbol has a picture of its own") {
    std::set<std::string> pictures;
    for (int i = 0; i <= static_cast<int>(symbol::estimate); ++i) {
        std::string const text = symbol_picture(static_cast<symbol>(i), "s").str();
        CHECK(sivid_tests::markup_error(text) == "");
        pictures.insert(text);
    }
    CHECK(pictures.size() == static_cast<std::size_t>(symbol::estimate) + 1);
}

TEST_CASE("legend: entries wrap to the width") {
    svg out{400, 100, "legend"};
    std::vector<legend_entry> const entries(6, {symbol::tube, "a label of some length"});
    CHECK(draw_legend(out, entries, 0, 0, 2000) == 20);
    CHECK(draw_legend(out, entries, 0, 0, 400) > 40);
    CHECK(draw_legend(out, {}, 0, 0, 400) == 0);
    CHECK(sivid_tests::markup_error(out.str()) == "");
}
