// SPDX-License-Identifier: MIT
#include "report/well_formed.hpp"
#include "support/catch.hpp"

#include <sivid/report/draw/heat_map.hpp>

#include <cmath>

using namespace sivid::report;
using namespace sivid_tests;

TEST_CASE("heat map: values above the threshold are orange and crossed") {
    heat_map const m{.rows = {"u", "v"},
                     .times = {0, 1, 2, 3},
                     .values = {{0.2, 0.5, 3}, {NAN, 0.1, 0.9}},
                     .quantity = "misfit"};
    std::string const text = draw_heat_map(m).str();
    CHECK(markup_error(text) == "");
    CHECK(occurrences(text, "<title>u: ") == 3);
    CHECK(occurrences(text, "<title>v: ") == 2); // the unknown cell stays hatched
    CHECK_THAT(text, ContainsSubstring(orange_ramp.at(1)));
}

TEST_CASE("heat map: empty, ragged, infinite and hostile") {
    CHECK(markup_error(draw_heat_map({}).str()) == "");
    heat_map const m{.rows = {"<a>", "b", "c"},
                     .times = {0, NAN, INFINITY},
                     .values = {{INFINITY, -1, 5, 6}, {1e308}},
                     .quantity = "&",
                     .threshold = 0};
    CHECK(markup_error(draw_heat_map(m, {.title = "<t>"}).str()) == "");
}

TEST_CASE("heat map: maps can share their colours, and one wild value does not fade the others") {
    heat_map const m{
        .rows = {"u"}, .times = {0, 1, 2, 3}, .values = {{4, 8, 0.5}}, .quantity = "misfit"};
    std::string const alone = draw_heat_map(m).str();
    std::string const shared = draw_heat_map(m, {.largest = 64}).str();
    CHECK(alone != shared);
    CHECK_THAT(shared, ContainsSubstring(orange_ramp.at(0.5))); // 8 is half way to 64
    heat_map wild = m;
    wild.values[0][0] = 1e200;
    std::string const text = draw_heat_map(wild).str();
    CHECK(markup_error(text) == "");
    CHECK_THAT(text,
               ContainsSubstring("\xE2\x89\xA5 1000<") || ContainsSubstring("\xE2\x89\xA5 1.0"));
    CHECK_THAT(text, ContainsSubstring(orange_ramp.at(std::log(8.0) / std::log(1000.0))));
    heat_map_options const bare{.key = false};
    CHECK(draw_heat_map(m, bare).height() < draw_heat_map(m).height());
    CHECK(draw_heat_map(m, bare).str().find("misfit</text>") == std::string::npos);
}
