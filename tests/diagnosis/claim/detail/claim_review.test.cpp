// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/claim/detail/claim_review.hpp>

#include "diagnosis/small_catalogue.hpp"
#include "support/catch.hpp"

#include <sivid/approximate/candidate/screening.hpp>

using namespace sivid;

namespace {

/// The cart with a slope: the model as it is, and the effect that explains.
diagnosis_run sloping() {
    diagnosis_run run;
    run.base = small_campaign::problem(small_campaign::with_slope(0.4));
    run.catalogue = small_campaign::catalogue();
    screening tried(run.base, run.catalogue);
    tried.try_one({});
    tried.try_one({1});
    run.candidates = tried.candidates();
    for (auto const& s : run.candidates) {
        run.result.causes.push_back(cause_of(s, run.catalogue, run.base.prior.size(), 1));
    }
    run.result.gap = gap_verdict::certified;
    run.result.inflation = interval(2, 5);
    run.result.answer = answer_kind::effects;
    run.result.effects = {"slope"};
    return run;
}
relation_finding refuted(std::size_t equation, std::vector<std::string> channels) {
    relation_finding f;
    f.equation = equation;
    f.name = equation == 0 ? "p" : "v";
    f.proved = true;
    f.channels = std::move(channels);
    f.assumptions = {"assumed for " + f.name};
    return f;
}

} // namespace

TEST_CASE("the greatest variation within a time") {
    std::vector<double> const t{0, 1, 2, 3, 4}, v{0, 5, 1, 2, -3};
    CHECK(greatest_variation(t, v, 1) == 5);
    CHECK(greatest_variation(t, v, 2) == 5);
    CHECK(greatest_variation(t, v, 3) == 8);
    CHECK(greatest_variation(t, v, 0.5) == 0);
    CHECK(greatest_variation({}, {}, 1) == 0);
}

TEST_CASE(
    "a relation that an explaining cause leaves as it is is withdrawn with what it excluded") {
    auto run = sloping();
    run.findings = {refuted(0, {"p", "v"}), refuted(1, {"p", "v"})};
    for (auto const& f : run.findings) run.result.relations.push_back(reported(f));
    auto& base = run.result.causes.front();
    base.verdict = cause_verdict::excluded;
    base.excluded_by = "p";
    base.assumptions = {"assumed for p"};
    run.result.causes.back().verdict = cause_verdict::explains;
    run.result.causes.back().inflation = interval(0, 0.9);
    settle_claims(run);
    auto const& d = run.result;
    REQUIRE(d.relations.size() == 1); // the slope acts on v
    CHECK(d.relations[0].equation == "v");
    CHECK(run.findings.size() == 1);
    CHECK(base.verdict == cause_verdict::undecided);
    CHECK(base.excluded_by.empty());
    CHECK(base.untouched == std::vector<std::string>{"v"});
    CHECK(d.causes.back().untouched.empty());
    CHECK(d.withdrawn.size() == 2);
    CHECK(d.assumptions == std::vector<std::string>{"assumed for v"});
    CHECK(find_contradictions(d).empty());
}

TEST_CASE("a candidate that seems to explain is enough to doubt an assumption") {
    auto run = sloping();
    run.findings = {refuted(0, {"p", "v"})};
    REQUIRE(run.candidates.back().figures.explains());
    review_relations(run);
    CHECK(run.findings.empty());
    REQUIRE(run.result.withdrawn.size() == 1);
    CHECK_THAT(run.result.withdrawn[0].reason, ContainsSubstring("seems to explain"));
}

TEST_CASE("a motion that explains may not vary more than a relation assumes") {
    auto run = sloping();
    auto f = refuted(1, {"p", "v"});
    f.variations = {{"E1", 1, 0.1, 1.0}}; // v' is cos 2t and a little: 0.2 within 0.1 s
    run.result.causes.back().verdict = cause_verdict::explains;
    run.result.causes.back().inflation = interval(0, 0.9);
    CHECK_FALSE(breaks_assumptions(run.candidates.back(), f));
    run.findings = {f};
    review_relations(run);
    CHECK(run.findings.size() == 1);
    f.variations = {{"E1", 1, 0.1, 0.05}};
    CHECK(breaks_assumptions(run.candidates.back(), f));
    run.findings = {f};
    review_relations(run);
    CHECK(run.findings.empty());
    CHECK_THAT(run.result.withdrawn[0].reason, ContainsSubstring("vary more"));
}

