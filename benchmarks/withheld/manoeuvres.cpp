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
              signal const& rudder) {
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
        s.rudder.value.push_back(six_decimals(rudder(t)));
    }
    auto const last_sample = static_cast<int>(std::lround(duration * 10));
    for (int i = 1; i <= last_sample; ++i) s.sample_times.push_back(six_decimals(0.1 * i));
    for (std::size_t i = 0; i < channel_count; ++i) s.initial[i] = {initial[i], initial[i]};
    return s;
}

/// offset + size sin(frequency t + phase)
signal wave(double offset, double size, double frequency, double phase = 0) {
    return [=](double t) { return offset + size * std::sin(frequency * t + phase); };
}

signal steady(double value) { return wave(value, 0, 0); }

} // namespace

std::vector<scenario> draw_manoeuvres(random_source& random, double variation) {
    auto const near = [&](double x) { return x * random.uniform(1 - variation, 1 + variation); };
    double const pi = std::numbers::pi;
    std::vector<scenario> all;
    // The first three are the report's own and stay.
    all.push_back(make("S1", 1, {0.1, 0, 0, 0, 0, 0}, steady(250), steady(0)));
    all.push_back(make("S2", 10, {2, 0, 0, 0, 0, 0}, steady(0), steady(0)));
    all.push_back(
        make("S3", 3, {2, 0, 0, 0, 0, 0}, steady(250.0 / 3), wave(pi / 12, pi / 12, pi / 2)));
    auto const s4_motor = steady(near(90));
    auto const s4_rudder = wave(0, near(0.35), near(1.2));
    all.push_back(make("S4", 6, {1, 0, 0, 0, 0, 0}, s4_motor, s4_rudder));
    auto const s5_motor = wave(near(100), near(30), near(0.9));
    auto const s5_rudder = wave(near(-0.1), near(0.25), near(0.7), near(0.6));
    all.push_back(make("S5", 6, {0.5, 0, 0, 0, 0, 0}, s5_motor, s5_rudder));
    auto const h1_motor = wave(near(95), near(15), near(0.8), -pi / 2);
    auto const h1_rudder = wave(near(0.08), near(0.3), near(1.6));
    all.push_back(make("H1", 5, {1.5, 0, 0, 0, 0, 0}, h1_motor, h1_rudder));
    auto const h2_motor = steady(near(80));
    auto const h2_rudder = wave(0, -near(0.3), near(0.9));
    all.push_back(make("H2", 5, {0.8, 0.2, 0, 0, 0, 0.5}, h2_motor, h2_rudder));
    return all;
}

} // namespace withheld
