// SPDX-License-Identifier: MIT
#include <sivid/paving/relation/detail/declared_variation.hpp>
#include <sivid/paving/relation/detail/model_variation.hpp>

#include "diagnosis/planted_motion.hpp"
#include "support/catch.hpp"

using namespace diagnosis_support;

namespace {

/// By how much the rate of state i varies at most within a time, along the truth.
double true_variation(motion_truth const& truth, std::size_t i, double period) {
    auto const steps = static_cast<std::size_t>(std::lround(period / truth.step));
    std::vector<double> rates;
    for (std::size_t k = 0; k + 1 < truth.states.size(); ++k) {
        rates.push_back((truth.states[k + 1][i] - truth.states[k][i]) / truth.step);
    }
    double most = 0;
    for (std::size_t k = 0; k + steps <= rates.size(); ++k) {
        auto const begin = rates.begin() + static_cast<std::ptrdiff_t>(k);
        auto const [lo, hi] =
            std::minmax_element(begin, begin + static_cast<std::ptrdiff_t>(steps));
        most = std::max(most, *hi - *lo);
    }
    return most;
}
bound_model open_model(recorded_model const& m, std::size_t parameters) {
    return bind(m, {support::all_constants(parameters), {}},
                {sampled_signal({0.0}, {0.0}, interpolation::linear)});
}
sampled_signal wave(double size, double period, double duration, interpolation kind) {
    std::vector<double> t, v;
    for (int k = 0; k * 0.02 < duration + 0.03; ++k) {
        t.push_back(k * 0.02);
        v.push_back(size * std::sin(2 * 3.14159265 / period * t.back()));
    }
    return {t, v, kind};
}

} // namespace

TEST_CASE("no motion of the model varies more than the bounds say") {
    draws d(601);
    auto const m = pendulum();
    auto const model = open_model(m, 3);
    box const prior{between(1, 10), between(0, 1), between(0.5, 2)};
    double sharpest = 0;
    for (int n = 0; n < 60; ++n) {
        double const sampling = n % 3 == 0 ? 0.05 : n % 3 == 1 ? 0.1 : 0.3;
        auto const kind = n % 2 == 0 ? interpolation::linear : interpolation::hold;
        std::vector<sampled_signal> const inputs{
            wave(d.uniform(0, 10), d.uniform(0.1, 2), 4, kind)};
        auto const truth = simulate(m, {d.uniform(1, 10), d.uniform(0, 1), d.uniform(0.5, 2)},
                                    inputs, {d.uniform(-1, 1), d.uniform(-2, 2)}, 4);
        auto const e = measured(d, "S", truth, inputs, {0, 1}, 0.01, noise::uniform, {}, sampling);
        auto const channels = measured_states(model, {&e});
        model_variation const variation(model, prior, e, channels);
        std::vector<double> const periods{sampling, sampling};
        auto const most = variation.of_model(periods);
        std::vector<double> actual;
        for (std::size_t i = 0; i < 2; ++i) {
            actual.push_back(true_variation(truth, i, sampling));
            CHECK(actual[i] <= most[i] + 0.05);
            sharpest = std::max(sharpest, actual[i] / most[i]);
        }
        // In tubes that contain the motion.
        for (auto& v : actual) v += 0.05;
        auto const tubes = variation.in_tubes(actual, periods);
        for (std::size_t i = 0; i < 2; ++i) {
            CHECK(actual[i] - 0.05 <= tubes[i] + 0.05);
        }
        auto const laws =
            above_model(model, prior, e, channels, {{sampling, 1e-3}, {sampling, 1e-3}});
        for (std::size_t i = 0; i < 2; ++i) CHECK(laws[i].variation >= actual[i] - 0.1);
    }
    CHECK(sharpest > 0.3);
}

TEST_CASE("samples too far apart for the motion leave the variation open") {
    draws d(602);
    // A stiff spring: seen every period, it seems to rest.
    auto const m = support::model_of({2, 2, 1, 20},
                                     [](auto const&, auto const& x, auto const& p, auto const& u) {
                                         using T = std::decay_t<decltype(x[0])>;
                                         return std::vector<T>{x[1], p[0] * u[0] - p[1] * x[0]};
                                     });
    auto const model = open_model(m, 2);
    std::vector<sampled_signal> const inputs{wave(0, 1, 4, interpolation::linear)};
    double const stiffness = std::pow(2 * 3.14159265 * 2, 2);
    auto const truth = simulate(m, {1, stiffness}, inputs, {0.5, 0}, 4);
    auto const e = measured(d, "S", truth, inputs, {0, 1}, 0.01, noise::uniform, {}, 0.5);
    auto const channels = measured_states(model, {&e});
    box const prior{between(0.5, 2), between(100, 200)};
    auto const laws = above_model(model, prior, e, channels, {{0.5, 0.1}, {0.5, 0.1}});
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(laws[i].variation >= true_variation(truth, i, 0.5));
    }
}
