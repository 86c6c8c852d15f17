// SPDX-License-Identifier: MIT
#include "report/well_formed.hpp"
#include "support/catch.hpp"

#include "decision/planar_models.hpp"

#include <sivid/report/decision_page.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

using namespace sivid::report;
using namespace sivid_tests;
using namespace decision_support;

namespace {

/// x0' = K - p0 x0 from 0: the page of the gains K (and of Q, which does nothing, if wanted).
struct asked {
    std::unique_ptr<sivid::stored_prediction> about = std::make_unique<sivid::stored_prediction>();
    std::optional<sivid::gain_set> result{};

    std::string page(std::string const& text, std::size_t gains, double seconds) {
        sivid::prediction_problem p;
        p.model = support::model_of(
            {.states = 1, .constants = 3},
            [](auto const&, auto const& x, auto const& c, auto const&) {
                return std::vector{c[1] + 0.1 * c[2] - c[0] * x[0]};
            },
            [](auto const&, auto const& x, auto const&, auto const&) { return x; });
        p.model.about.constants[1].name = "K";
        p.model.about.constants[2].name = "Q<";
        p.choice.unknown = {"p0", "K", "Q<"};
        p.choice.unknown.resize(1 + gains);
        p.sets = {{between(0.5, 0.6), between(0, 4)}};
        if (gains > 1) p.sets = {{between(0.5, 0.6), between(0, 4), between(0, 1)}};
        p.initial = {sivid::interval(0.0)};
        p.end = 1;
        auto const what = sivid::parse_requirement(text, p.model, p.end);
        std::vector<std::string> const names(p.choice.unknown.begin() + 1, p.choice.unknown.end());
        result = sivid::find_gains(p, names, what, all_feasible(p),
                                   {.motions = {.seconds = seconds}, .accuracy = 0.02});
        auto const& found = *result;
        about->problem = p;
        about->direct = p;
        about->sides = p.choice.unknown;
        decision_page_options o;
        o.dataset = "d";
        o.scenario = "S";
        o.law = "u0 = K & more";
        if (!found.suggested) return control_page(*about, what, found, {}, {}, o).html;
        about->problem = sivid::with_gains(p, names, *found.suggested);
        auto const proof = sivid::verify(about->problem, what, all_feasible(about->problem));
        auto const tubes = sivid::predict(about->problem, {.cells = 10}, what.margins);
        return control_page(*about, what, found, proof, tubes, o).html;
    }
};

} // namespace

TEST_CASE("a page of one gain tells its ranges") {
    asked a;
    auto const page = a.page("x0 at end in [1, 2]", 1, 2);
    CHECK(markup_error(body_of(page)) == "");
    CHECK_THAT(page, ContainsSubstring("Gains are proved") &&
                         ContainsSubstring("u0 = K &amp; more") &&
                         ContainsSubstring(">violated<") && ContainsSubstring(">proved<") &&
                         ContainsSubstring("What excludes gains") &&
                         ContainsSubstring("The requirement against the tube"));
}

TEST_CASE("ranges of a gain are rounded so that what is said holds all over them") {
    asked a;
    static_cast<void>(a.page("x0 at end in [1, 2]", 1, 0));
    auto found = *a.result;
    double const first = 0.7070770263671875, second = 0.7071533203125;
    sivid::subpaving paving(sivid::box{between(0, 1)});
    paving.add({between(0, first)}, sivid::box_verdict::outside);
    paving.add({between(first, second)}, sivid::box_verdict::undecided);
    paving.add({between(second, 1)}, sivid::box_verdict::inside);
    found.paving.paving = paving;
    auto const text =
        control_page(*a.about, {}, found, {}, {}, {.dataset = "d", .law = "u0 = K"}).html;
    CHECK_THAT(text, ContainsSubstring("[0.00000, 0.70707]") &&
                         ContainsSubstring("[0.70716, 1.00000]") &&
                         ContainsSubstring("[0.7070770, 0.7071534]"));
}

TEST_CASE("a page of two gains shows their paving") {
    asked a;
    auto const page = a.page("x0 at end in [1, 2]", 2, 2);
    CHECK(markup_error(body_of(page)) == "");
    CHECK_THAT(page, ContainsSubstring("<svg") && ContainsSubstring("proved for every parameter") &&
                         ContainsSubstring("violated by a parameter") &&
                         ContainsSubstring("Q&lt;") && !ContainsSubstring("explain the data"));
}

TEST_CASE("pages without gains say why") {
    asked none;
    auto const page = none.page("x0 at end > 9", 2, 2);
    CHECK(markup_error(body_of(page)) == "");
    CHECK_THAT(page, ContainsSubstring("No gain will do"));
    asked open;
    auto const early = open.page("x0 at end in [1, 2]", 2, 0);
    CHECK(markup_error(body_of(early)) == "");
    CHECK_THAT(early, ContainsSubstring("No gain is proved") &&
                          ContainsSubstring("time budget spent") &&
                          ContainsSubstring("No parameter is known that violates it"));
    CHECK_THAT(gain_sentence(*open.result), !ContainsSubstring("Proved"));
}
