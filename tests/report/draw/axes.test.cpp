// SPDX-License-Identifier: MIT
#include "report/well_formed.hpp"
#include "support/catch.hpp"

#include <sivid/report/draw/axes.hpp>

#include <cmath>

using namespace sivid::report;

TEST_CASE("axes: the ends of the ranges meet the frame") {
    axes const a{
        {"t", "s", {0, 3}}, {"u", "m/s", {-1, 2}}, {.width = 300, .height = 200, .title = "u"}};
    CHECK_THAT(a.px(0), WithinAbs(a.left(), 1e-9));
    CHECK_THAT(a.px(3), WithinAbs(a.right(), 1e-9));
    CHECK_THAT(a.py(-1), WithinAbs(a.bottom(), 1e-9));
    CHECK_THAT(a.py(2), WithinAbs(a.top(), 1e-9));
    CHECK(a.py(INFINITY) < a.top());
    CHECK(std::isfinite(a.py(INFINITY)));
    CHECK(std::isfinite(a.px(NAN)));
}

TEST_CASE("axes: the drawing says where its values are") {
    axes const a{{"t", "s", {0, 3}}, {"u", "m/s^2", {-1, 2}}, {.width = 300, .height = 200}};
    svg s{300, 200, "u"};
    a.close(s);
    std::string const left = coordinate(a.left()), right = coordinate(a.right());
    CHECK_THAT(s.str(),
               ContainsSubstring(" data-x=\"" + left + " " + right + " 0 3\" data-x-name=\"t\""));
    CHECK_THAT(s.str(), ContainsSubstring(" -1 2\" data-y-name=\"u\" data-y-unit=\"m/s"));
}

TEST_CASE("axes: equal aspect makes one unit equally long and keeps the data in view") {
    axes const a{{"x", "m", {0, 8}},
                 {"y", "m", {0, 1.6}},
                 {.width = 740, .height = 300, .equal_aspect = true}};
    CHECK_THAT(a.px(1) - a.px(0), WithinAbs(a.py(0) - a.py(1), 1e-9));
    CHECK(a.px(0) >= a.left() - 1e-9);
    CHECK(a.px(8) <= a.right() + 1e-9);
    CHECK(a.py(0) <= a.bottom() + 1e-9);
    CHECK(a.py(1.6) >= a.top() - 1e-9);
}

TEST_CASE("axes: never a single tick on the upright axis where there is room for more") {
    axes const a{{"t", "s", {0, 1}}, {"v", "m/s", {-0.42, 0.42}}, {.height = 230}};
    svg out{360, 230, "test"};
    a.close(out);
    CHECK_THAT(out.str(), ContainsSubstring(">0.2</text>"));
}

TEST_CASE("axes: degenerate ranges and hostile labels still give a drawing") {
    for (range const r : {range{}, range{NAN, NAN}, range{-INFINITY, INFINITY}, range{4, 4},
                          range{-1e308, 1e308}, range{0.22, 0.22000001}}) {
        for (bool const equal : {false, true}) {
            axes const a{
                {"<x>", "\"", r}, {"y&", "m^2", r}, {.title = "<t>", .equal_aspect = equal}};
            svg out{360, 240, "test"};
            a.open(out);
            a.close(out);
            CHECK(sivid_tests::markup_error(out.str()) == "");
            CHECK(a.left() < a.right());
        }
    }
}
