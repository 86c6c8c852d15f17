// SPDX-License-Identifier: MIT
#include "report/well_formed.hpp"
#include "support/catch.hpp"

#include <sivid/report/draw/detail/interval_chart.hpp>

#include <cmath>

using namespace sivid::report;
using namespace sivid_tests;

TEST_CASE("interval chart: prior, hull and witness of each row") {
    std::string const text =
        draw_interval_chart({{"Sv", "m^2", {0.2, 0.25}, {0.21820, 0.22181}, 0.22},
                             {"L", "m", {0.25, 0.35}, {0.25, 0.35}}})
            .str();
    CHECK(markup_error(text) == "");
    CHECK_THAT(text, ContainsSubstring("hull [0.21"));
    CHECK_THAT(text, ContainsSubstring("prior [0.2, 0.25]"));
    CHECK_THAT(text, ContainsSubstring("hull [0.25, 0.35]"));
    CHECK(occurrences(text, "<title>witness 0.22") == 1);
}

TEST_CASE("interval chart: empty, infinite and hostile rows") {
    std::string const text =
        draw_interval_chart({{"<i>", "\"", {0, 1}, {}},
                             {"b", "", {}, {}},
                             {"c", "", {-INFINITY, INFINITY}, {-INFINITY, 0}, NAN},
                             {"d", "", {1, 1}, {1, 1}, 1.0}})
            .str();
    CHECK(markup_error(text) == "");
    CHECK_THAT(text, ContainsSubstring("nothing in the prior is left"));
    CHECK(markup_error(draw_interval_chart({}).str()) == "");
}
