// SPDX-License-Identifier: MIT
#include <sivid/approximate/place/detail/place_fit.hpp>

#include "support/catch.hpp"
#include "support/hovercraft_campaign.hpp"

using namespace sivid;
using support::draws;

TEST_CASE("a missing rate is found where it acts, with its uncertainty") {
    draws d(911);
    support::hover_effect pull;
    pull.rates = [](double t, auto const&, auto const&, auto const&, support::motion& rate) {
        rate[1] += 0.6 * std::sin(t);
    };
    auto const problem = support::hovercraft_campaign(d, pull, {});
    place_fitter fit(problem, places_of(problem.model, std::vector<bool>(6, true), {true, true}));
    fit.set_scales(std::vector<missing_rate_scale>(8, {4, 3}));
    auto base = mid(problem.prior);
    std::vector<std::vector<double>> starts;
    for (auto const& e : problem.experiments) starts.push_back(mid(e.initial));
    auto const from = fit.plain(base, starts);
    auto const none = fit({}, from);
    auto const surge = fit({0}, from);
    auto const sway = fit({1}, from);
    CHECK(none.inflation > 3);
    CHECK(surge.inflation > 3);
    CHECK(sway.inflation < 1);
    CHECK(sway.score < surge.score);
    CHECK(sway.cost == 1);
    CHECK(sway.freedom > 20);
    double worst = 0;
    for (std::size_t e = 0; e < 5; ++e) {
        auto const& knots = fit.simulations().knots(e);
        REQUIRE(sway.state.missing[e][1].size() == knots.size());
        CHECK(sway.state.missing[e][0].empty());
        for (std::size_t k = 0; k < knots.size(); ++k) {
            double const miss = sway.state.missing[e][1][k] - 0.6 * std::sin(knots[k]);
            CHECK(sway.deviation[e][1][k] > 0);
            worst = std::max(worst, std::abs(miss) / sway.deviation[e][1][k]);
        }
    }
    CHECK(worst < 4);
    // The state of one set starts another.
    fit.release({1});
    auto const z = fit.vector_of(sway.state);
    auto const again = fit.state_of(z);
    CHECK(again.missing == sway.state.missing);
    CHECK(again.parameters == sway.state.parameters);
}
