// SPDX-License-Identifier: MIT
#include <sivid/verifier/predict_from.hpp>

#include "io/stored_result.hpp"
#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/products.hpp"
#include "verifier/forgery.hpp"

#include <sivid/decision/experiment_design.hpp>
#include <sivid/decision/prediction.hpp>
#include <sivid/decision/promised_width.hpp>
#include <sivid/decision/requirement.hpp>
#include <sivid/io/decision_json.hpp>
#include <sivid/io/result/problem_digest.hpp>
#include <sivid/paving/identify.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

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
        return sivid::verify(p->problem, what, p->feasible, {.seconds = 2});
    }
    [[nodiscard]] sivid::verification verified(std::string const& text) const {
        return verified(text, result.read());
    }
    [[nodiscard]] std::unique_ptr<sivid::stored_prediction>
    predicted(sivid::stored_identification const& stored,
              sivid::prediction_request const& r = request()) const {
        return sivid::predict_from(problem, stored, problem.model, {}, r, "result.json");
    }
};

bool names(std::vector<std::string> const& lines, std::string const& words) {
    return std::any_of(lines.begin(), lines.end(),
                       [&](auto const& l) { return l.find(words) != std::string::npos; });
}

/// One rate a near 1, and a state s that an effect added, which begins at a.
struct begins_at_a {
    static constexpr auto name = "begins at a";
    static constexpr auto states = sivid::states({{"x", "m", 10}, {"s", "1", 10}});
    static constexpr auto inputs = sivid::no_inputs;
    static constexpr auto channels = sivid::channels({{"x", "m"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"a", "1/s", 1_dec}});
    }();
    template <class T>
    sivid::vec<T, 2> rate(T const&, sivid::vec<T, 2> const& x, sivid::vec<T, 1> const& c,
                          sivid::vec<T, 0> const&) const {
        return {-(0.5 * c[0] * x[0]), -x[1]};
    }
    template <class T>
    sivid::vec<T, 1> observe(T const&, sivid::vec<T, 2> const& x, sivid::vec<T, 1> const&,
                             sivid::vec<T, 0> const&) const {
        return {x[0]};
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
    CHECK_NOTHROW(t.predicted(t.result.read()));
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
    stored.rows = {{t.problem.prior, sivid::box_verdict::inside}};
    stored.products->rows = {{{sivid::interval(0.125, 2.0)}, sivid::box_verdict::inside}};
    io_support::adapt(t.problem, stored);
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
    stored.products->rows.push_back({{sivid::interval(0.8, 0.9)}, sivid::box_verdict::undecided});
    io_support::adapt(t.problem, stored);
    auto const holds = [&] {
        auto const p = t.predicted(stored);
        return std::any_of(p->problem.sets.begin(), p->problem.sets.end(),
                           [](sivid::box const& x) { return contains(x, std::vector{0.85}); });
    };
    CHECK(holds());
    // The measurements refute that box, so that it violates nothing.
    CHECK(t.verified("x at 1 > 1", stored).answer == answer::proved);
    // What is said to be excluded does not.
    stored.products->rows.back().verdict = sivid::box_verdict::outside;
    io_support::adapt(t.problem, stored);
    CHECK_FALSE(holds());
    CHECK(t.verified("x at 1 > 1", stored).answer == answer::proved);
}

TEST_CASE("undecided boxes count where the measurements are not heard") {
    prepared t;
    auto stored = t.result.read();
    stored.products->rows.push_back({{sivid::interval(0.8, 0.9)}, sivid::box_verdict::undecided});
    io_support::adapt(t.problem, stored);
    auto model = t.problem.model;
    auto const what = sivid::parse_requirement("x at 1 > 1", model, 1);
    auto const p = sivid::predict_from(t.problem, stored, model, what.margins, prepared::request(),
                                       "result.json");
    REQUIRE(p->problem.measured);
    CHECK(sivid::verify(p->problem, what, p->feasible, {.seconds = 2}).answer == answer::proved);
    auto deaf = p->problem;
    deaf.measured = nullptr;
    CHECK(sivid::verify(deaf, what, p->feasible, {.seconds = 2}).answer == answer::open);
    CHECK(sivid::predict(deaf).channels[0].low.back() <= 2 * std::exp(-0.9));
    // Without a witness that is proved the measurements say nothing: no parameter may meet them.
    stored.witness.reset();
    io_support::adapt(t.problem, stored);
    auto const q = t.predicted(stored);
    REQUIRE(q->problem.measured);
    CHECK(q->problem.measured(q->problem.around(), nullptr).known.empty());
    CHECK(sivid::predict(q->problem).channels[0].low.back() <= 2 * std::exp(-0.9));
}