TEST_CASE("an answer that is excluded leaves it open while candidates are untried") {
    for (std::size_t const tried : {1U, 8U}) {
        auto run = sloping();
        run.result.tried.singles = {.tried = tried, .planned = 8};
        run.result.causes.back().verdict = cause_verdict::excluded;
        run.result.causes.back().inflation = interval(2, 5);
        settle_claims(run);
        CHECK(run.result.effects.empty());
        CHECK(run.result.answer == (tried == 8 ? answer_kind::unexplained : answer_kind::open));
    }
}

TEST_CASE("a channel that alone stands against the model is suspected where no place was found") {
    diagnosis d;
    d.gap = gap_verdict::certified;
    d.answer = answer_kind::unexplained;
    d.confined = {{.scenarios = {"S3"}}, {.channel = "y", .scenarios = {"S4"}}, {.channel = "v"}};
    suspect_instrument(d);
    REQUIRE(d.where.size() == 1);
    CHECK(d.where[0].kind == "sensor");
    CHECK(d.where[0].name == "y");
    CHECK(d.where[0].where.scenario == "S4");
    CHECK_FALSE(d.where[0].proved);
    suspect_instrument(d);
    CHECK(d.where.size() == 1);
    for (auto const answer : {answer_kind::effects, answer_kind::none}) {
        d.where.clear();
        d.answer = answer;
        d.gap = answer == answer_kind::none ? gap_verdict::none : gap_verdict::certified;
        suspect_instrument(d);
        CHECK(d.where.empty());
    }
}

TEST_CASE("the instrument whose fault is the answer is the first place") {
    diagnosis d;
    d.gap = gap_verdict::certified;
    d.answer = answer_kind::effects;
    d.effects = {"sensor_lag(u:v)~0.5"};
    d.where.resize(3);
    d.where[0].kind = "equation";
    d.where[0].name = "v";
    d.where[1].kind = d.where[2].kind = "sensor";
    d.where[1].name = "r";
    d.where[2].name = "v";
    for (auto& w : d.where) w.law = "latency", w.estimate = 0.5; // looked so before
    auto const first = [&d] { return d.where.front().kind + " " + d.where.front().name; };
    suspect_instrument(d);
    CHECK(first() == "sensor v");
    CHECK(d.where.size() == 3);
    CHECK((d.where[0].law.empty() && !d.where[0].estimate));
    CHECK(d.where[1].kind == "equation");
    CHECK(d.where[1].law == "latency");
    d.effects = {"sensor_lag(x:y)~0.5"};
    suspect_instrument(d);
    CHECK(first() == "sensor x");
    CHECK(d.where.size() == 4);
    d.effects = {"wind"};
    suspect_instrument(d);
    CHECK(d.where.size() == 4);
}

TEST_CASE("a channel that stands alone is the first place where no effect explains") {
    diagnosis d;
    d.gap = gap_verdict::certified;
    d.answer = answer_kind::unexplained;
    suspected_place equation;
    equation.kind = "equation";
    equation.name = "v";
    // Of two that do, one of whose errors something is known.
    d.confined = {{.channel = "y"}, {.channel = "v"}};
    d.where = {equation};
    suspect_instrument(d);
    CHECK(d.where.size() == 1);
    for (bool const grows : {false, true}) {
        d.confined = {{.channel = "y"}, {.channel = "v"}};
        if (grows)
            d.confined[1].grows = noise_growth{};
        else
            d.confined[1].correlated = error_correlation{};
        d.where = {equation};
        suspect_instrument(d);
        REQUIRE(d.where.size() == 2);
        CHECK(d.where[0].kind + " " + d.where[0].name == "sensor v");
    }
    d.confined = {{.channel = "v"}, {.scenarios = {"S1"}}};
    d.where = {equation};
    suspect_instrument(d);
    REQUIRE(d.where.size() == 2);
    CHECK(d.where[0].kind + " " + d.where[0].name == "sensor v");
    suspect_instrument(d);
    CHECK(d.where.size() == 2);
    d.answer = answer_kind::effects;
    d.effects = {"wind"};
    d.where = {d.where[1]};
    suspect_instrument(d);
    CHECK(d.where.size() == 1);
}
