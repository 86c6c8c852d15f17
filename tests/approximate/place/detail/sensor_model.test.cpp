// SPDX-License-Identifier: MIT
#include <sivid/approximate/place/detail/sensor_model.hpp>

#include "support/catch.hpp"
#include "support/hovercraft_campaign.hpp"

#include <sivid/approximate/fit/fit.hpp>

using namespace sivid;
using support::draws;

TEST_CASE("faulty sensors have neutral faults and explain their data") {
    draws d(901);
    support::hover_effect biased;
    biased.sensors = [](double t, auto const& at) {
        auto y = at(t);
        y[2] += 0.2;
        return y;
    };
    auto const problem = support::hovercraft_campaign(d, biased, {.share = 0.5});
    auto const places = places_of(problem.model, std::vector<bool>(6, true), {true, true});
    auto const extended = with_sensor_faults(problem, places, 0.5);
    CHECK(extended.original == 3);
    CHECK(extended.faults[0].empty());
    CHECK(extended.faults[10].size() == 3); // the gyro: scale, latency, offset
    CHECK(extended.faults[11].size() == 4); // the position: two offsets
    CHECK(extended.faults[13].size() == 2); // u and v askew
    CHECK(extended.problem.prior.size() == 3 + 4 * 3 + 4 + 2 * 2);
    CHECK(extended.problem.model.channel_delays.size() == 6);
    approximate_fitter fit(extended.problem);
    std::vector<double> neutral(extended.problem.prior.size(), 0.0);
    auto const plain = approximate_fitter(problem)({mid(problem.prior)});
    std::copy(plain.parameters.begin(), plain.parameters.end(), neutral.begin());
    CHECK_THAT(fit.at(neutral, plain.starts).inflation, WithinAbs(plain.inflation, 1e-3));
    CHECK(plain.inflation > 1);
    auto const offset = extended.faults[10].back();
    auto only = extended.problem;
    for (std::size_t j = 3; j < only.prior.size(); ++j) {
        if (j != offset) only.prior[j] = interval(0.0);
    }
    auto const found = approximate_fitter(only)();
    CHECK(found.inflation < 1);
    CHECK_THAT(found.parameters[offset], WithinAbs(0.2, 0.03));
}
