// SPDX-License-Identifier: MIT
#include <sivid/io/stored_prediction.hpp>

#include "io/stored_result.hpp"
#include "support/catch.hpp"

#include <sivid/decision/prediction.hpp>
#include <sivid/decision/requirement.hpp>

#include <cmath>
#include <string>

namespace {

using answer = sivid::requirement_answer;
using io_support::stored_result;

/// x' = -a b x from 2, a b near 1/2: known through the product alone.
struct prepared {
    sivid::identification_problem problem = io_support::two_rates_problem();
    stored_result result{problem};

    [[nodiscard]] static sivid::prediction_request request(double end = 1) {
        sivid::prediction_request r;
        r.initial = {sivid::interval(2.0)};
        r.end = end;
        return r;
    }
    [[nodiscard]] sivid::verification
    verified(std::string const& text, sivid::stored_identification const& stored,
             sivid::prediction_request const& r = request()) const {
        auto model = problem.model;
        auto const what = sivid::parse_requirement(text, model, r.end);
        auto const p = sivid::predict_from(problem, stored, model, what.margins, r, "result.json");
        return sivid::verify(p->problem, what, p->feasible, {.seconds = 5});
    }
    [[nodiscard]] sivid::verification verified(std::string const& text) const {
        return verified(text, result.read());
    }
};

} // namespace

TEST_CASE("a prediction runs in the products that the data fix") {
    prepared const t;
    auto const p = sivid::predict_from(t.problem, t.result.read(), t.problem.model, {},
                                       prepared::request(), "result.json");
    CHECK(p->in_products);
    CHECK(p->sides == std::vector<std::string>{"a*b"});
    CHECK(p->problem.sets.size() >= 1);
    CHECK(p->direct.choice.unknown.size() == 2);
    auto const tube = sivid::predict(p->problem);
    REQUIRE(tube.complete);
    // Whatever the factors: 2 exp(-a b t) for a b around 1/2.
    CHECK(tube.channels[0].low.back() < 2 * std::exp(-0.5));
    CHECK(tube.channels[0].high.back() > 2 * std::exp(-0.5));
    CHECK(tube.channels[0].high.back() - tube.channels[0].low.back() < 0.11);
}

TEST_CASE("requirements over a stored result: proved, refuted with a proven witness") {
    prepared const t;
    CHECK(t.verified("always(x > 1.1)").answer == answer::proved);
    auto const fails = t.verified("x at 1 > 1.22"); // the truth is 1.213, feasible up to about 1.25
    REQUIRE(fails.answer == answer::refuted);
    double const rate = fails.witness->parameters[0] * fails.witness->parameters[1];
    CHECK(2 * std::exp(-rate) < 1.22);
    for (int k = 1; k <= 6; ++k) // explains the data
        CHECK(std::abs(2 * std::exp(-rate * 0.5 * k) - 2 * std::exp(-0.25 * k)) <= 0.05);
}

TEST_CASE("a requirement that tells the factors apart is judged in the parameters") {
    prepared const t;
    auto model = t.problem.model;
    auto const what = sivid::parse_requirement("a * x at 1 > 0", model, 1);
    auto const p = sivid::predict_from(t.problem, t.result.read(), model, what.margins,
                                       prepared::request(), "result.json");
    CHECK_FALSE(p->in_products);
    CHECK_FALSE(p->not_in_products.empty());
    CHECK(p->sides == std::vector<std::string>{"a", "b"});
    CHECK(sivid::verify(p->problem, what, p->feasible, {.seconds = 5}).answer == answer::proved);
    CHECK(t.verified("a at 0 < 1.5").answer == answer::refuted);
}

TEST_CASE("constants are set, or given a range, for the scenario alone") {
    prepared t;
    t.problem = io_support::one_rate_problem(); // b = 1/2 is fixed
    stored_result const stored(t.problem);
    auto r = prepared::request();
    r.set["b"] = sivid::interval(0.25, 0.75);
    // a is near 1 by the data, so that a b lies in [0.24, 0.78] or so
    CHECK(t.verified("x at 1 in [0.85, 1.65]", stored.read(), r).answer == answer::proved);
    auto const fails = t.verified("x at 1 > 1", stored.read(), r);
    REQUIRE(fails.answer == answer::refuted);
    REQUIRE(fails.witness->parameters.size() == 2);
    CHECK(fails.witness->parameters[1] > 0.6); // the range of b, its far end
    CHECK(fails.witness->parameters[1] <= 0.75);
    r.set["b"] = sivid::interval(0.5);
    CHECK(t.verified("x at 1 > 1", stored.read(), r).answer == answer::proved);
    r.set = {{"a", sivid::interval(1.0)}};
    CHECK_THROWS_WITH(t.verified("x at 1 > 1", stored.read(), r), ContainsSubstring("identify"));
    r.set = {{"c", sivid::interval(1.0)}};
    CHECK_THROWS_WITH(t.verified("x at 1 > 1", stored.read(), r), ContainsSubstring("unknown"));
    r.set = {{"b", sivid::interval(0.0, HUGE_VAL)}};
    CHECK_THROWS_WITH(t.verified("x at 1 > 1", stored.read(), r), ContainsSubstring("bounded"));
}

