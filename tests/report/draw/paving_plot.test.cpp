// SPDX-License-Identifier: MIT
#include "report/hovercraft_view.hpp"
#include "report/well_formed.hpp"
#include "support/catch.hpp"

#include <sivid/report/draw/paving_plot.hpp>

#include <cmath>
#include <cstdint>

using namespace sivid::report;
using namespace sivid_tests;

TEST_CASE("paving plot: a sheet of 100 000 boxes is a small picture with a zoom") {
    sheet_paving const sheet{100'000};
    REQUIRE(sheet.leaves.size() > 40'000);
    paving_projection const p{{"L", "m", {0.25, 0.35}},
                              {"Sg", "m^2", {0.0042, 0.0754}},
                              sheet.on(2, 1),
                              point{0.3, 0.04}};
    auto const zoom = zoom_window(p);
    REQUIRE(zoom);
    CHECK(zoom->y.lo < 0.0341);
    CHECK(zoom->y.hi > 0.0483);
    CHECK(zoom->y.hi < 0.06);
    for (std::string const& text :
         {draw_paving_plot(p, "p").str(), draw_paving_plot(p, "p", zoom).str()}) {
        CHECK(markup_error(text) == "");
        CHECK(text.size() < 160'000);
        CHECK(text.find(palette::inside) != std::string::npos);
    }
}

TEST_CASE("paving plot: boxes without any order are met with coarser cells") {
    std::uint32_t seed = 9;
    paving_projection p{{"a", "", {0, 1}}, {"b", "", {0, 1}}, {}};
    for (int k = 0; k < 100'000; ++k) {
        seed = seed * 1664525u + 1013904223u;
        double const x = static_cast<double>(seed >> 16) / 65536.0,
                     y = static_cast<double>(seed & 0xFFFFu) / 65536.0;
        p.boxes.push_back({{x, x + 0.001}, {y, y + 0.001}, static_cast<region>(1 + seed % 3)});
    }
    std::string const text = draw_paving_plot(p, "p").str();
    CHECK(text.size() < 160'000);
    CHECK(markup_error(text) == "");
}

TEST_CASE("paving plot: the boxes behind several projections, for the page's script") {
    // Boxes in (a, b, c), as they project on (a, b) and (a, c).
    using enum region;
    paving_projection const ab{
        {"a", "m", {0, 4}},
        {"b", "s", {0, 2}},
        {{{0, 4}, {1, 2}, inside}, {{1, 2}, {0, 1}, pending}, {{3, 4}, {0, 2}, outside}}};
    paving_projection const ac{
        {"a", "m", {0, 4}},
        {"c", "", {0, 1}},
        {{{0, 4}, {0, 0.5}, inside}, {{1, 2}, {0.5, 1}, pending}, {{3, 4}, {0, 1}, outside}}};
    auto const all = paving_attributes({ab, ac});
    REQUIRE(all.size() == 6);
    CHECK(all[0].value == "a\nm\nb\ns\nc\n\n");
    CHECK(all[1].value == "0 4 0 2 0 1 ");
    // The largest first; what is outside is not listed.
    CHECK(all[2].value == "3 0 10000 5000 10000 0 5000;1 2500 5000 0 5000 5000 10000;");
    CHECK_THAT(all[3].value, ContainsSubstring("explain the data"));
    CHECK_THAT(all[4].value, ContainsSubstring("impossible"));
    CHECK(all[5].value == "0");
    CHECK(paving_attributes({ab, ac}, 1)[5].value == "1");
    CHECK(paving_attributes({}).empty());
    auto fewer = ac;
    fewer.boxes.pop_back();
    CHECK(paving_attributes({ab, fewer}).empty());
    auto endless = ab;
    endless.boxes[0].x = {0, INFINITY};
    CHECK(paving_attributes({endless}).empty());
}

TEST_CASE("paving plot: the zoom leaves out what it cannot help") {
    paving_projection p{
        {"a", "", {0, 1}}, {"b", "", {0, 1}}, {{{0, 1}, {0, 1}, region::undecided}}};
    CHECK_FALSE(zoom_window(p));
    p.boxes.push_back({{0.4, 0.5}, {0.4, 0.5}, region::inside});
    REQUIRE(zoom_window(p)); // the inside alone is small
    CHECK(zoom_window(p)->x.hi < 0.6);
    p.boxes = {{{0, 1}, {0, 1}, region::pending}};
    CHECK_FALSE(zoom_window(p));
}

TEST_CASE("paving plot: legend names the regions that occur") {
    paving_projection const p{
        {"a", "", {0, 1}}, {"b", "", {0, 1}}, {{{0, 0.1}, {0, 0.1}, region::inside}}};
    auto const entries = paving_plot_legend({p});
    REQUIRE(entries.size() == 3);
    CHECK(entries[0].mark == symbol::inside);
    CHECK(entries[1].mark == symbol::outside);
    CHECK(entries[2].mark == symbol::window);
}

TEST_CASE("paving plot: degenerate priors and boxes") {
    for (range const prior : {range{}, range{1, 1}, range{-INFINITY, INFINITY}, range{NAN, 1}}) {
        paving_projection const p{{"<a>", "", prior},
                                  {"b", "", prior},
                                  {{{-INFINITY, INFINITY}, {NAN, 1}, region::inside},
                                   {{0, 0}, {-INFINITY, INFINITY}, region::undecided}},
                                  point{NAN, 0}};
        CHECK(markup_error(draw_paving_plot(p, "p").str()) == "");
    }
}
