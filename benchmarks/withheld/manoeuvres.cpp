// SPDX-License-Identifier: MIT
#include "manoeuvres.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <numbers>

namespace withheld {

std::string decimal_text(double value) {
    char text[64];
    std::snprintf(text, sizeof text, "%.6f", value);
    std::string s = text;
    s.erase(s.find_last_not_of('0') + 1);
    if (s.back() == '.') s.pop_back();
    return s == "-0" ? "0" : s;
}

double six_decimals(double value) { return std::strtod(decimal_text(value).c_str(), nullptr); }

namespace {

using signal = std::function<double(double)>;

scenario make(std::string name, double duration, channels const& initial, signal const& motor,
              signal const& rudder, sampling const& how) {
    scenario s;
    s.name = std::move(name);
    s.holdout = s.name.front() == 'H';
    s.duration = duration;
    auto const last_input = static_cast<int>(std::lround(duration * 20));
    for (int i = 0; i <= last_input; ++i) {
        double const t = six_decimals(0.05 * i);
        s.motor.t.push_back(t);
        s.rudder.t.push_back(t);
        s.motor.value.push_back(six_decimals(motor(t)));
        bool const calm = how.dither == 0 || (how.calm_start && s.name == "S1");
        double const dither =
            calm ? 0
                 : how.dither * std::sin(2 * std::numbers::pi / how.dither_period * t + how.phase);
        s.rudder.value.push_back(six_decimals(rudder(t) + dither));
    }
    auto const last_sample = static_cast<int>(std::floor(duration / how.period + 1e-9));
    for (int i = 1; i <= last_sample; ++i) s.sample_times.push_back(six_decimals(how.period * i));
    for (std::size_t i = 0; i < channel_count; ++i) s.initial[i] = {initial[i], initial[i]};
    return s;
}

/// offset + size sin(frequency t + phase)
signal wave(double offset, double size, double frequency, double phase = 0) {
    return [=](double t) { return offset + size * std::sin(frequency * t + phase); };
}

signal steady(double value) { return wave(value, 0, 0); }

} // namespace

std::vector<scenario> draw_manoeuvres(random_source& random, double variation,
                                      sampling const& how) {
    auto const near = [&](double x) { return x * random.uniform(1 - variation, 1 + variation); };
    double const pi = std::numbers::pi;
    std::vector<scenario> all;
    auto const add = [&](char const* name, double duration, channels const& initial,
                         signal const& motor, signal const& rudder) {
        all.push_back(make(name, duration, initial, motor, rudder, how));
    };
    // The first three are the report's own and stay.
    add("S1", 1, {0.1, 0, 0, 0, 0, 0}, steady(250), steady(0));
    add("S2", 10, {2, 0, 0, 0, 0, 0}, steady(0), steady(0));
    add("S3", 3, {2, 0, 0, 0, 0, 0}, steady(250.0 / 3), wave(pi / 12, pi / 12, pi / 2));
    auto const s4_motor = steady(near(90));
    auto const s4_rudder = wave(0, near(0.35), near(1.2));
    add("S4", 6, {1, 0, 0, 0, 0, 0}, s4_motor, s4_rudder);
    auto const s5_motor = wave(near(100), near(30), near(0.9));
    auto const s5_rudder = wave(near(-0.1), near(0.25), near(0.7), near(0.6));
    add("S5", 6, {0.5, 0, 0, 0, 0, 0}, s5_motor, s5_rudder);
    auto const h1_motor = wave(near(95), near(15), near(0.8), -pi / 2);
    auto const h1_rudder = wave(near(0.08), near(0.3), near(1.6));
    add("H1", 5, {1.5, 0, 0, 0, 0, 0}, h1_motor, h1_rudder);
    auto const h2_motor = steady(near(80));
    auto const h2_rudder = wave(0, -near(0.3), near(0.9));
    add("H2", 5, {0.8, 0.2, 0, 0, 0, 0.5}, h2_motor, h2_rudder);
    return all;
}

} // namespace withheld
