// SPDX-License-Identifier: MIT
// What no catalogue has: laws of a missing rate.
#include <sivid/diagnosis/candidate/detail/proposed_faults.hpp>
#include <sivid/diagnosis/claim/detail/diagnosis_consistency.hpp>
#include <sivid/diagnosis/diagnose.hpp>

#include "diagnosis/small_catalogue.hpp"
#include "support/catch.hpp"

#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

using namespace sivid;

namespace {

using missing = std::function<double(double t, double v, double u)>;

/// With a slope, a scale and a delay in the catalogue, no drag.
/// @param resting  so many further experiments in which nothing moves
diagnosis_run diagnosed(missing const& what, std::size_t resting = 0) {
    small_campaign::truth real;
    real.missing = what;
    auto catalogue = small_campaign::catalogue();
    catalogue.erase(catalogue.begin());
    diagnosis_options options;
    options.seconds = 60; // a slow machine needs them
    options.hulls.boxes = 200;
    auto problem = small_campaign::problem(real);
    for (std::size_t e = 0; e < resting; ++e) {
        auto& still = problem.experiments.emplace_back(small_campaign::experiment(0, {}));
        still.name = "R" + std::to_string(e + 1);
        still.inputs = {sampled_signal({0.0, 4.0}, {0.0, 0.0}, interpolation::linear)};
        for (auto& m : still.measurements) m.bound = interval(-0.02, 0.02);
    }
    auto result = diagnose(problem, std::move(catalogue), options);
    for (auto const& c : find_contradictions(result.result)) FAIL_CHECK(c.claim + ": " + c.reason);
    judge_by_holdout(result, holdout({small_campaign::experiment(2, real)}));
    return result;
}
/// Explained by terms, with proof, on held-out data, too.
void explained(diagnosis const& d) {
    CHECK(d.gap == gap_verdict::certified);
    REQUIRE(d.answer == answer_kind::effects);
    REQUIRE_FALSE(d.causes.empty());
    auto const& c = d.causes.front();
    CHECK(c.verdict == cause_verdict::explains);
    REQUIRE(c.holdout);
    CHECK(c.holdout->inflation_after.upper() < 1.2);
    CHECK(c.holdout->inflation_before.lower() > 2 * c.holdout->inflation_after.upper());
}
std::string joined(std::vector<std::string> const& names) {
    std::string all;
    for (auto const& n : names) all += (all.empty() ? "" : " ") + n;
    return all;
}

} // namespace

TEST_CASE("a law that no catalogue has is found and its size bounded with proof") {
    auto const d = diagnosed([](double, double v, double) { return -0.5 * v * v * v; }).result;
    INFO(joined(d.effects));
    explained(d);
    CHECK_THAT(joined(d.effects), ContainsSubstring("v'~") && ContainsSubstring("*v^3"));
    bool bounded = false;
    for (auto const& c : d.constants) {
        if (!c.name.starts_with("v'~") || !c.hull) continue;
        double const size = std::stod(c.name.substr(3));
        CAPTURE(c.name, c.hull->lower(), c.hull->upper());
        CHECK(size * c.hull->lower() <= -0.5);
        CHECK(-0.5 <= size * c.hull->upper());
        CHECK(width(*c.hull) < 0.4);
        bounded = true;
    }
    CHECK(bounded);
}

TEST_CASE("a product of third degree is found, and not answered by another shape") {
    auto const run = diagnosed([](double, double v, double u) { return -0.8 * v * v * u; });
    INFO(joined(run.result.effects));
    explained(run.result);
    CHECK_THAT(joined(run.result.effects), ContainsSubstring("v'~") && ContainsSubstring("*u*v^2"));
    for (auto const& w : run.result.where)
        if (w.kind == "equation") CHECK(w.law == "u*v^2");
}

TEST_CASE("a law is found though experiments that rest do not show it") {
    auto const d = diagnosed([](double, double v, double) { return -0.5 * v * v * v; }, 2).result;
    INFO(joined(d.effects));
    CHECK_FALSE(d.confined.empty()); // E1 and E2 stand alone
    explained(d);
    CHECK_THAT(joined(d.effects), ContainsSubstring("v'~") && ContainsSubstring("*v^3"));
}

TEST_CASE("a rate that swings is found with its frequency") {
    auto const d = diagnosed([](double t, double, double) { return 0.6 * std::sin(4 * t); }).result;
    INFO(joined(d.effects));
    explained(d);
    CHECK_THAT(joined(d.effects), ContainsSubstring("wave("));
}

TEST_CASE("two laws together are found") {
    auto const d = diagnosed([](double t, double v, double) {
                       return -0.4 * v * v * v + 0.5 * std::cos(5 * t);
                   }).result;
    INFO(joined(d.effects));
    explained(d);
    CHECK(d.effects.size() == 2);
}

TEST_CASE("a term that cannot be read is no candidate") {
    place_estimate estimate;
    estimated_place v;
    v.kind = place_kind::equation;
    v.terms = {"v'~2*speed of sound", "v'~4e+02*v", "v'~2*v dot"}; // names of a model may be any
    estimate.places = {v};
    auto const terms = proposed_terms(estimate);
    REQUIRE(terms.size() == 1);
    CHECK(terms[0].name == "v'~4e+02*v");
}

TEST_CASE("no law is named where nothing is missing, or nothing that has one") {
    CHECK(diagnosed([](double, double, double) { return 0.0; }).result.answer == answer_kind::none);
    // Another push every tenth of a second.
    auto const d = diagnosed([](double t, double, double) {
                       auto const k = static_cast<int>(10 * t);
                       return (k * 7919 + 31) % 13 < 6 ? 2.0 : -2.0;
                   }).result;
    INFO(joined(d.effects));
    CHECK(d.answer == answer_kind::unexplained);
}
