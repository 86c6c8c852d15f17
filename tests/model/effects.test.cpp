// SPDX-License-Identifier: MIT
#include <sivid/model/effects.hpp>

#include "model/cart.hpp"
#include "support/catch.hpp"

#include <sivid/model/named_effects.hpp>

#include <cmath>
#include <functional>
#include <stdexcept>

using namespace sivid;
using namespace sivid::literals;
using namespace model_support;

namespace {

double rate(effect const& e, std::size_t i, double u, double parameter) {
    auto const m = with(cart{}, e);
    return at(m, m.rate[i], u, {parameter});
}
double channel(effect const& e, std::size_t i, double parameter) {
    auto const m = with(cart{}, e);
    return at(m, m.observe[i], 0, {parameter});
}

constexpr effects::range prior{0_dec, 1_dec};

} // namespace

TEST_CASE("effects of inputs") {
    auto const band = effects::input_dead_band("e", "u", "N", prior);
    CHECK(rate(band, 0, 1.5, 0.5) == 2);
    CHECK(rate(band, 0, -1.5, 0.5) == -2);
    CHECK(rate(band, 0, 0.3, 0.5) == 0);
    auto const limit = effects::input_saturation("e", "u", "N", prior);
    CHECK(rate(limit, 0, 1.5, 0.5) == 1);
    CHECK(rate(limit, 0, -1.5, 0.5) == -1);
    CHECK(rate(limit, 0, 0.25, 0.5) == 0.5);
    CHECK(rate(effects::input_trim("e", "u", "N", prior), 0, 1, 0.5) == 3);
    CHECK(rate(effects::input_gain("e", "u", prior), 0, 1, 0.5) == 3);
    auto const lag = effects::input_lag("e", "u", "N", prior, 10);
    CHECK(rate(lag, 0, 7, 0.5) == 0.5);
    CHECK(rate(lag, 2, 7, 0.5) == (7 - 0.25) / 0.5);
    auto const model = with(cart{}, lag);
    CHECK(at(model, model.added_states[0].at_begin, 7, {0.5}) == 7);
    auto const resting = with(cart{}, effects::input_lag("e", "u", "N", prior, 10, true));
    CHECK(at(resting, resting.added_states[0].at_begin, 7, {0.5}) == 0);
    CHECK(with(cart{}, effects::input_delay("e", "u", prior)).input_memory.size() == 1);
    auto const gap = with(cart{}, effects::input_backlash("e", "u", "N", prior));
    REQUIRE(gap.input_memory.size() == 1);
    CHECK(gap.input_memory[0].kind == memory_kind::play);
    CHECK(gap.has_memory());
    CHECK_THROWS_AS(effects::input_rate_limit("e", "u", "N/s", prior), std::invalid_argument);
    auto const slow =
        with(cart{}, effects::input_rate_limit("e", "u", "N/s", {0.125_dec, prior.upper}));
    REQUIRE(slow.input_memory.size() == 1);
    CHECK(slow.input_memory[0].kind == memory_kind::rate_limit);
    CHECK(slow.about.constants.back().nominal.nearest == nearest(prior.upper));
    auto const clock = with(cart{}, effects::input_clock_drift("e", "u", prior));
    REQUIRE(clock.input_memory.size() == 1);
    CHECK(clock.input_memory[0].kind == memory_kind::drift);
}

