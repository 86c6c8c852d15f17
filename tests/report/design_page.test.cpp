// SPDX-License-Identifier: MIT
#include "report/well_formed.hpp"
#include "support/catch.hpp"

#include "decision/planar_models.hpp"

#include <sivid/report/decision_page.hpp>

#include <memory>
#include <string>
#include <vector>

using namespace sivid::report;
using namespace sivid_tests;
using namespace decision_support;

namespace {

/// x0' = u0 - p0 x0: the page of an experiment for p0.
struct designed {
    std::unique_ptr<sivid::stored_prediction> about = std::make_unique<sivid::stored_prediction>();
    sivid::design_answer answer{};

    explicit designed(std::string const& limits, double target = 0.5) {
        auto& p = about->problem;
        p.model = support::model_of(
            {.states = 1, .constants = 1, .inputs = 1},
            [](auto const&, auto const& x, auto const& c, auto const& u) {
                return std::vector{u[0] - c[0] * x[0]};
            },
            [](auto const&, auto const& x, auto const&, auto const&) { return x; });
        p.model.about.inputs[0].name = "u<";
        p.choice.unknown = {"p0"};
        p.sets = {{between(0.4, 0.6)}};
        p.inputs = {sivid::sampled_signal({0.0}, {0.0}, sivid::interpolation::hold)};
        p.initial = {sivid::interval(0.0)};
        p.end = 2;
        about->sides = {"p0"};
        answer.target = target;
        answer.limits = limits;
        answer.goals = {sivid::parse_goal("p0", p.model)};
        answer.plan = sivid::planned_measurements::every(0.5, 2, {0.01});
        answer.varied = {{0, "u<", "N", -1, 1}};
        sivid::requirement what;
        if (!limits.empty()) what = sivid::parse_requirement(limits, p.model, p.end);
        answer.found = sivid::design_experiment(
            p, sivid::manoeuvre_shapes(answer.varied, p.inputs, {0}, p.end, "s"), answer.plan,
            answer.goals, limits.empty() ? nullptr : &what, {.seconds = 60, .pairs = 10});
        if (auto const* best = answer.found.best()) p.inputs = best->inputs;
        about->direct = p;
    }
    [[nodiscard]] std::string page() const {
        decision_page_options o;
        o.dataset = "d";
        o.scenario = "S & T";
        auto const tubes = sivid::predict(about->problem, {.cells = 10});
        return design_page(*about, answer, tubes, o).html;
    }
};

} // namespace

TEST_CASE("a page shows the experiment, its promise and what else was tried") {
    designed const d("");
    auto const text = d.page();
    CHECK(markup_error(body_of(text)) == "");
    CHECK(d.answer.met());
    CHECK_THAT(text, ContainsSubstring("An experiment for p0 is found"));
    CHECK_THAT(text, ContainsSubstring("Whatever the truth and the errors are"));
    CHECK_THAT(text, ContainsSubstring("What was tried"));
    CHECK_THAT(text, ContainsSubstring("u&lt;"));
}

TEST_CASE("a page says what is left of the volume") {
    designed d("");
    d.answer.jointly = true;
    auto const text = d.page();
    CHECK(markup_error(body_of(text)) == "");
    CHECK(d.answer.met());
    CHECK_THAT(text, ContainsSubstring("An experiment for the volume in p0 is found") &&
                         ContainsSubstring("of the volume of now (proved)"));
    d.answer.target = 0;
    CHECK(!d.answer.met());
}

TEST_CASE("a page says what is not promised, or hidden") {
    designed const less("always(abs(x0) < 0.3)", 1e-6);
    REQUIRE(less.answer.found.best() != nullptr);
    CHECK_THAT(less.page(), ContainsSubstring("which promises less than was asked"));
    designed const none("always(x0 > 3)");
    CHECK_THAT(none.page(), ContainsSubstring("give wider limits"));
    designed hidden("");
    hidden.answer.found = {};
    hidden.answer.hidden = "p0";
    hidden.answer.instead = {"p0*p1", "p0/p2"};
    auto const text = hidden.page();
    CHECK(markup_error(body_of(text)) == "");
    CHECK_THAT(text, !ContainsSubstring("No experiment tells p0"));
    CHECK_THAT(text, ContainsSubstring("What can be told: p0*p1, p0/p2. Data narrow it no further "
                                       "than the others are known."));
    hidden.answer.impossible = true;
    CHECK_THAT(hidden.page(), ContainsSubstring("No experiment tells p0") &&
                                  ContainsSubstring("Whatever is measured, it keeps more than"));
}

TEST_CASE("a page says whether two models are told apart") {
    designed d("");
    d.answer.goals.clear();
    d.answer.first = "wind";
    d.answer.second = "payload & more";
    d.answer.found.tried.resize(1);
    d.answer.found.tried[0].promised = sivid::promise{};
    CHECK_THAT(d.page(), ContainsSubstring("No proved experiment that tells wind from payload"));
    d.answer.found.tried[0].promised->told_apart = true;
    auto const text = d.page();
    CHECK(markup_error(body_of(text)) == "");
    CHECK_THAT(text, ContainsSubstring("An experiment that tells wind from payload &amp; more") &&
                         ContainsSubstring("refute all of wind or all of payload") &&
                         ContainsSubstring("told apart"));
}