TEST_CASE("tubes hold every motion that the data allow whatever narrows them") {
    auto const spoilt = GENERATE(false, true);
    CAPTURE(spoilt);
    prepared t;
    t.problem = io_support::two_rates_problem(spoilt);
    if (spoilt) { // an experiment that may not have outliers besides
        auto second = io_support::two_rates_problem().experiments[0];
        second.name = "second";
        t.problem.experiments.push_back(second);
    }
    stored_result const stored(t.problem);
    auto r = prepared::request(3);
    auto const set = GENERATE(false, true); // a start that is known less well than in the data
    CAPTURE(set);
    if (set) r.initial = {sivid::interval(1.5, 2.5)};
    auto const p = t.predicted(stored.read(), r);
    REQUIRE(p->in_products);
    REQUIRE(p->problem.measured);
    auto const tube = sivid::predict(p->problem);
    REQUIRE(tube.complete);
    auto deaf = p->problem;
    deaf.measured = nullptr;
    auto const wider = sivid::predict(deaf);
    // What all samples allow: |2 exp(-q t) - 2 exp(-t/2)| <= 0.05, less what rounding does here.
    double least = HUGE_VAL, most = 0;
    for (double q = 0.3; q < 0.8; q += 1e-4) {
        bool feasible = true;
        for (int k = 1; k <= 6; ++k) {
            double const s = 0.5 * k;
            feasible =
                feasible && std::abs(2 * std::exp(-q * s) - 2 * std::exp(-0.5 * s)) <= 0.05 - 1e-12;
        }
        if (!feasible) continue;
        least = std::min(least, q);
        most = std::max(most, q);
    }
    REQUIRE(least < most);
    for (std::size_t k = 0; k < tube.times.size(); ++k) {
        double const s = tube.times[k];
        auto const& low = tube.channels[0].low[2 * k];
        auto const& high = tube.channels[0].high[2 * k];
        CAPTURE(s, low, high);
        CHECK(low <= r.initial[0].lower() * std::exp(-most * s));
        CHECK(high >= r.initial[0].upper() * std::exp(-least * s));
        CHECK(low >= wider.channels[0].low[2 * k]);
        CHECK(high <= wider.channels[0].high[2 * k]);
    }
    double const reached =
        r.initial[0].upper() * std::exp(-least) - r.initial[0].lower() * std::exp(-most);
    auto const one = static_cast<std::size_t>(
        std::find_if(tube.times.begin(), tube.times.end(), [](double s) { return s >= 1 - 1e-9; }) -
        tube.times.begin());
    CHECK(tube.channels[0].high[2 * one] - tube.channels[0].low[2 * one] <= 1.05 * reached);
}

TEST_CASE("without a parameter there is nothing to say") {
    prepared t;
    auto stored = t.result.read();
    stored.verdict = sivid::verdict::inconsistent;
    stored.witness.reset();
    stored.rows.clear();
    stored.products.reset();
    io_support::adapt(t.problem, stored);
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
    auto other = stored.read();
    CHECK_THROWS_WITH(
        sivid::predict_from(strict, other, model, what.margins, prepared::request(), "result.json"),
        ContainsSubstring("not the problem"));
    other.problem = sivid::problem_digest(strict);
    io_support::adapt(strict, other);
    auto const p =
        sivid::predict_from(strict, other, model, what.margins, prepared::request(), "result.json");
    CHECK(sivid::verify(p->problem, what, p->feasible, {.seconds = 2}).answer == answer::open);
}

