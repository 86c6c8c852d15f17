// SPDX-License-Identifier: MIT
#include "report/well_formed.hpp"
#include "support/catch.hpp"

#include <sivid/report/draw/bar_chart.hpp>

#include <cmath>

using namespace sivid::report;
using namespace sivid_tests;

TEST_CASE("bar chart: bounds, threshold and notes") {
    std::string const text = draw_bar_chart({{"rudder_lag", {0.97, 0.98}, "explains"},
                                             {"wind", {2.4, 2.6}, "excluded"},
                                             {"none", {3.1, INFINITY}}},
                                            {.title = "Inflation left",
                                             .quantity = "inflation",
                                             .threshold = 1.0,
                                             .threshold_label = "data explained"})
                                 .str();
    CHECK(markup_error(text) == "");
    CHECK_THAT(text, ContainsSubstring("rudder_lag"));
    CHECK_THAT(text, ContainsSubstring("[2.399, 2.601]"));
    CHECK_THAT(text, ContainsSubstring("data explained"));
}

TEST_CASE("bar chart: a bar's length is its lower bound") {
    std::string const text = draw_bar_chart({{"a", {1, 1}}, {"b", {2, 2}}}).str();
    auto const width = [&](int which) {
        std::size_t at = 0;
        for (int i = 0; i <= which; ++i) {
            at = text.find("height=\"16\" fill=\"#0072b2\"", at + 1);
        }
        auto const from = text.rfind("width=\"", at) + 7;
        return std::stod(text.substr(from));
    };
    CHECK_THAT(width(1), WithinAbs(2 * width(0), 0.5));
}

TEST_CASE("bar chart: empty, infinite and hostile") {
    CHECK(markup_error(draw_bar_chart({}).str()) == "");
    std::string const text = draw_bar_chart({{"<b>", {}, "&"},
                                             {"c", {-INFINITY, INFINITY}},
                                             {"d", {NAN, 1}},
                                             {"e", {0, 0}},
                                             {"f", {1e300, 1e308}}})
                                 .str();
    CHECK(markup_error(text) == "");
    CHECK_THAT(text, ContainsSubstring("no bound, &amp;"));
}
