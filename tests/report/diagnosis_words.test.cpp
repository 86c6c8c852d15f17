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
    v.effects = v.causes[0].effects = {"sensor_drift(r)~0.1"};
    v.about.meanings["sensor_drift(r)~0.1"] = "drift of the sensor r";
    CHECK_THAT(headline(v), ContainsSubstring("drift of the sensor r explains the data"));
}

TEST_CASE("diagnosis words: that an effect acts in some experiments or for a time is said") {
    CHECK(names_of({"wind", "rudder_lag@S1+S3"}) == "wind + rudder_lag in S1, S3");
    CHECK(names_of({"wind@S1>=0.695634187+S2"}) == "wind from a time on");
    CHECK(names_of({"wind@S1+S2<1.5"}) == "wind until a time");
    CHECK(names_of({"wind@S1>=0.3<1.5+S2"}) == "wind for a time");
    diagnosis_view v = hovercraft_diagnosis().view();
    v.about.meanings["rudder_lag@S2>=1.2345678"] = "a lag, in S2 from 1.2345678 s on only";
    CHECK(words_of(v, {"rudder_lag@S2>=1.2345678"}) ==
          v.about.meanings.at("rudder_lag") + " from a time on");
    CHECK(words_of(v, {"unheard@S2"}) == "unheard in S2");
}

TEST_CASE("diagnosis words: alternatives make the answer open, and what would tell is said") {
    diagnosis_view v = hovercraft_diagnosis().view();
    CHECK(banner_outcome(v) == outcome::undecided);
    CHECK(missing_fact(banner_sentence(v),
                       {"first-order lag", "cannot tell", "pure delay", "zigzag"}) == "");
    auto const before = claims_of(banner_sentence(v)).proved;
    v.causes[1].verdict = sivid::cause_verdict::explains; // the rival is proved to explain, too
    CHECK(claims_of(banner_sentence(v)).proved == before + 1);
    v.indistinguishable.push_back({"wind", "payload"});
    CHECK(missing_fact(headline(v), {"rudder_lag", "2 others"}) == "");
    CHECK(missing_fact(banner_sentence(v), {"pure delay", "wind and payload"}) == "");
}

TEST_CASE(
    "diagnosis words: what holds for every parameter that explains comes before the witness") {
    diagnosis_view v = hovercraft_diagnosis().view();
    auto const at_witness = banner_sentence(v);
    v.shrink_over_fits = sivid::interval(0.9755, 1);
    CHECK(missing_fact(banner_sentence(v), {"removes 97.5 to 100",
                                            "for every parameter that explains", "proved"}) == "");
    v.shrink_over_fits = sivid::interval(-0.2, 1);
    CHECK(banner_sentence(v) == at_witness);
}

TEST_CASE("diagnosis words: what is not proved is called an estimate") {
    diagnosis_view v = hovercraft_diagnosis().view();
    v.indistinguishable.clear();
    v.causes[0].verdict = sivid::cause_verdict::undecided;
    v.causes[0].parameters[0].hull = {};
    v.shrink_holdout = {};
    CHECK(banner_outcome(v) == outcome::undecided);
    CHECK(headline(v) == "Gap (proved); rudder_lag explains the data (estimate)");
    CHECK(missing_fact(banner_sentence(v), {"3.10 to 3.20", "proved", "0.169", "estimate",
                                            "explains", "estimate"}) == "");
    CHECK(claims_of(banner_sentence(v)) == claims{.proved = 1, .estimates = 2});
    v.causes[0].fitted_inflation = 1.2;
    CHECK(missing_fact(banner_sentence(v), {"likeliest", "estimate"}) == "");
    v.causes[0].verdict = sivid::cause_verdict::excluded;
    CHECK_THAT(headline(v), ContainsSubstring("comes closest"));
    CHECK(missing_fact(banner_sentence(v), {"cannot explain", "proved"}) == "");
    v.gap = sivid::gap_verdict::undecided;
    v.inflation = sivid::interval(0, infinity);
    CHECK(missing_fact(banner_sentence(v), {"open", "3.15", "estimate"}) == "");
}

