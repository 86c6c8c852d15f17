// SPDX-License-Identifier: MIT
#include <sivid/approximate/place/detail/law_search.hpp>

#include "support/catch.hpp"
#include "support/hovercraft_campaign.hpp"

using namespace sivid;
using support::draws;

TEST_CASE("the law behind a missing rate comes first") {
    struct planted {
        std::size_t equation;
        std::string text;
        decltype(support::hover_effect::rates) rates;
    };
    std::vector<planted> const list{
        {0, "u",
         [](double, support::motion const& x, auto const&, auto const&, support::motion& rate) {
             rate[0] -= 0.3 * x[0];
         }},
        {2, "abs(r)*r",
         [](double, support::motion const& x, auto const&, auto const&, support::motion& rate) {
             rate[2] -= 1.5 * std::abs(x[2]) * x[2];
         }},
        {2, "u^2*r",
         [](double, support::motion const& x, auto const&, auto const&, support::motion& rate) {
             rate[2] -= 0.6 * x[0] * x[0] * x[2];
         }},
        {2, "W^2",
         [](double, auto const&, support::controls const& u, auto const&, support::motion& rate) {
             rate[2] += 2e-5 * u[0] * u[0];
         }}};
    draws d(931);
    for (auto const& p : list) {
        support::hover_effect effect;
        effect.rates = p.rates;
        auto const problem = support::hovercraft_campaign(d, effect, {});
        place_fitter fit(problem,
                         places_of(problem.model, std::vector<bool>(6, true), {true, true}));
        fit.set_scales(std::vector<missing_rate_scale>(8, {4, 3}));
        std::vector<std::vector<double>> starts;
        for (auto const& e : problem.experiments) starts.push_back(mid(e.initial));
        auto const best = fit({p.equation}, fit.plain(mid(problem.prior), starts));
        CHECK(best.inflation < 1.001);
        law_search search(fit, best);
        REQUIRE(search.valid());
        law_library const library(problem.model, search.traces());
        auto const laws = library.for_rates();
        auto const ranked = search.for_target(0, laws);
        REQUIRE(ranked.size() > 40);
        CHECK(laws[ranked.front().index].text == p.text);
        CHECK(ranked.front().share > 0.95);
        CHECK(ranked.front().squares < 0.5 * ranked[5].squares);
    }
}
