// SPDX-License-Identifier: MIT
#include "report/well_formed.hpp"
#include "support/catch.hpp"

#include <sivid/report/draw/charts.hpp>
#include <sivid/report/page.hpp>

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

using namespace sivid::report;
using namespace sivid_tests;

TEST_CASE("page: every element, well-formed, in order, with ids that do not clash") {
    heat_map map{.rows = {"u", "v", "r", "x", "y", "psi"}, .quantity = "largest misfit / bound"};
    for (int k = 0; k <= 40; ++k) {
        map.times.push_back(0.25 * k);
    }
    for (int c = 0; c < 6; ++c) {
        map.values.emplace_back();
        for (int k = 0; k < 40; ++k) {
            map.values.back().push_back(
                k == 17 + c ? std::numeric_limits<double>::quiet_NaN()
                            : std::exp(2.2 * std::sin(0.2 * k + 2 * c) - (c == 2 ? -0.8 : 1.4)));
        }
    }
    svg const bars = draw_bar_chart({{"rudder_lag", {0.97, 0.98}},
                                     {"wind", {2.4, 2.6}},
                                     {"input_delay", {0.8, 3.3}},
                                     {"(nothing added)", {3.1, 3.2}}},
                                    {.quantity = "inflation that is left",
                                     .threshold = 1.0,
                                     .threshold_label = "below 1: data explained"});
    page p{{.kind = "Demo", .title = "All <elements>", .lead = "of a page"}};
    p.banner(outcome::undecided, "Not decided", "yet")
        .banner(outcome::refuted, "Refuted", "now")
        .banner(outcome::proved, "Proved", "then");
    p.cards({{"a", "1"}, {"b", "2", "note"}, {"c", "rudder_lag & more"}})
        .section("S & T")
        .subsection("sub")
        .prose("text")
        .prose("");
    p.add(figure{.panels = {bars, bars},
                 .legend = {{symbol::undecided, "u"}, {symbol::pending, "p"}},
                 .title = "Bars.",
                 .caption = "twice",
                 .layout = panel_layout::wide});
    p.add(figure{.panels = {draw_heat_map(map)},
                 .title = "Heat.",
                 .caption = "",
                 .layout = panel_layout::wide});
    p.add(figure{});
    p.add(table{.columns = {{"a"}}, .rows = {{"1"}}}).add(table{});
    p.bullets({"one"})
        .plain_words({"two"})
        .plain_words({})
        .assumptions({"three"})
        .warnings({"four"})
        .warnings({});
    p.footer({"version", "", "date"});
    std::ostringstream out;
    out << p;
    std::ofstream{"page_gallery.html"} << out.str();
    std::string const text = out.str();
    CHECK(markup_error(body_of(text)) == "");
    CHECK(occurrences(text, "<title>All &lt;elements&gt;</title>") == 1);
    CHECK(occurrences(text, "Figure 1.") == 1);
    CHECK(occurrences(text, "Figure 2.") == 1);
    CHECK(occurrences(text, "<figure>") == 2);
    CHECK(occurrences(text, "class=\"box warning\"") == 1);
    CHECK(occurrences(text, "rudder_<wbr/>lag &amp; more") == 1);
    CHECK(text.find("Figure 3.") == std::string::npos);
    CHECK(text.find("one</li>") < text.find("two</li>"));
    CHECK(text.find("<footer>") > text.find("four</li>"));
}

TEST_CASE("a heading without content is left out, one of a section with content below stands") {
    page p{{.kind = "k", .title = "t"}};
    p.section("Empty").subsection("Below it").bullets({}).add(table{});
    p.section("Full").subsection("Nothing here").subsection("Something").prose("text");
    p.section("Last");
    std::string const text = p.str();
    for (auto const* none : {"Empty", "Below it", "Nothing here", "Last"})
        CHECK(text.find(none) == std::string::npos);
    CHECK_THAT(text, ContainsSubstring("<h2>Full</h2>\n<h3>Something</h3>\n<p>text</p>"));
}