TEST_CASE("diagnosis words: pairs, no gap") {
    diagnosis_view v = hovercraft_diagnosis().view();
    v.indistinguishable.clear();
    v.effects = {"quadratic_yaw_damping", "rudder_lag"};
    CHECK(missing_fact(answer_clause(v), {"quadratic_yaw_damping", "first-order lag", "together",
                                          "explain", "estimate"}) == "");
    CHECK(headline(v) ==
          "Gap (proved); quadratic_yaw_damping + rudder_lag explain the data (estimate)");

    diagnosis_view none;
    none.gap = sivid::gap_verdict::none;
    none.inflation = sivid::interval(0.83, 0.86);
    CHECK(headline(none) == "No gap (proved)");
    CHECK(banner_outcome(none) == outcome::proved);
    CHECK(missing_fact(banner_sentence(none), {"explains", "proved"}) == "");
}

TEST_CASE("diagnosis words: what is drawn beside the model is named") {
    diagnosis_view v = hovercraft_diagnosis().view();
    CHECK(after_words(v) == "with rudder_lag");
    v.answer = sivid::answer_kind::unexplained;
    CHECK(after_words(v) == "with the closest candidate");
}

TEST_CASE("diagnosis words: unexplained says place and law") {
    diagnosis_view v = hovercraft_diagnosis().view();
    v.answer = sivid::answer_kind::unexplained;
    CHECK(banner_outcome(v) == outcome::refuted);
    CHECK(missing_fact(banner_sentence(v), {"no candidate", "2", "excluded", "proved",
                                            "yaw equation", "S4", "F_u"}) == "");
    v.tried.singles = {6, 6};
    v.tried.pairs = {15, 15};
    CHECK_THAT(banner_sentence(v), ContainsSubstring("(all 21 candidates tried)"));
}

TEST_CASE("diagnosis words: what is left with the closest candidate") {
    diagnosis_view v = hovercraft_diagnosis().view();
    CHECK(remainder_clause(v).empty());
    v.answer = sivid::answer_kind::unexplained;
    v.remainder = sivid::unexplained_remainder{{"wind"}, sivid::interval(2.4, 2.6), {}};
    CHECK(missing_fact(banner_sentence(v), {"wind", "remainder", "2.39 to 2.61", "proved"}) == "");
    v.remainder->inflation = sivid::unknown_inflation(); // the best fit with wind is known
    CHECK(missing_fact(remainder_clause(v), {"2.5", "estimate"}) == "");
    CHECK_THAT(remainder_clause(v), !ContainsSubstring("proved"));
}

