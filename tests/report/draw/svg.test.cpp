// SPDX-License-Identifier: MIT
#include "report/well_formed.hpp"
#include "support/catch.hpp"

#include <sivid/report/draw/svg.hpp>

#include <cmath>

using namespace sivid::report;
using sivid_tests::markup_error;

TEST_CASE("svg: coordinates are short and finite") {
    CHECK(coordinate(1.005) == "1");
    CHECK(coordinate(-0.001) == "0");
    CHECK(coordinate(2.5) == "2.5");
    CHECK(coordinate(NAN) == "0");
    CHECK(coordinate(INFINITY) == "1000000");
    CHECK(coordinate(-INFINITY) == "-1000000");
}

TEST_CASE("svg: shapes, groups and windows give balanced, finite markup") {
    svg s{100, 50, "a \"label\" <b>"};
    s.group("tip <1>").rect(1, NAN, -3, INFINITY, {.fill = "red"}, 2, "tip & tip");
    s.clip(0, 0, 10, 10).circle(1, 2, 3, {.stroke = "#000", .width = 2, .dash = "1 2"});
    s.line(0, 0, NAN, 1, {.stroke = "\"evil<"});
    s.path(path_data{}.move(0, 0).line(1, 1).close(), {});
    s.text(1, 2, "<script>", {.align = anchor::end, .bold = true, .rotate = -90});
    s.rect(0, 0, 5, 5, {.fill = s.hatch("#ffffff", "#000000")});
    s.rect(0, 0, 5, 5, {.fill = s.dots("#ffffff", "#000000")});
    // Two elements are left open: they are closed in the text.
    std::string const text = s.str();
    CHECK(markup_error(text) == "");
    CHECK(text.find("<script>") == std::string::npos);
    CHECK_THAT(text, ContainsSubstring("transform=\"rotate(-90 1 2)\""));
    s.close().close().close();
    CHECK(markup_error(s.str()) == "");
}

TEST_CASE("svg: data for the page's script") {
    svg s{10, 10, "x"};
    s.data("x", "1 2").data("x-name", "\"><script>");
    CHECK(markup_error(s.str()) == "");
    CHECK_THAT(s.str(),
               ContainsSubstring(" data-x=\"1 2\" data-x-name=\"&quot;&gt;&lt;script&gt;\""));
}

TEST_CASE("svg: ids take the prefix of the page, and no text can forge one") {
    svg s{10, 10, "x"};
    s.rect(0, 0, 5, 5, {.fill = s.hatch("#ffffff", "#000000")});
    s.text(0, 0, "\x01hffffff");
    CHECK(markup_error("<p>" + s.str("a-") + s.str("b-") + "</p>") == "");
    CHECK(sivid_tests::occurrences(s.str("zz-"), "zz-") == 2);
}

TEST_CASE("svg: patterns are shared when equal and kept apart when not") {
    svg s{10, 10, "x"};
    CHECK(s.hatch("#ffffff", "#000000") == s.hatch("#ffffff", "#000000"));
    CHECK(s.hatch("#ffffff", "#000000") != s.hatch("#ffffff", "#ff0000"));
    CHECK(s.hatch("#ffffff", "#000000") != s.dots("#ffffff", "#000000"));
}

TEST_CASE("svg: an empty path draws nothing") {
    svg a{10, 10, "x"};
    svg b{10, 10, "x"};
    b.path({}, {.stroke = "red"});
    CHECK(a.str() == b.str());
}