TEST_CASE("a result of another problem is refused, and one that does not say of which") {
    prepared const t;
    auto const stored = t.result.read();
    CHECK(stored.problem == sivid::problem_digest(t.problem));
    auto const refused = [&](auto const& change) {
        auto other = t;
        change(other.problem);
        CHECK_THROWS_WITH(other.predicted(stored), ContainsSubstring("not the problem"));
    };
    refused([](auto& p) { p.model.rate[0] = p.model.g.neg(p.model.rate[0]); });
    refused([](auto& p) { p.model.observe[0] = p.model.g.constant(1.0); });
    refused([](auto& p) { p.prior[0] = sivid::interval(0.5, 3.0); });
    refused([](auto& p) { p.experiments[0].outliers = 3; });
    refused([](auto& p) { p.experiments[0].measurements[1].bound = sivid::interval(0.0, 9.0); });
    auto silent = stored;
    silent.problem.clear();
    CHECK_THROWS_WITH(t.predicted(silent), ContainsSubstring("earlier version"));
    silent = stored;
    std::erase_if(silent.stated, [](auto const& s) { return s.first.starts_with("/files"); });
    CHECK_THROWS_WITH(t.predicted(silent), ContainsSubstring("SHA-256"));
    silent = stored;
    silent.assumptions = {"inputs as they please"};
    CHECK_THROWS_WITH(t.predicted(silent), ContainsSubstring("inputs exact"));
}

TEST_CASE("products that were cut to what suits are refused") {
    prepared const t;
    auto const good = t.result.read();
    CHECK(t.verified("x at 1 < 1.2", good).answer == answer::refuted);
    auto cut = good; // what is left, all with a b > 0.512, says that it holds
    std::erase_if(cut.products->rows, [](auto const& row) { return row.set[0].lower() < 0.512; });
    REQUIRE_FALSE(cut.products->rows.empty());
    CHECK_THROWS_WITH(t.verified("x at 1 < 1.2", cut), ContainsSubstring("contradicts itself"));
    auto const before = cut.stated;
    io_support::adapt(t.problem, cut);
    cut.stated["/combinations/0/hull/0"] = before.at("/combinations/0/hull/0");
    CHECK_THROWS_WITH(t.verified("x at 1 < 1.2", cut), ContainsSubstring("contradicts itself"));
    io_support::adapt(t.problem, cut);
    CHECK_THROWS_WITH(t.verified("x at 1 < 1.2", cut), ContainsSubstring("contradicts itself"));
    auto far = good;
    far.witness->parameters["a"] = 0.5;
    far.witness->parameters["b"] = 0.25;
    CHECK_THROWS_WITH(t.predicted(far), ContainsSubstring("witness"));
}

TEST_CASE("boxes that were cut to what suits are refused") {
    prepared t;
    t.problem = io_support::one_rate_problem();
    stored_result const stored(t.problem);
    auto cut = stored.read();
    CHECK_NOTHROW(t.predicted(cut));
    auto far = cut;
    far.witness->parameters["a"] = 1.9;
    CHECK_THROWS_WITH(t.predicted(far), ContainsSubstring("the witness lies in no box"));
    cut.rows.erase(cut.rows.begin());
    CHECK_THROWS_WITH(t.predicted(cut), ContainsSubstring("contradicts itself"));
}

TEST_CASE("a budget of outliers is an assumption, and not for all measurements") {
    prepared t;
    auto stored = t.result.read();
    t.problem.experiments[0].outliers = 2; // of six; the result's own problem allowed none
    stored.problem = sivid::problem_digest(t.problem);
    io_support::adapt(t.problem, stored);
    auto r = prepared::request();
    r.stated_outliers["run"] = 0;
    auto model = t.problem.model;
    auto const what = sivid::parse_requirement("x at 1 > 1.22", model, 1);
    auto const p = sivid::predict_from(t.problem, stored, model, what.margins, r, "result.json");
    CHECK(names(p->assumptions, "at most 2 of 6 measurements of run may violate their bounds (the "
                                "result's budget; the data set says 0)"));
    CHECK_THAT(p->feasible_with, ContainsSubstring("2 of 6"));
    auto const found = sivid::verify(p->problem, what, p->feasible, {.seconds = 5});
    REQUIRE(found.witness);
    CHECK_THAT(sivid::verification_json(*p, what, found, {}), ContainsSubstring("2 of 6"));
    t.problem.experiments[0].outliers = 6;
    stored.problem = sivid::problem_digest(t.problem);
    CHECK_THROWS_WITH(t.predicted(stored), ContainsSubstring("nothing is known"));
    prepared const strict; // nothing to say where none is allowed
    CHECK_FALSE(names(strict.predicted(strict.result.read())->assumptions, "violate"));
}

