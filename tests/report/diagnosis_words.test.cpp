// SPDX-License-Identifier: MIT
#include "report/diagnosis_example.hpp"
#include "report/facts.hpp"
#include "support/catch.hpp"

#include <sivid/report/diagnosis_words.hpp>

#include <limits>
#include <string>

using namespace sivid::report;
using namespace sivid_tests;

namespace {

double const infinity = std::numeric_limits<double>::infinity();

} // namespace

TEST_CASE("diagnosis words: the whole answer in one sentence") {
    diagnosis_view v = hovercraft_diagnosis().view();
    v.indistinguishable.clear();
    CHECK(headline(v) == "Gap (proved); rudder_lag explains the data (proved)");
    CHECK(banner_outcome(v) == outcome::proved);
    CHECK(
        missing_fact(banner_sentence(v), {"3.10 to 3.20", "proved", "first-order lag of the rudder",
                                          "0.169\xC2\xA0s", "0.160 to 0.180, proved", "explains",
                                          "proved", "98.2 to 100\xC2\xA0%", "proved"}) == "");
    CHECK(claims_of(banner_sentence(v)) == claims{.proved = 4, .estimates = 0});
}

TEST_CASE("diagnosis words: alternatives make the answer open, and what would tell is said") {
    diagnosis_view v = hovercraft_diagnosis().view();
    CHECK(banner_outcome(v) == outcome::undecided);
    CHECK(missing_fact(banner_sentence(v),
                       {"first-order lag", "cannot tell", "pure delay", "zigzag"}) == "");
    auto const before = claims_of(banner_sentence(v)).proved;
    v.candidates[1].state = candidate_state::explains; // the rival is proved to explain, too
    CHECK(claims_of(banner_sentence(v)).proved == before + 1);
    v.indistinguishable.push_back({"wind", "payload"});
    CHECK(missing_fact(headline(v), {"rudder_lag", "2 others"}) == "");
    CHECK(missing_fact(banner_sentence(v), {"pure delay", "wind and payload"}) == "");
}

TEST_CASE("diagnosis words: what is not proved is called an estimate") {
    diagnosis_view v = hovercraft_diagnosis().view();
    v.indistinguishable.clear();
    v.candidates[0].state = candidate_state::open;
    v.candidates[0].parameters[0].hull = {};
    v.shrink_holdout = {};
    CHECK(banner_outcome(v) == outcome::undecided);
    CHECK(headline(v) == "Gap (proved); rudder_lag explains the data (estimate)");
    CHECK(missing_fact(banner_sentence(v), {"3.10 to 3.20", "proved", "0.169", "estimate",
                                            "explains", "estimate"}) == "");
    CHECK(claims_of(banner_sentence(v)) == claims{.proved = 1, .estimates = 2});
    v.candidates[0].fitted = 1.2;
    CHECK(missing_fact(banner_sentence(v), {"likeliest", "estimate"}) == "");
    v.candidates[0].state = candidate_state::excluded;
    CHECK_THAT(headline(v), ContainsSubstring("comes closest"));
    CHECK(missing_fact(banner_sentence(v), {"cannot explain", "proved"}) == "");
    v.gap = gap_state::open;
    v.inflation = {0, infinity};
    CHECK(missing_fact(banner_sentence(v), {"open", "3.15", "estimate"}) == "");
}

TEST_CASE("diagnosis words: pairs, no gap, absorbed effects") {
    diagnosis_view v = hovercraft_diagnosis().view();
    v.indistinguishable.clear();
    v.effects = {"quadratic_yaw_damping", "rudder_lag"};
    CHECK(missing_fact(answer_clause(v), {"quadratic_yaw_damping", "first-order lag", "together",
                                          "explain", "estimate"}) == "");
    CHECK(headline(v) ==
          "Gap (proved); quadratic_yaw_damping + rudder_lag explain the data (estimate)");

    diagnosis_view none;
    none.gap = gap_state::absent;
    none.inflation = {0.83, 0.86};
    CHECK(headline(none) == "No gap (proved)");
    CHECK(banner_outcome(none) == outcome::proved);
    CHECK(missing_fact(banner_sentence(none), {"explains", "proved"}) == "");
    none.absorbed = {"payload"};
    CHECK(missing_fact(banner_sentence(none), {"proved", "priors", "payload"}) == "");
}

TEST_CASE("diagnosis words: what is drawn beside the model is named") {
    diagnosis_view v = hovercraft_diagnosis().view();
    CHECK(after_words(v) == "with rudder_lag");
    v.answer = answer_state::unexplained;
    CHECK(after_words(v) == "with the closest candidate");
    v.after = "with wind";
    CHECK(after_words(v) == "with wind");
}

TEST_CASE("diagnosis words: unexplained says place and law") {
    diagnosis_view v = hovercraft_diagnosis().view();
    v.answer = answer_state::unexplained;
    CHECK(banner_outcome(v) == outcome::refuted);
    CHECK(missing_fact(banner_sentence(v), {"no candidate", "2", "excluded", "proved",
                                            "yaw equation", "S4", "F_u"}) == "");
}

TEST_CASE("diagnosis words: what is left with the closest candidate") {
    diagnosis_view v = hovercraft_diagnosis().view();
    CHECK(remainder_clause(v).empty());
    v.answer = answer_state::unexplained;
    v.remainder = remainder_view{.effects = {"wind"}, .inflation = {2.4, 2.6}};
    CHECK(missing_fact(banner_sentence(v), {"wind", "remainder", "2.39 to 2.61", "proved"}) == "");
    v.remainder->inflation = {};
    v.remainder->fitted = 2.5;
    CHECK(missing_fact(remainder_clause(v), {"2.5", "estimate"}) == "");
    CHECK_THAT(remainder_clause(v), !ContainsSubstring("proved"));
}

TEST_CASE("diagnosis words: bounds are printed outward and open ends are said") {
    CHECK(span_text({3.1024, 3.1987}) == "3.10 to 3.20");
    CHECK(span_text({3.1, infinity}) == "at least 3.10");
    CHECK(span_text({-infinity, infinity}) == "not bounded");
    CHECK(span_text({}) == "?");
    CHECK(shrink_text({-infinity, 0.5}) == "at most 50.0\xC2\xA0%");
    CHECK(shrink_text({0.98765, 1}) == "98.7 to 100\xC2\xA0%");
    CHECK(shrink_text({}) == "");
    CHECK(shrink_text({1, 1}) == "100\xC2\xA0%");
    CHECK(shrink_clause({-infinity, 1}, "x") == ""); // says nothing
    CHECK_THAT(shrink_clause({-0.5, -0.1}, "x"), ContainsSubstring("does not shrink the gap"));
    CHECK(shrink_clause({}, "x") == "");
}
