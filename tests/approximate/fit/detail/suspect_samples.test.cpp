// SPDX-License-Identifier: MIT
#include <sivid/approximate/fit/detail/suspect_samples.hpp>

#include "support/catch.hpp"
#include "support/hovercraft_campaign.hpp"

using namespace sivid;
using support::draws;

TEST_CASE("gross outliers stand out from their neighbours, within the budget") {
    draws d(884);
    auto problem = support::hovercraft_campaign(d, {}, {});
    auto const clean = without_suspects(approximate_campaign(problem));
    for (auto const& e : clean) CHECK(std::count(e.begin(), e.end(), 0.0) == 0);
    for (auto& e : problem.experiments) e.measurements = sorted(e.measurements);
    auto& samples = problem.experiments[3].measurements;
    for (std::size_t const k : {30u, 77u, 200u}) {
        samples[k].bound = support::around(mid(samples[k].bound) + 30 * rad(samples[k].bound),
                                           rad(samples[k].bound));
    }
    CHECK(without_suspects(approximate_campaign(problem)) == clean); // no budget, no suspects
    problem.experiments[3].outliers = 3;
    auto const kept = without_suspects(approximate_campaign(problem))[3];
    CHECK(std::count(kept.begin(), kept.end(), 0.0) == 3);
    for (std::size_t const k : {30u, 77u, 200u}) CHECK(kept[k] == 0);
}