TEST_CASE("effects of equations") {
    CHECK(rate(effects::constant_rate("e", "x", "m/s^2", prior), 0, 1, 0.5) == 2.5);
    CHECK(rate(effects::linear_damping("e", "x", prior), 0, 1, 0.5) == 2.25);
    CHECK(rate(effects::quadratic_damping("e", "x", "1/m", prior), 0, 1, 0.5) == 2.125);
    CHECK(rate(effects::dry_friction("e", "x", "m/s^2", prior, 0_dec), 0, 1, 0.5) == 2.5);
    auto const smooth = effects::dry_friction("e", "x", "m/s^2", prior, 0.5_dec);
    CHECK(std::abs(rate(smooth, 0, 1, 0.5) - (2 + 0.5 / std::sqrt(2.0))) < 1e-15);
    // At x = -0.5 with k = s = 0.5 and v = 1.
    auto const stribeck =
        effects::stribeck_friction("e", "x", "m/s^2", prior, prior, 1_dec, 0.5_dec);
    CHECK(std::abs(rate(stribeck, 0, 1, 0.5) - (2 + 0.5 * (1 + std::exp(-0.25)) / std::sqrt(2.0))) <
          1e-15);
    CHECK(rate(stribeck, 0, 1, 0) == 2);
    // Bristles at 0.25, x = -0.5, g = 1 + 0.5 exp(-0.25).
    auto const lugre =
        effects::lugre_friction("e", "x", "m/s^2", prior, prior, 1_dec, 0.5_dec, 0.25_dec);
    double const bend = (-0.5 - 0.5 * 0.25 / (1 + 0.5 * std::exp(-0.25))) / 0.5;
    CHECK(std::abs(rate(lugre, 2, 1, 0.5) - bend) < 1e-15);
    CHECK(std::abs(rate(lugre, 0, 1, 0.5) - (2 - 0.5 * (0.25 + 0.25 * bend))) < 1e-15);
    CHECK(rate(lugre, 0, 1, 0) == 2);
    CHECK(with(cart{}, lugre).about.states[2].limit == 2);
    CHECK(rate(effects::drift("e", "c", prior), 0, 1, 0.5) == 2 * (1 + 0.5 * 3));
    // Here the position is its own velocity: x' = 2 + k max(stop - x, 0) at x = -0.5.
    using side = effects::stop_side;
    auto const stop = [](decimal at, side s) {
        return effects::end_stop("e", "x", "x", "1/s", prior, at, s);
    };
    CHECK(rate(stop(1_dec, side::lower), 0, 1, 0.5) == 2.75);
    CHECK(rate(stop(-1_dec, side::lower), 0, 1, 0.5) == 2);
    CHECK(rate(stop(-1_dec, side::upper), 0, 1, 0.5) == 1.75);
    CHECK(rate(stop(1_dec, side::upper), 0, 1, 0.5) == 2);
}

TEST_CASE("effects of sensors") {
    CHECK(channel(effects::sensor_bias("e", "y", "m/s", prior), 0, 0.5) == 0);
    auto const scale = effects::sensor_scale("e", {"y", "z"}, prior);
    CHECK(channel(scale, 0, 0.5) == -0.75);
    CHECK(channel(scale, 1, 0.5) == 3);
    CHECK(channel(effects::sensor_drift("e", "y", "m/s^2", prior), 0, 0.5) == 1); // at t = 3
    auto const clipped = effects::sensor_saturation("e", "z", "m", {0_dec, 9_dec});
    CHECK(channel(clipped, 1, 0.5) == 0.5);
    CHECK(channel(clipped, 0, 0.5) == -0.5);
    CHECK(channel(clipped, 1, nearest(clipped.parameters[0].neutral)) == 2);
    auto const askew = effects::sensor_rotation("e", {"y", "z"}, prior);
    CHECK(std::abs(channel(askew, 0, 0.5) - (-0.5 * std::cos(0.5) - 2 * std::sin(0.5))) < 1e-15);
    CHECK(std::abs(channel(askew, 1, 0.5) - (-0.5 * std::sin(0.5) + 2 * std::cos(0.5))) < 1e-15);
    CHECK(channel(askew, 1, 0) == 2);
    CHECK_THROWS_AS(effects::sensor_rotation("e", {"y"}, prior), std::invalid_argument);
    // At x = -0.5: y + a cos x - b sin x, z + a sin x + b cos x with a = b = 0.5.
    auto const arm = effects::sensor_lever_arm("e", {"y", "z"}, "x", "m", prior);
    double const c = std::cos(-0.5), s = std::sin(-0.5);
    CHECK(std::abs(channel(arm, 0, 0.5) - (-0.5 + 0.5 * (c - s))) < 1e-15);
    CHECK(std::abs(channel(arm, 1, 0.5) - (2 + 0.5 * (c + s))) < 1e-15);
    CHECK(channel(arm, 1, 0) == 2);
    CHECK_THROWS_AS(effects::sensor_lever_arm("e", {"y"}, "x", "m", prior), std::invalid_argument);
    auto const swapped = effects::sensor_swap("e", {"y", "z"}, prior);
    CHECK(channel(swapped, 0, 1) == 2);
    CHECK(channel(swapped, 1, 1) == -0.5);
    CHECK(channel(swapped, 0, 0.5) == channel(swapped, 1, 0.5));
    CHECK(channel(swapped, 1, 0) == 2);
    CHECK_THROWS_AS(effects::sensor_swap("e", {"y", "z", "y"}, prior), std::invalid_argument);
    // What an instrument cannot show it cannot show however it is mounted and scaled.
    auto const both = with(cart{}, clipped, effects::sensor_scale("f", {"z"}, {1_dec, 1_dec}));
    CHECK(at(both, both.observe[1], 0, {0.5}) == 0.5);
    auto const late = with(cart{}, effects::sensor_latency("e", {"y", "z"}, prior));
    CHECK(late.channel_delays.size() == 2);
    CHECK(late.channel_delays[1].kind == memory_kind::delay);
}

