// SPDX-License-Identifier: MIT
#include "report/draw/compared_series.hpp"
#include "report/well_formed.hpp"
#include "support/catch.hpp"

#include <sivid/report/draw/charts.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace sivid::report;
using namespace sivid_tests;

TEST_CASE("bar chart: bounds and threshold") {
    std::string const text =
        draw_bar_chart(
            {{"rudder_lag", {0.97, 0.98}}, {"wind", {2.4, 2.6}}, {"none", {3.1, INFINITY}}},
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
    std::string const text = draw_bar_chart({{"<b>", {}},
                                             {"c", {-INFINITY, INFINITY}},
                                             {"d", {NAN, 1}},
                                             {"e", {0, 0}},
                                             {"f", {1e300, 1e308}}})
                                 .str();
    CHECK(markup_error(text) == "");
    CHECK_THAT(text, ContainsSubstring("no bound"));
}

TEST_CASE("candidate chart: what is proved and what is estimated is said in words") {
    std::vector<candidate_bar> const bars{
        {"lag", sivid::cause_verdict::explains, {0.875, 0.9375}, 0.9, true},
        {"wind", sivid::cause_verdict::excluded, {2.5, 2.625}, 2.55},
        {"delay", sivid::cause_verdict::undecided, {0, INFINITY}, 0.99},
        {"sag", sivid::cause_verdict::undecided, {1.02, INFINITY}, 1.9}};
    std::string const text = draw_candidate_chart(bars).str();
    CHECK(markup_error(text) == "");
    CHECK_THAT(text, ContainsSubstring(">explains (proved), 0.875 to 0.938<"));
    CHECK_THAT(text, ContainsSubstring(">excluded (proved), 2.50 to 2.63<"));
    CHECK_THAT(text, ContainsSubstring(">open, \xE2\x89\x88\xE2\x80\xAF"
                                       "0.990 (estimate)<"));
    CHECK_THAT(text, ContainsSubstring(">open, at least 1.0"));
    CHECK(occurrences(text, ", best fit</title>") == 4);
    CHECK(text.find("(logarithmic)") == std::string::npos);
    CHECK(candidate_legend(bars).size() == 3);
    CHECK(candidate_legend({{.label = "x", .fitted = 2}}).size() == 1);
}

TEST_CASE("candidate chart: large inflations are drawn on a logarithmic axis") {
    std::vector<candidate_bar> const bars{{"a", sivid::cause_verdict::explains, {0.5, 0.6}, 0.55},
                                          {"b", sivid::cause_verdict::undecided, {}, 140},
                                          {"c", sivid::cause_verdict::excluded, {30, 1e12}, 1e250}};
    std::string const text = draw_candidate_chart(bars).str();
    CHECK(markup_error(text) == "");
    CHECK_THAT(text, ContainsSubstring("(logarithmic)"));
    std::vector<double> fits; // where they are drawn
    for (auto at = text.find("<circle cx=\""); at != text.npos;
         at = text.find("<circle cx=\"", at + 1))
        fits.push_back(std::stod(text.substr(at + 12)));
    REQUIRE(fits.size() == 3);
    CHECK(fits[0] < fits[1]);
    CHECK(fits[1] < fits[2]);
    CHECK(fits[2] < 1000);
}

TEST_CASE("candidate chart: empty, undefined and hostile") {
    CHECK(markup_error(draw_candidate_chart({}).str()) == "");
    std::vector<candidate_bar> const bars{
        {"<b>\"&", sivid::cause_verdict::undecided, {NAN, NAN}, NAN},
        {"", sivid::cause_verdict::excluded, {-INFINITY, INFINITY}, INFINITY},
        {std::string(300, 'w'), sivid::cause_verdict::explains, {0, 0}, -1}};
    CHECK(markup_error(draw_candidate_chart(bars).str()) == "");
}

TEST_CASE("candidate chart: a factor above one is never printed as one") {
    CHECK(inflation_text({1.25, 1.5}) == "1.25 to 1.50");
    CHECK(inflation_text({1 + 0x1p-12, 1.5}) == "1.0002 to 1.5000");
    CHECK(inflation_text({1, 1.5}) == "1.00 to 1.50");
    CHECK(inflation_text({1 + 1e-15, INFINITY}) == "more than 1");
    CHECK(inflation_text({1 + 1e-15, 8.692}) == "more than 1, at most 8.70");
    CHECK(inflation_text({0, 0.5}) == "at most 0.500");
    CHECK(inflation_text({0, INFINITY}) == "at least 0");
}

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

TEST_CASE("misfit map: every sample is in its cell, slow channels leave no gaps") {
    channel_series slow{.name = "x"};
    for (int k = 0; k < 4; ++k) slow.misfit_before.push_back({3.0 * k, 0.25});
    heat_map const m = misfit_map({compared_series(), slow}, false);
    REQUIRE(m.rows.size() == 2);
    REQUIRE(m.times.size() == 11);
    CHECK(largest_value(m) == 9);
    CHECK(*std::max_element(m.values[0].begin(), m.values[0].end()) == 9);
    for (double const v : m.values[1]) CHECK(v == 0.25);
    CHECK(misfit_map({compared_series()}, true).times.empty());
    CHECK(misfit_map({}, false).times.empty());
}

TEST_CASE("misfit map: many samples are joined by their largest, undefined ones are skipped") {
    channel_series c{.name = "u"};
    for (int k = 0; k < 5000; ++k) c.misfit_after.push_back({0.01 * k, k == 4321 ? 7.0 : 0.1});
    c.misfit_after[17].y = NAN;
    c.misfit_after[18].x = INFINITY;
    c.misfit_after[19].y = INFINITY;
    heat_map const m = misfit_map({c}, true, 50);
    CHECK(m.times.size() == 51);
    CHECK(largest_value(m) == 7);
    CHECK(markup_error(draw_heat_map(m).str()) == "");
    channel_series once{.name = "u", .misfit_after = {{2, 0.5}}};
    CHECK(misfit_map({once}, true).values[0].size() == 1);
}

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
