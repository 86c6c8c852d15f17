// SPDX-License-Identifier: MIT
#include <sivid/approximate/place/detail/place_search.hpp>

#include "support/catch.hpp"
#include "support/hovercraft_campaign.hpp"

using namespace sivid;
using support::draws;

TEST_CASE("the smallest set of places is chosen and its members are ranked") {
    draws d(921);
    support::hover_effect two;
    two.rates = [](double, support::motion const& x, auto const&, auto const&,
                   support::motion& rate) {
        rate[0] -= 0.3 * x[0];
        rate[2] -= 0.5 * std::abs(x[2]) * x[2];
    };
    auto const problem = support::hovercraft_campaign(d, two, {.share = 0.6});
    place_fitter fit(problem, places_of(problem.model, std::vector<bool>(6, true), {true, true}));
    fit.set_scales(std::vector<missing_rate_scale>(8, {4, 3}));
    std::vector<std::vector<double>> starts;
    for (auto const& e : problem.experiments) starts.push_back(mid(e.initial));
    auto const base = fit.plain(mid(problem.prior), starts);
    place_search search(fit, base);
    search.run();
    CHECK(search.best().set == std::vector<std::size_t>{0, 2});
    CHECK(search.best().inflation <= 1);
    REQUIRE(search.ranking().size() == 2);
    CHECK(search.ranking()[0].second >= search.ranking()[1].second);
    CHECK(search.ranking()[1].second > 100);
    CHECK(search.tried().size() > 14);
    CHECK(search.alternatives().empty());

    int asked = 0;
    place_search_options stopped;
    stopped.go_on = [&asked] { return ++asked <= 3; };
    place_search few(fit, base, stopped);
    few.run();
    CHECK(asked == 4);
    CHECK(few.tried().size() > 1);
    CHECK(few.tried().size() <= 4);
    CHECK(few.best().score <= few.tried().front().score);
}
