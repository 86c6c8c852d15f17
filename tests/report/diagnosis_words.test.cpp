// SPDX-License-Identifier: MIT
#include "report/diagnosis_example.hpp"
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
    CHECK(banner_sentence(v) ==
          "The model and the robot part by 3.10 to 3.20 times the measurement bounds (proved); "
          "a first-order lag of the rudder, tau = 0.169\xC2\xA0s (0.160 to 0.180, proved), "
          "explains all data (proved); on data that chose nothing it removes "
          "98.2 to 100\xC2\xA0% of the gap (proved).");
}

TEST_CASE("diagnosis words: alternatives make the answer open, and what would tell is said") {
    diagnosis_view v = hovercraft_diagnosis().view();
    CHECK(banner_outcome(v) == outcome::undecided);
    CHECK_THAT(banner_sentence(v),
               ContainsSubstring("the data cannot tell it from a pure delay of the rudder "
                                 "command; the manoeuvre \xE2\x80\x9Czigzag\xE2\x80\x9D would"));
    CHECK(banner_sentence(v).find("as well, proved") == std::string::npos);
    v.candidates[1].state = candidate_state::explains;
    CHECK_THAT(banner_sentence(v),
               ContainsSubstring("rudder command (which explains as well, proved)"));
    v.indistinguishable.push_back({"wind", "payload"});
    CHECK_THAT(headline(v), EndsWith(", but so may 2 others"));
    CHECK_THAT(banner_sentence(v), ContainsSubstring(" or from wind and payload"));
}

TEST_CASE("diagnosis words: what is not proved is called an estimate") {
    diagnosis_view v = hovercraft_diagnosis().view();
    v.indistinguishable.clear();
    v.candidates[0].state = candidate_state::open;
    v.candidates[0].parameters[0].hull = {};
    v.shrink_holdout = {};
    CHECK(banner_outcome(v) == outcome::undecided);
    CHECK(headline(v) == "Gap (proved); rudder_lag explains the data (estimate)");
    CHECK_THAT(banner_sentence(v),
               EndsWith("tau = 0.169\xC2\xA0s (estimate), explains all data in the best fit found "
                        "(estimate)."));
    v.candidates[0].fitted = 1.2;
    CHECK_THAT(banner_sentence(v), EndsWith("is the likeliest of what was tried (estimate)."));
    v.candidates[0].state = candidate_state::excluded;
    CHECK_THAT(headline(v), ContainsSubstring("comes closest"));
    CHECK_THAT(banner_sentence(v), EndsWith("but cannot explain all data (proved)."));
    v.gap = gap_state::open;
    v.inflation = {0, infinity};
    CHECK_THAT(banner_sentence(v),
               StartsWith("It is open whether the model explains the data: it parts from the robot "
                          "by \xE2\x89\x88\xE2\x80\xAF"
                          "3.15 times the bounds in the best fit found (estimate)"));
}

TEST_CASE("diagnosis words: pairs, no gap, absorbed effects") {
    diagnosis_view v = hovercraft_diagnosis().view();
    v.indistinguishable.clear();
    v.effects = {"quadratic_yaw_damping", "rudder_lag"};
    CHECK_THAT(answer_clause(v), ContainsSubstring("quadratic_yaw_damping and a first-order lag"));
    CHECK_THAT(answer_clause(v), ContainsSubstring("together explain all data in the best fit"));
    CHECK(headline(v) ==
          "Gap (proved); quadratic_yaw_damping + rudder_lag explain the data (estimate)");

    diagnosis_view none;
    none.gap = gap_state::absent;
    none.inflation = {0.83, 0.86};
    CHECK(headline(none) == "No gap (proved)");
    CHECK(banner_outcome(none) == outcome::proved);
    CHECK_THAT(banner_sentence(none), ContainsSubstring("explains all data of the fit (proved; "));
    none.absorbed = {"payload"};
    CHECK_THAT(banner_sentence(none), EndsWith("the priors are wide enough to take up payload."));
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
    CHECK_THAT(banner_sentence(v),
               ContainsSubstring("no candidate was found that explains it, 2 "
                                 "are excluded (proved); the yaw equation (S4"));
    CHECK_THAT(banner_sentence(v), ContainsSubstring("in the shape of F_u"));
}

TEST_CASE("diagnosis words: what is left with the closest candidate") {
    diagnosis_view v = hovercraft_diagnosis().view();
    CHECK(remainder_clause(v).empty());
    v.answer = answer_state::unexplained;
    v.remainder = remainder_view{.effects = {"wind"}, .inflation = {2.4, 2.6}};
    CHECK_THAT(banner_sentence(v),
               ContainsSubstring("with wind, the closest, an unexplained remainder of 2.39 to 2.61 "
                                 "times the measurement bounds is left (proved)"));
    v.remainder->inflation = {};
    v.remainder->fitted = 2.5;
    CHECK_THAT(remainder_clause(v), ContainsSubstring("in the best fit found (estimate)"));
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