TEST_CASE("a start that follows a parameter is never paired with another one") {
    prepared t;
    auto const one = io_support::one_rate_problem();
    t.problem = one;
    t.problem.model = sivid::record_model<begins_at_a>();
    auto& m = t.problem.model;
    m.added_states.push_back({1, m.g.leaf(sivid::operation::constant, 0)});
    t.problem.experiments[0].initial = {sivid::interval(2.0), sivid::interval(1.0)};
    stored_result const result(t.problem);
    auto r = prepared::request();
    r.initial = {sivid::interval(2.0), t.problem.prior[0]}; // s begins at a, in [0.5, 2]
    // Where s begins at a this holds; for s = 0.5 and a = 1 it does not.
    CHECK(t.verified("(s - a) at 0 > -0.1", result.read(), r).answer == answer::open);
    CHECK(t.verified("s at 0 in [0.49, 2.01]", result.read(), r).answer == answer::proved);
    auto const p = t.predicted(result.read(), r);
    CHECK(p->starts_follow);
    CHECK(names(p->assumptions, "nothing is refuted"));
    // In the data as in the scenario.
    auto free = t;
    free.problem.experiments[0].initial = r.initial;
    stored_result const wide(free.problem);
    r.initial = t.problem.experiments[0].initial;
    CHECK(free.predicted(wide.read(), r)->starts_follow);
    // A start that is one decimal, for all parameters, is no obstacle.
    r.initial = {sivid::interval(2.0), sivid::interval(0.1, std::nextafter(0.1, 1.0))};
    CHECK_FALSE(t.predicted(result.read(), r)->starts_follow);
    CHECK(t.verified("(s - a) at 0 > -0.1", result.read(), r).answer == answer::refuted);
}

TEST_CASE("what a set constant does to a derived one is said") {
    prepared t;
    t.problem = io_support::one_rate_problem();
    auto& m = t.problem.model; // b = a/2, unless it is set
    m.derived.push_back({1, m.g.mul(m.g.constant(0.5), m.g.leaf(sivid::operation::constant, 0))});
    m.about.constants[1].formula = "a/2";
    stored_result const result(t.problem);
    CHECK(names(t.predicted(result.read())->assumptions, "b follows from the others: b = a/2"));
    auto r = prepared::request();
    r.set["b"] = sivid::interval(0.5);
    auto const p = t.predicted(result.read(), r);
    CHECK(names(p->assumptions, "b is taken as it is stated, whatever the model's b = a/2"));
    for (auto const& line : p->assumptions) CHECK(line.back() != '.');
}

TEST_CASE("what is reached is not said of products that no parameter reaches") {
    using support::between;
    auto const problem =
        support::with_shared_factor(between(1, 1.2), between(0.5, 5), between(0.5, 5));
    stored_result const stored(problem, sivid::identify(problem, {}));
    sivid::prediction_request request;
    request.initial = {sivid::interval(1.0)};
    request.end = 1;
    auto model = problem.model;
    auto const goal = sivid::parse_goal("p0 / p2", model); // in [1 / 1.2, 1.2]
    auto const p =
        sivid::predict_from(problem, stored.read(), model, {goal.value}, request, "result.json");
    REQUIRE(p->in_products);
    REQUIRE(p->problem.reached.has_value());
    REQUIRE_FALSE(p->problem.reached->empty());
    for (auto const& r : *p->problem.reached) // p0 p1 and p1 p2 have a ratio of p0 / p2
        for (double const share : {0.0, 0.5, 1.0})
            for (double const other : {0.0, 0.5, 1.0}) {
                double const w = r[0].lower() + share * width(r[0]);
                double const z = r[1].lower() + other * width(r[1]);
                CHECK(std::max(w, z) <= 1.2 * std::min(w, z) * (1 + 1e-12));
            }
    CHECK(sivid::predict(p->problem).excess > 1e300);
    // (1, 1, 1.2) and (1.2, 1, 1) explain the same data where errors are 0.11: nothing is told.
    auto const promised = sivid::promise_widths(
        p->problem, sivid::planned_measurements::every(1, 1, {0.11, 0.11}), {goal.value});
    CHECK(promised.goals[0].before <= 1.2 - 1 / 1.2);
    CHECK(promised.goals[0].before > 0.5 * (1.2 - 1 / 1.2));
    CHECK(promised.goals[0].after >= 1.2 - 1 / 1.2);
    CHECK(promised.goals[0].factor() == 1);
}
