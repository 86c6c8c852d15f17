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
    // The fault of an instrument that no catalogue names is said in words.
    v.effects = v.candidates[0].effects = {"sensor_drift(r)~0.1"};
    v.meanings["sensor_drift(r)~0.1"] = "drift of the sensor r";
    CHECK_THAT(headline(v), ContainsSubstring("drift of the sensor r explains the data"));
}

TEST_CASE("diagnosis words: that an effect acts in some experiments or for a time is said") {
    CHECK(names_of({"wind", "rudder_lag@S1+S3"}) == "wind + rudder_lag in S1, S3");
    CHECK(names_of({"wind@S1>=0.695634187+S2"}) == "wind from a time on");
    CHECK(names_of({"wind@S1+S2<1.5"}) == "wind until a time");
    CHECK(names_of({"wind@S1>=0.3<1.5+S2"}) == "wind for a time");
    diagnosis_view v = hovercraft_diagnosis().view();
    v.meanings["rudder_lag@S2>=1.2345678"] = "a lag, in S2 from 1.2345678 s on only";
    CHECK(words_of(v, {"rudder_lag@S2>=1.2345678"}) ==
          v.meanings.at("rudder_lag") + " from a time on");
    CHECK(words_of(v, {"unheard@S2"}) == "unheard in S2");
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

TEST_CASE(
    "diagnosis words: what holds for every parameter that explains comes before the witness") {
    diagnosis_view v = hovercraft_diagnosis().view();
    auto const at_witness = banner_sentence(v);
    v.shrink_over_fits = {0.9755, 1};
    CHECK(missing_fact(banner_sentence(v), {"removes 97.5 to 100",
                                            "for every parameter that explains", "proved"}) == "");
    v.shrink_over_fits = {-0.2, 1};
    CHECK(banner_sentence(v) == at_witness);
}

TEST_CASE("diagnosis words: what is not proved is called an estimate") {
    diagnosis_view v = hovercraft_diagnosis().view();
    v.indistinguishable.clear();
    v.candidates[0].state = candidate_state::open;
    v.candidates[0].parameters[0].hull = {};
    v.candidates[0].parameters[0].verified = false;
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
    v.singles = {6, 6};
    v.pairs = {15, 15};
    CHECK_THAT(banner_sentence(v), ContainsSubstring("(all 21 candidates tried)"));
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

TEST_CASE("diagnosis words: which measurements stand alone") {
    CHECK(part_words({.channel = "v"}) == "v");
    CHECK(part_words({.scenarios = {"S1", "S3"}}) == "S1 and S3");
    CHECK(part_words({.channel = "v", .scenarios = {"S3"}}) == "v in S3");
    confined_view const c{.channel = "v", .factor = {1.6123, 1.6548}};
    CHECK(missing_fact(confined_clause(c), {"all data but those of v", "1.61 to 1.66", "proved"}) ==
          "");
    auto grows = c;
    grows.grows = confined_view::growth::rate;
    grows.coefficient = {0.0212, 0.0219};
    CHECK(missing_fact(confined_clause(grows), {"1.61 to 1.66", "0.0212 to 0.0219 s times its rate",
                                                "proved to explain", "time stamps"}) == "");
    grows.grows = confined_view::growth::value;
    CHECK(missing_fact(confined_clause(grows), {"0.0212 to 0.0219 times its value"}) == "");
    auto together = c;
    CHECK_THAT(confined_clause(together), !ContainsSubstring("go together"));
    together.together_for = 0.4123;
    CHECK(missing_fact(confined_clause(together), {"go together for 0.412 s", "estimate"}) == "");
    auto coarse = together;
    coarse.step = 0.125;
    coarse.unit = "m/s";
    CHECK(missing_fact(confined_clause(coarse),
                       {"steps of 0.125\xC2\xA0m/s", "half a step", "proved"}) == "");
    CHECK_THAT(confined_clause(coarse), !ContainsSubstring("go together"));
    coarse.cut_off = true;
    CHECK(missing_fact(confined_clause(coarse), {"wider by a step"}) == "");
    diagnosis_view v = hovercraft_diagnosis().view();
    auto const answered = banner_sentence(v);
    v.confined = {c};
    CHECK(banner_sentence(v) == answered); // an effect explains all
    for (auto const kind : {answer_state::unexplained, answer_state::open}) {
        v.answer = kind;
        CHECK_THAT(banner_sentence(v), ContainsSubstring(confined_clause(c)));
        CHECK_THAT(headline(v), ContainsSubstring("; all but v is explained (proved)"));
    }
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

TEST_CASE("diagnosis words: an answer is open while something is left to try") {
    diagnosis_view v = hovercraft_diagnosis().view();
    v.answer = answer_state::open;
    v.effects.clear();
    v.indistinguishable.clear();
    v.singles = {8, 8};
    v.pairs = {0, 28};
    CHECK(tried_text(v) == "8 of 36 candidates tried, no pair");
    CHECK_FALSE(tried_all(v));
    CHECK(headline(v) == "Gap (proved); open: 8 of 36 candidates tried, no pair");
    CHECK(banner_outcome(v) == outcome::undecided);
    CHECK_THAT(banner_sentence(v), !ContainsSubstring("no candidate"));
    CHECK_THAT(banner_sentence(v), ContainsSubstring("comes closest by now"));
    v.pairs.tried = 3;
    CHECK(tried_text(v) == "11 of 36 candidates tried, 3 of the 28 pairs");
    v.pairs.tried = 28;
    CHECK(tried_text(v) == "all 36 candidates tried");
    CHECK(tried_all(v));
    v.singles = v.pairs = {};
    CHECK(tried_text(v).empty());
    v.singles = {0, 5};
    CHECK(tried_text(v) == "none of the 5 candidates was tried");
}

TEST_CASE("diagnosis words: what is proved of a number, and where it sits") {
    estimate_view e{"k.k3", "1", 0.0299, {-2, 2}, {-2, 2}, true};
    CHECK(hull_text(e) == "not narrowed");
    CHECK(estimate_words(e) == "k3 = 0.0299 (verified; prior not narrowed)");
    e.hull = {-2, 0.04001};
    CHECK(hull_text(e) == "\xE2\x88\x92"
                          "2 to 0.0401"); // not beyond the prior by rounding
    CHECK_THAT(estimate_words(e), EndsWith("proved)"));
    e.hull = {};
    CHECK(hull_text(e).empty());
    CHECK(estimate_words(e) == "k3 = 0.0299 (verified)");
    CHECK(end_words({{"wind"}, {"k", "1/s", 3, {}, {3, 4}}, false}) ==
          "k = 3.00\xC2\xA0"
          "1/s sits at the lower end of its prior [3, 4] (with wind): widen it if it may lie "
          "beyond");
    CHECK_THAT(end_words({{}, {"k", "1/s", 4, {}, {3, 4}}, true}),
               ContainsSubstring("upper end of its prior [3, 4] (the model as it is)"));
}

TEST_CASE("diagnosis words: shares no finer than a reader wants") {
    CHECK(shrink_text({-7.86e-8, 7.86e-8}) == "\xE2\x88\x92"
                                              "0.1 to 0.1\xC2\xA0%");
    CHECK(shrink_text({0, 0.0004}) == "0 to 0.1\xC2\xA0%");
    CHECK(shrink_text({0.4931, 0.4939}) == "49.3 to 49.4\xC2\xA0%");
}