TEST_CASE("priors are widened where an effect may go further, and nowhere else") {
    auto const wide = [](effects::range const& stated, decimal neutral) {
        auto const e =
            widened({.name = "e", .parameters = {{"k", "1", stated.lower, stated.upper, neutral}}});
        CHECK(e.name == "e_wider");
        return e.parameters[0].prior();
    };
    auto const same = [](interval const& x, double lo, double hi) {
        return x.lower() == lo && x.upper() == hi;
    };
    CHECK(same(wide({0_dec, 1_dec}, 0_dec), 0, 4)); // a time
    CHECK(same(wide({-1_dec, 0.5_dec}, 0_dec), -4, 2));
    CHECK(same(wide({1_dec, 8_dec}, 8_dec), 0.25, 8)); // a limit
    CHECK(same(wide({-8_dec, -1_dec}, 0_dec), -32, -0.25));
    CHECK(same(wide({2_dec, 2_dec}, 0_dec), 2, 2)); // stated to be known
    auto const tenth = wide({0_dec, 0.1_dec}, 0_dec);
    CHECK(tenth.upper() >= 0.4);
    CHECK(tenth.upper() < 0.4 + 1e-15);
    std::vector<effect> const catalogue{effects::input_gain("gain", "u", prior)};
    auto const found = effects_named(catalogue, {"gain", "gain_wider"});
    CHECK(found[0].parameters[0].prior().upper() == 1);
    CHECK(found[1].name == "gain_wider");
    CHECK(found[1].parameters[0].prior().upper() == 4);
    CHECK_THROWS_AS(effects_named(catalogue, {"loss_wider"}), std::invalid_argument);
    CHECK(with(cart{}, found[1]).about.constants.back().name == "gain_wider.k");
}

TEST_CASE("the neutral value leaves the model as it is") {
    for (auto const& e :
         {effects::input_dead_band("e", "u", "N", prior), effects::input_trim("e", "u", "N", prior),
          effects::input_gain("e", "u", prior), effects::constant_rate("e", "x", "m/s^2", prior),
          effects::linear_damping("e", "x", prior), effects::drift("e", "c", prior),
          effects::input_saturation("e", "u", "N", prior)}) {
        double const neutral = nearest(e.parameters[0].neutral);
        CHECK(rate(e, 0, 0.75, neutral) == 1.5);
    }
}
