// SPDX-License-Identifier: MIT
#include "report/facts.hpp"
#include "report/hovercraft_view.hpp"
#include "support/catch.hpp"

#include <sivid/report/identification_page.hpp>

#include <cmath>

using namespace sivid::report;
using sivid_tests::missing_fact;

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
    double const gap = share_of_prior({"a", "", {0, 1}, {0, 1}, "", 0.25});
    CHECK((gap >= 0.75 && gap < 0.7501));
    CHECK(std::isnan(share_of_prior({"a", "", {1, 1}, {1, 1}})));
    CHECK(std::isnan(share_of_prior({"a", "", {0, 1}, {}})));
    CHECK(formula_text("L*Sg").find('*') == std::string::npos);
}

TEST_CASE("identification words: a consistent campaign") {
    std::string const text = all(sivid_tests::hovercraft_view(100, false));
    CHECK(missing_fact(text, {"180 measurements", "Sv = 0.22003"}) == "");
    CHECK(missing_fact(text, {"For L taken alone", "nothing"}) == "");
    CHECK(missing_fact(text, {"0.0573 %"}) == ""); // outer and inner volume, each on its safe side
    CHECK(missing_fact(text, {"0.0211 %"}) == "");
}

TEST_CASE("identification words: the weaker verdicts claim less") {
    identification_view v = sivid_tests::hovercraft_view(100, false);
    v.sentence.clear();
    v.volume_inner = {0, 0};
    v.verdict = outcome::undecided;
    CHECK(headline(v) != headline(sivid_tests::hovercraft_view(100, false)));
    CHECK(missing_fact(all(v), {"open"}) == "");
    CHECK(all(v).find("Sv = 0.22003") == std::string::npos); // no witness is claimed
    v.verdict = outcome::refuted;
    CHECK(plain_statements(v).size() == 1);
    CHECK(missing_fact(verdict_sentence(v), {"No parameter"}) == "");
}

TEST_CASE("identification words: allowed outliers are part of the statement") {
    std::string const text = all(sivid_tests::hovercraft_view(100, true));
    CHECK(missing_fact(text, {"outliers allowed", "3"}) == "");
    CHECK(missing_fact(text, {"2 measurements", "proved", "outliers"}) == "");
}

TEST_CASE("identification words: nothing is called not excluded of which something is") {
    identification_view v;
    CHECK(exclusion_note(v, {"a", "", {0, 1}, {0, 1}}) == "nothing excluded");
    CHECK(exclusion_note(v, {"a", "", {0, 1}, {0, 0.9999}}) == ""); // the range shows it
    CHECK(exclusion_note(v, {"a", "", {0, 1}, {}}) == "");
    CHECK(missing_fact(exclusion_note(v, {"a", "", {0, 1}, {0, 1}, "", 0.39}),
                       {"at least 39.0 %", "in between"}) == "");
    CHECK(missing_fact(exclusion_note(v, {"a", "", {0, 1}, {0.1, 1}, "", 0.39}), {"39.0 %"}) == "");
    v.excluded = 0.125;
    CHECK(missing_fact(exclusion_note(v, {"a", "", {0, 1}, {0, 1}}),
                       {"no value excluded by itself", "at least 12.5 %"}) == "");
    v.verdict = outcome::undecided;
    v.parameters = {{"a", "", {0, 1}, {0, 1}, "", 0.39}, {"b", "", {0, 1}, {0, 1}}};
    CHECK(missing_fact(all(v), {"a in [0, 1] (at least 39.0 %", "For b taken alone, nothing"}) ==
          "");
}
