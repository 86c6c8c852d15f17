// SPDX-License-Identifier: MIT
#include "report/well_formed.hpp"
#include "support/catch.hpp"

#include <sivid/report/draw/candidate_chart.hpp>

#include <cmath>

using namespace sivid::report;
using namespace sivid_tests;

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
    std::string const text = draw_candidate_chart(bars, {.title = "t"}).str();
    CHECK(markup_error(text) == "");
    CHECK_THAT(text, ContainsSubstring("(logarithmic)"));
    detail::inflation_scale const scale(bars);
    CHECK(scale.share(1) > scale.share(0.6));
    CHECK(scale.share(140) > scale.share(30));
    CHECK(scale.share(1e250) == 1);
    CHECK(scale.share(-1) == 0);
    CHECK(scale.ticks().size() < 20);
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
    CHECK(inflation_text({1 + 1e-15, INFINITY}) == "at least 1.00000000000");
    CHECK(inflation_text({0, 0.5}) == "at most 0.500");
    CHECK(inflation_text({0, INFINITY}) == "at least 0");
}