TEST_CASE("an altered result is refused") {
    prepared t;
    auto altered = t.result;
    REQUIRE(altered.replace_csv("pending", "inside"));
    CHECK_THROWS_WITH(t.verified("x at 1 > 1", altered.read()), ContainsSubstring("contradicts"));
    auto stored = t.result.read();
    stored.products->rows.pop_back();
    CHECK_THROWS_WITH(t.verified("x at 1 > 1", stored), ContainsSubstring("contradicts"));
    stored = t.result.read();
    stored.parameters[0].name = "z";
    CHECK_THROWS_WITH(t.verified("x at 1 > 1", stored), ContainsSubstring("other parameters"));
}

TEST_CASE("inside boxes and a witness that were forged refute nothing") {
    prepared t;
    auto stored = t.result.read();
    // The whole prior is said to be feasible, and a witness that is not.
    for (auto* rows : {&stored.rows, &stored.products->rows}) {
        for (auto& row : *rows) row.verdict = sivid::box_verdict::inside;
    }
    stored.stated_rows.clear();
    stored.products->stated_rows.clear();
    stored.products->rows = {{{sivid::interval(0.125, 2.0)}, sivid::box_verdict::inside}};
    stored.witness->parameters["a"] = 2;
    stored.witness->parameters["b"] = 1;
    auto const says = t.verified("x at 1 > 1", stored); // violated for a b > 0.69
    CHECK(says.answer == answer::open);
    // A violation by what is feasible is found nevertheless.
    auto const truly = t.verified("x at 1 > 1.22", stored);
    CHECK(truly.answer != answer::proved);
}

TEST_CASE("boxes that were not decided count") {
    prepared t;
    auto stored = t.result.read();
    CHECK(t.verified("x at 1 > 1", stored).answer == answer::proved);
    stored.products->stated_rows.clear();
    stored.products->rows.push_back({{sivid::interval(0.8, 0.9)}, sivid::box_verdict::undecided});
    auto const says = t.verified("x at 1 > 1", stored);
    CHECK(says.answer == answer::open);
    REQUIRE_FALSE(says.open.empty());
    CHECK(says.open[0].parameters[0].upper() > 0.69);
    // What is said to be excluded does not.
    stored.products->rows.back().verdict = sivid::box_verdict::outside;
    CHECK(t.verified("x at 1 > 1", stored).answer == answer::proved);
}

TEST_CASE("without a parameter there is nothing to say") {
    prepared t;
    auto stored = t.result.read();
    stored.verdict = sivid::verdict::inconsistent;
    stored.grounds.clear();
    stored.witness.reset();
    stored.rows.clear();
    stored.stated_rows.clear();
    stored.products.reset();
    stored.inner = stored.outer = sivid::interval(0.0);
    CHECK_THROWS_WITH(t.verified("x at 1 > 1", stored), ContainsSubstring("no parameter is left"));
}

TEST_CASE("outliers that the identification allowed count for a witness, too") {
    prepared t;
    t.problem = io_support::two_rates_problem(true); // one sample is spoilt, one may be
    stored_result const stored(t.problem);
    CHECK(t.verified("always(x > 1.1)", stored.read()).answer == answer::proved);
    CHECK(t.verified("x at 1 > 1.22", stored.read()).answer == answer::refuted);
    auto strict = t.problem;
    strict.experiments[0].outliers = 0; // then nothing explains the data
    auto model = strict.model;
    auto const what = sivid::parse_requirement("x at 1 > 1.22", model, 1);
    auto const p = sivid::predict_from(strict, stored.read(), model, what.margins,
                                       prepared::request(), "result.json");
    CHECK(sivid::verify(p->problem, what, p->feasible, {.seconds = 2}).answer == answer::open);
}