TEST_CASE("diagnosis words: which measurements stand alone") {
    CHECK(part_words({.channel = "v"}) == "v");
    CHECK(part_words({.scenarios = {"S1", "S3"}}) == "S1 and S3");
    CHECK(part_words({.channel = "v", .scenarios = {"S3"}}) == "v in S3");
    sivid::confined_gap const c{.channel = "v", .factor = sivid::interval(1.6123, 1.6548)};
    CHECK(missing_fact(confined_clause(c), {"all data but those of v", "1.61 to 1.66", "proved"}) ==
          "");
    auto grows = c;
    using with = sivid::noise_growth::with;
    grows.grows = sivid::noise_growth{with::rate, sivid::interval(0.0212, 0.0219)};
    grows.grows->unit = "s";
    CHECK(missing_fact(confined_clause(grows), {"1.61 to 1.66", "0.0212 to 0.0219 s times its rate",
                                                "proved to explain", "time stamps"}) == "");
    grows.grows->what = with::value;
    CHECK(missing_fact(confined_clause(grows), {"0.0212 to 0.0219 times its value"}) == "");
    auto together = c;
    CHECK_THAT(confined_clause(together), !ContainsSubstring("go together"));
    together.correlated = sivid::error_correlation{0.5, 0.4123};
    CHECK(missing_fact(confined_clause(together), {"go together for 0.412 s", "estimate"}) == "");
    auto coarse = together;
    coarse.steps = sivid::reading_steps{0.125, "m/s"};
    CHECK(missing_fact(confined_clause(coarse),
                       {"steps of 0.125\xC2\xA0m/s", "half a step", "proved"}) == "");
    CHECK_THAT(confined_clause(coarse), !ContainsSubstring("go together"));
    coarse.steps->cut_off = true;
    CHECK(missing_fact(confined_clause(coarse), {"wider by a step"}) == "");
    diagnosis_view v = hovercraft_diagnosis().view();
    auto const answered = banner_sentence(v);
    v.confined = {c};
    CHECK(banner_sentence(v) == answered); // an effect explains all
    for (auto const kind : {sivid::answer_kind::unexplained, sivid::answer_kind::open}) {
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
    v.answer = sivid::answer_kind::open;
    v.effects.clear();
    v.indistinguishable.clear();
    v.tried.singles = {8, 8};
    v.tried.pairs = {0, 28};
    CHECK(tried_text(v.tried) == "8 of 36 candidates tried, no pair");
    CHECK_FALSE(v.tried.complete());
    CHECK(headline(v) == "Gap (proved); open: 8 of 36 candidates tried, no pair");
    CHECK(banner_outcome(v) == outcome::undecided);
    CHECK_THAT(banner_sentence(v), !ContainsSubstring("no candidate"));
    CHECK_THAT(banner_sentence(v), ContainsSubstring("comes closest by now"));
    v.tried.pairs.tried = 3;
    CHECK(tried_text(v.tried) == "11 of 36 candidates tried, 3 of the 28 pairs");
    v.tried.pairs.tried = 28;
    CHECK(tried_text(v.tried) == "all 36 candidates tried");
    CHECK(v.tried.complete());
    v.tried.singles = v.tried.pairs = {};
    CHECK(tried_text(v.tried).empty());
    v.tried.singles = {0, 5};
    CHECK(tried_text(v.tried) == "none of the 5 candidates was tried");
}

TEST_CASE("diagnosis words: what is proved of a number, and where it sits") {
    using sivid::interval;
    sivid::named_estimate e{"k.k3", "1", 0.0299, interval(-2, 2), interval(-2, 2)};
    CHECK(hull_text(e) == "not narrowed");
    CHECK(estimate_words(e, true) == "k3 = 0.0299 (verified; prior not narrowed)");
    e.hull = interval(-2, 0.04001);
    CHECK(hull_text(e) == "\xE2\x88\x92"
                          "2 to 0.0401"); // not beyond the prior by rounding
    CHECK_THAT(estimate_words(e, true), EndsWith("proved)"));
    e.hull = {};
    CHECK(hull_text(e).empty());
    CHECK(estimate_words(e, true) == "k3 = 0.0299 (verified)");
    CHECK(estimate_words(e, false) == "k3 = 0.0299 (estimate)");
    using enum sivid::prior_end;
    CHECK(end_words({{"wind"}, {"k", "1/s", 3, {}, interval(3, 4)}, lower}) ==
          "k = 3.00\xC2\xA0"
          "1/s sits at the lower end of its prior [3, 4] (with wind): widen it if it may lie "
          "beyond");
    CHECK_THAT(end_words({{}, {"k", "1/s", 4, {}, interval(3, 4)}, upper}),
               ContainsSubstring("upper end of its prior [3, 4] (the model as it is)"));
}

TEST_CASE("diagnosis words: shares no finer than a reader wants") {
    CHECK(shrink_text({-7.86e-8, 7.86e-8}) == "\xE2\x88\x92"
                                              "0.1 to 0.1\xC2\xA0%");
    CHECK(shrink_text({0, 0.0004}) == "0 to 0.1\xC2\xA0%");
    CHECK(shrink_text({0.4931, 0.4939}) == "49.3 to 49.4\xC2\xA0%");
}

TEST_CASE("diagnosis words: a ladder of bounds, each rung below those with as few effects") {
    diagnosis_view v;
    CHECK(ladder_clauses(v).empty());
    v.remainder.emplace();
    v.inflation = sivid::interval{2.5, 7.001};
    auto const add = [&](std::vector<std::string> effects, double from, double to) {
        v.causes.emplace_back();
        v.causes.back().effects = std::move(effects);
        v.causes.back().inflation = sivid::interval{from, to};
    };
    add({"lag", "drag"}, 0, 3.5);
    add({"drag"}, 0, 7.5);      // no better than none
    add({"lag"}, 1.25, 3);      // as good as with drag
    add({"wind"}, 9, infinity); // not known to explain
    add({"lag", "wind"}, 0, 0.5);
    auto const rungs = ladder_clauses(v);
    REQUIRE(rungs.size() == 3);
    CHECK(rungs[0] == "as it is the model explains the data from 7.01 times the stated bounds on, "
                      "and is refuted below 2.50 times (proved)");
    CHECK(rungs[1] == "with lag it explains the data from 3.00 times the stated bounds on, and is "
                      "refuted below 1.25 times (proved)");
    CHECK(rungs[2] == "with lag + wind it explains the data from 0.500 times the stated bounds on "
                      "(proved)");
    v.inflation = sivid::interval{2.5, infinity};
    CHECK(ladder_clauses(v)[0] ==
          "as it is the model is refuted below 2.50 times the stated bounds "
          "(proved)");
}
