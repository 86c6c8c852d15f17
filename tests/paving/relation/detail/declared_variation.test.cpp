// SPDX-License-Identifier: MIT
#include <sivid/paving/relation/detail/declared_variation.hpp>

#include "diagnosis/planted_motion.hpp"
#include "support/catch.hpp"

using namespace diagnosis_support;

namespace {

bound_model bound_pendulum(recorded_model const& m) {
    return bind(m, {support::all_constants(3), {}},
                {sampled_signal({0.0}, {0.0}, interpolation::linear)});
}
std::vector<rate_variation> laws(bound_model const& model, box const& prior, experiment const& e) {
    auto const channels = measured_states(model, {&e});
    return declare_variations(model, {find_rate_scales(model, prior, e, channels)}).front();
}
/// By how much the rate of state i varies at most within one gap of 0.1 s.
double true_variation(motion_truth const& truth, std::size_t i) {
    auto const per_gap = static_cast<std::size_t>(std::lround(0.1 / truth.step));
    double result = 0;
    for (std::size_t k = 0; k + per_gap < truth.states.size(); k += per_gap) {
        double lo = 1e300, hi = -1e300;
        for (std::size_t p = k; p < k + per_gap; ++p) {
            double const rate = (truth.states[p + 1][i] - truth.states[p][i]) / truth.step;
            lo = std::min(lo, rate);
            hi = std::max(hi, rate);
        }
        result = std::max(result, hi - lo);
    }
    return result;
}

} // namespace

TEST_CASE("the default leaves room above what motions do, modelled or not") {
    draws d(8);
    double closest = 0, switching = 0;
    for (int n = 0; n < 60; ++n) {
        bool const dry = n % 3 == 0;
        auto const m = pendulum(dry ? d.uniform(0.1, 0.4) : 0); // friction that switches
        auto const model = bound_pendulum(m);
        std::vector<sampled_signal> const inputs{sine_input(d.uniform(0, 3), d.uniform(0.5, 4), 5)};
        auto const truth = simulate(m, {d.uniform(1, 20), d.uniform(0, 0.5), 1}, inputs,
                                    {d.uniform(0.5, 1), d.uniform(-1, 1)}, 5);
        auto const e = measured(d, "S", truth, inputs, {0, 1}, 0.02, noise::uniform);
        auto const law = laws(model, box{between(0, 20), between(0, 1), between(0, 2)}, e);
        for (std::size_t i = 0; i < 2; ++i) {
            CHECK_THAT(law[i].period, WithinAbs(0.1, 1e-9));
            auto& so_far = dry ? switching : closest;
            so_far = std::max(so_far, true_variation(truth, i) / law[i].variation);
        }
    }
    CHECK(closest < 0.7);
    CHECK(closest > 0.05); // and not absurdly much
    CHECK(switching < 1);
}

TEST_CASE("a kinematic rate varies no more than its state's rate brings about") {
    draws d(9);
    auto const m = pendulum();
    auto const model = bound_pendulum(m);
    std::vector<sampled_signal> const inputs{sine_input(0, 1, 5)};
    auto const truth = simulate(m, {0.1, 0, 1}, inputs, {0.2, 1}, 5); // slow, fast noise
    auto const e = measured(d, "S", truth, inputs, {0, 1}, 0.2, noise::at_the_bounds);
    auto const law = laws(model, box{between(0, 0.2), between(0, 0.1), between(0, 1)}, e);
    CHECK(law[0].variation >= true_variation(truth, 0));
    CHECK(law[0].variation < 0.2); // its own secants would allow 2.7
}

TEST_CASE("what nobody measured has a bound by the model") {
    draws d(10);
    auto const m = pendulum();
    auto const model = bound_pendulum(m);
    std::vector<sampled_signal> const inputs{sine_input(1, 1, 5)};
    auto const truth = simulate(m, {1, 0, 1}, inputs, {0.2, 1}, 5);
    auto const e = measured(d, "S", truth, inputs, {1}, 0.02, noise::uniform);
    box const prior{between(0, 2), between(0, 1), between(0, 1)};
    CHECK(std::isfinite(laws(model, prior, e)[0].variation));
}

TEST_CASE("one reading without a bound leaves the laws of all experiments finite") {
    draws d(12);
    auto const m = pendulum();
    auto const model = bound_pendulum(m);
    std::vector<sampled_signal> const inputs{sine_input(1, 1, 5)};
    auto const truth = simulate(m, {1, 0, 1}, inputs, {0.2, 1}, 5);
    box const prior{between(0, 2), between(0, 1), between(0, 1)};
    std::vector<experiment> all;
    for (char const* name : {"S0", "S1"})
        all.push_back(measured(d, name, truth, inputs, {0, 1}, 0.02, noise::uniform));
    std::vector<experiment const*> const both{&all[0], &all[1]};
    auto const channels = measured_states(model, both);
    auto const before = laws_above_model(model, prior, both, channels);
    auto& bound = all[1].measurements.back().bound; // of the rate
    bound = interval_traits<interval>::bounds(bound.lower(), HUGE_VAL);
    auto const after = laws_above_model(model, prior, both, channels);
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(after[0][i].variation < 1.2 * before[0][i].variation);
        CHECK(after[0][i].variation >= true_variation(truth, i));
    }
}

TEST_CASE("where there is no time nothing is known") {
    draws d(13);
    auto const m = pendulum();
    auto const model = bound_pendulum(m);
    std::vector<sampled_signal> const inputs{sine_input(1, 1, 5)};
    auto const truth = simulate(m, {1, 0, 1}, inputs, {0.2, 1}, 5);
    auto const e = measured(d, "S", truth, inputs, {0, 1}, 0.02, noise::uniform);
    box const prior{between(0, 2), between(0, 1), between(0, 1)};
    for (int const most : {0, 1, 3}) {
        int asked = 0;
        auto const law = laws_above_model(model, prior, {&e}, measured_states(model, {&e}),
                                          [&] { return asked++ < most; });
        CHECK(asked <= most + 1);
        for (auto const& one : law[0]) {
            if (asked > most) CHECK(one.variation == 1e100);
        }
    }
}
