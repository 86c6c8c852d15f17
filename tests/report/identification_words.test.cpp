// SPDX-License-Identifier: MIT
#include "report/hovercraft_view.hpp"
#include "support/catch.hpp"

#include <sivid/report/identification_words.hpp>

#include <cmath>

using namespace sivid::report;

namespace {

std::string all(identification_view const& v) {
    std::string out;
    for (std::string const& line : plain_statements(v)) {
        out += line + "\n";
    }
    return out;
}

} // namespace

TEST_CASE("identification words: shares are rounded to the safe side") {
    CHECK(at_most_percent(2.9601e-4) == "0.0297 %");
    CHECK(at_least_percent(2.9699e-4) == "0.0296 %");
    CHECK(share_of_prior({"a", "", {0, 1}, {0, 0.25}}) >= 0.25);
    CHECK(share_of_prior({"a", "", {0, 1}, {0, 1}}) == 1);
    CHECK(std::isnan(share_of_prior({"a", "", {1, 1}, {1, 1}})));
    CHECK(std::isnan(share_of_prior({"a", "", {0, 1}, {}})));
    CHECK(formula_text("L*Sg").find('*') == std::string::npos);
}

TEST_CASE("identification words: a consistent campaign") {
    std::string const text = all(sivid_tests::hovercraft_view(100, false));
    CHECK_THAT(text, ContainsSubstring(
                         "meets all 180 measurements. The one that was checked is Sv = 0.22003"));
    CHECK_THAT(text, ContainsSubstring("For L taken alone, nothing (or nearly nothing)"));
    CHECK_THAT(text, ContainsSubstring("no data can tell them apart"));
    CHECK_THAT(text, ContainsSubstring("At most 0.0573 %"));
    CHECK_THAT(text, ContainsSubstring("At least 0.0211 %"));
}

TEST_CASE("identification words: the weaker verdicts claim less") {
    identification_view v = sivid_tests::hovercraft_view(100, false);
    v.sentence.clear();
    v.volume_inner = {0, 0};
    v.verdict = outcome::undecided;
    CHECK(headline(v) == "Not decided");
    CHECK_THAT(all(v), ContainsSubstring("It is open whether"));
    CHECK(all(v).find("does explain it") == std::string::npos);
    CHECK(all(v).find("There is a parameter vector") == std::string::npos);
    v.verdict = outcome::refuted;
    CHECK(plain_statements(v).size() == 1);
    CHECK_THAT(verdict_sentence(v), ContainsSubstring("No parameter vector"));
}

TEST_CASE("identification words: allowed outliers are part of the statement") {
    std::string const text = all(sivid_tests::hovercraft_view(100, true));
    CHECK_THAT(text, ContainsSubstring("but for the outliers allowed (3 in all)"));
    CHECK_THAT(text, ContainsSubstring("2 measurements are proved to be outliers"));
}
