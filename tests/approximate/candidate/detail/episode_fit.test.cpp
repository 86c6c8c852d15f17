// SPDX-License-Identifier: MIT
#include <sivid/approximate/candidate/detail/episode_fit.hpp>

#include "diagnosis/small_catalogue.hpp"
#include "support/catch.hpp"
#include "support/sweep.hpp"

#include <sivid/approximate/fit/fit.hpp>
#include <sivid/diagnosis/verification.hpp>
#include <sivid/model/affected_problem.hpp>
#include <sivid/model/effects.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <random>
#include <vector>

using namespace sivid;
using namespace sivid::literals;

namespace {

/// The cart with something missing from a time on, another one in each experiment.
identification_problem from_a_time_on(std::function<double(double v, double u)> const& missing,
                                      std::vector<double> const& onsets) {
    auto problem = small_campaign::problem();
    problem.experiments.clear();
    for (std::size_t e = 0; e < onsets.size(); ++e) {
        small_campaign::truth real;
        real.missing = [&missing, onset = onsets[e]](double t, double v, double u) {
            return t < onset ? 0 : missing(v, u);
        };
        problem.experiments.push_back(small_campaign::experiment(e, real));
    }
    return problem;
}
/// Looked for as a search does.
episode_fit looked_for(identification_problem const& problem, effect const& e) {
    auto const go_on = [] { return true; };
    auto const always = fit(affected(problem, {e}));
    episode_fit found(problem, e, always.parameters, {.begins = true, .ends = false}, go_on);
    found.look_roughly();
    found.look_closely();
    return found;
}

} // namespace

TEST_CASE("a saturation that begins later is found, though it sleeps in a fit of all the time") {
    auto const most = effects::input_saturation("most", "u", "N", {0.05_dec, 2_dec});
    std::mt19937 chance(20261126);
    std::uniform_real_distribution<double> sizes(0.3, 0.6), times(1.5, 3.2);
    for (int n = 0; n < 20; ++n) {
        double const size = sizes(chance);
        std::vector<double> onsets;
        for (int e = 0; e < 3; ++e) onsets.push_back(times(chance));
        if (!support::long_sweeps && n != 2 && n != 9) continue; // 9 was not found once
        auto const problem = from_a_time_on(
            [size](double, double u) { return std::clamp(u, -size, size) - u; }, onsets);
        auto const found = looked_for(problem, most);
        CAPTURE(n, size, onsets, found.fit().inflation);
        REQUIRE(found.explains());
        CHECK(std::abs(found.fit().parameters[1] - size) < 0.1);
    }
}

TEST_CASE("onsets are fitted as closely as bounds ask that the truth nearly fills") {
    auto const slope = effects::constant_rate("slope", "v", "m/s^2", {-1_dec, 1_dec});
    std::mt19937 chance(7);
    std::uniform_real_distribution<double> times(0.4, 3);
    for (int n = 0; n < 20; ++n) {
        std::vector<double> onsets;
        for (int e = 0; e < 3; ++e) onsets.push_back(times(chance));
        if (!support::long_sweeps && n != 10 && n != 18) continue; // which were not once
        auto problem = from_a_time_on([](double, double) { return 0.5; }, onsets);
        // The deviations fill 60 % of the bounds: these are just as wide as they have to be.
        for (auto& x : problem.experiments) {
            for (auto& m : x.measurements) {
                double const middle = mid(m.bound), radius = 0.602 * rad(m.bound);
                m.bound = interval(middle - radius, middle + radius);
            }
        }
        auto const found = looked_for(problem, slope);
        CAPTURE(n, onsets, found.fit().inflation);
        REQUIRE(found.explains());
        auto const since = found.acting().since;
        REQUIRE(since.size() == 3);
        for (std::size_t e = 0; e < 3; ++e) CHECK(std::abs(since[e] - onsets[e]) < 0.1);
    }
}

TEST_CASE("what is remembered behind an input, or by a sensor, is found from a time on") {
    std::mt19937 chance(20261127);
    std::uniform_real_distribution<double> times(0.8, 2.8);
    for (int n = 0; n < support::swept(2, 12); ++n) {
        for (auto const& one : small_campaign::memories()) {
            small_campaign::truth real;
            real.*one.size = std::uniform_real_distribution<double>(one.least, one.most)(chance);
            std::vector<double> onsets;
            for (int e = 0; e < 3; ++e) onsets.push_back(times(chance));
            auto const problem = small_campaign::seen_within(real, onsets, {100, 100, 100});
            auto const found = looked_for(problem, one.e);
            CAPTURE(n, one.e.name, real.*one.size, onsets, found.fit().parameters,
                    found.fit().inflation);
            REQUIRE(found.explains());
            CHECK(found.acting().begins_later());
            CHECK(verify_at(found.problem(), found.fit()).range.upper() <= 1);
        }
    }
}
