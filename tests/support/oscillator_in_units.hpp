// SPDX-License-Identifier: MIT
// One driven oscillator, x' = v, v' = g u - k x - c v, in any unit of time, of the states and of
// the input. The data are generated once in base units (seconds) and then scaled, so that every
// version is the same problem in other numbers: what is said of it has to be the same, too.
#ifndef SIVID_TESTS_SUPPORT_OSCILLATOR_IN_UNITS_HPP
#define SIVID_TESTS_SUPPORT_OSCILLATOR_IN_UNITS_HPP

#include <sivid/model/effects.hpp>
#include <sivid/model/problem.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

namespace support::in_units {

/// How many of the units make a second, and a base unit of the states and of the input.
struct units {
    double time = 1, state = 1, input = 1;
    char const* name = "s";

    /// What a rate of x (or v), and a rate of v, are multiplied by.
    [[nodiscard]] double speed() const { return state / time; }
    [[nodiscard]] double acceleration() const { return state / (time * time); }
};

/// Microseconds to weeks, and a unit that no one has.
inline constexpr std::array<units, 8> units_of_time{{{1e6, 1, 1, "us"},
                                                     {1e3, 1, 1, "ms"},
                                                     {1, 1, 1, "s"},
                                                     {1.0 / 60, 1, 1, "min"},
                                                     {1.0 / 3600, 1, 1, "h"},
                                                     {1.0 / 86400, 1, 1, "d"},
                                                     {1.0 / 604800, 1, 1, "week"},
                                                     {1 / 0.37, 1, 1, "0.37 s"}}};
inline constexpr std::array<double, 5> scalings{1e-6, 1e-3, 1, 1e3, 1e6};

/// Its constants are g, k and c; limits of the states are set by `model_in`.
struct oscillator {
    static constexpr auto name = "oscillator";
    static constexpr auto states = sivid::states({{"x", "m", 20}, {"v", "m/s", 40}});
    static constexpr auto inputs = sivid::inputs({{"u", "N"}});
    static constexpr auto channels = sivid::channels({{"x", "m"}, {"v", "m/s"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"g", "1/kg", 1_dec}, {"k", "1/s^2", 2_dec}, {"c", "1/s", 1_dec}});
    }();
    template <class T>
    sivid::states_of<oscillator, T> rate(T const&, sivid::states_of<oscillator, T> const& x,
                                         sivid::constants_of<oscillator, T> const& c,
                                         sivid::inputs_of<oscillator, T> const& u) const {
        return {x[1], c[0] * u[0] - c[1] * x[0] - c[2] * x[1]};
    }
    template <class T>
    sivid::channels_of<oscillator, T> observe(T const&, sivid::states_of<oscillator, T> const& x,
                                              sivid::constants_of<oscillator, T> const&,
                                              sivid::inputs_of<oscillator, T> const&) const {
        return {x[0], x[1]};
    }
};

/// What the model leaves out, in base units; 0: it is not there.
struct missing {
    double delay = 0;    ///< of the input [s]
    double cube = 0;     ///< v' - b x^3
    double friction = 0; ///< v' - f v/sqrt(v^2 + 0.05^2)
    double latency = 0;  ///< of the sensor of x [s]
    double bias = 0;     ///< of that sensor
    double gain = 0;     ///< of the sensor of v
    double lag = 0;      ///< of the input [s]
    double drag = 0;     ///< v' - q |v| v
};

/// An effect of `catalogue_in` and how it is planted; an empty name: nothing is missing.
struct planted {
    char const* effect;
    missing truth;
};
inline std::vector<planted> all_planted() {
    return {{"", {}},
            {"late", {.delay = 0.3}},
            {"cube", {.cube = 0.25}},
            {"friction", {.friction = 0.35}},
            {"latency", {.latency = 0.25}},
            {"bias", {.bias = 0.3}},
            {"gain", {.gain = 0.2}},
            {"lag", {.lag = 0.3}},
            {"drag", {.drag = 0.3}}};
}

inline constexpr double true_g = 1.1, true_k = 2.2, true_c = 0.5;

/// Input of the base experiment.
inline double pushed(double t) { return 1.6 * std::sin(0.9 * t) + 1.2 * std::cos(2.1 * t + 0.4); }

struct sizes {
    double duration = 20; ///< [s]
    int samples = 200;    ///< of each channel
    double error_x = 0.02, error_v = 0.03;
};

/// States (x, v) at every sample, from (0.2, 0), in base units; steps are a fraction of the gap.
inline std::vector<std::array<double, 2>> motion_of(missing const& real, sizes const& of) {
    int const fine = 24;
    double const gap = of.duration / of.samples, h = gap / fine;
    auto const knot = [&](double t) { // the input is straight between samples
        double const at = std::clamp(t / gap, 0.0, static_cast<double>(of.samples));
        double const k = std::min(std::floor(at), of.samples - 1.0);
        return (1 - (at - k)) * pushed(k * gap) + (at - k) * pushed((k + 1) * gap);
    };
    double const latency = real.latency;
    auto const rate = [&](double t, std::array<double, 3> const& s) {
        double const late = knot(std::max(0.0, t - real.delay));
        double const u = real.lag > 0 ? s[2] : late;
        double const a =
            true_g * u - true_k * s[0] - true_c * s[1] - real.cube * s[0] * s[0] * s[0] -
            real.friction * s[1] / std::hypot(s[1], 0.05) - real.drag * std::abs(s[1]) * s[1];
        return std::array<double, 3>{s[1], a, real.lag > 0 ? (late - s[2]) / real.lag : 0.0};
    };
    std::vector<std::array<double, 3>> path{{0.2, 0, pushed(0)}};
    for (int step = 0; step < of.samples * fine; ++step) {
        auto const s = path.back();
        double const t = step * h;
        auto const moved = [&](std::array<double, 3> const& d, double by) {
            return std::array<double, 3>{s[0] + by * d[0], s[1] + by * d[1], s[2] + by * d[2]};
        };
        auto const k1 = rate(t, s), k2 = rate(t + h / 2, moved(k1, h / 2));
        auto const k3 = rate(t + h / 2, moved(k2, h / 2)), k4 = rate(t + h, moved(k3, h));
        auto next = s;
        for (std::size_t i = 0; i < 3; ++i)
            next[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
        path.push_back(next);
    }
    std::vector<std::array<double, 2>> seen;
    for (int n = 0; n <= of.samples; ++n) {
        double const ago = std::max(0.0, (n * gap - latency) / h);
        auto const k = std::min(static_cast<std::size_t>(ago), path.size() - 2);
        double const share = ago - static_cast<double>(k);
        double const x = (1 - share) * path[k][0] + share * path[k + 1][0];
        seen.push_back({x, path[static_cast<std::size_t>(n * fine)][1]});
    }
    return seen;
}

/// The experiment in units; errors fill 60 % of the bounds.
inline sivid::experiment experiment_in(units const& in, missing const& real, sizes const& of = {}) {
    double const gap = of.duration / of.samples;
    auto const seen = motion_of(real, of);
    sivid::experiment e;
    e.name = "E1";
    std::vector<double> times, values;
    for (int k = 0; k <= of.samples; ++k) {
        times.push_back(k * gap * in.time);
        values.push_back(pushed(k * gap) * in.input);
    }
    e.inputs = {sivid::sampled_signal(times, values, sivid::interpolation::linear)};
    e.initial = sivid::box{sivid::interval(0.2 * in.state), sivid::interval(0.0)};
    for (std::size_t k = 1; k < seen.size(); ++k) {
        double const wave = 0.6 * std::sin(12.9898 * static_cast<double>(k));
        auto const around = [](double y, double error, double unit) {
            return sivid::interval((y - error) * unit, (y + error) * unit);
        };
        double const x = seen[k][0] + real.bias + wave * of.error_x;
        double const v = (1 + real.gain) * seen[k][1] - wave * of.error_v;
        e.measurements.push_back({times[k], 0, around(x, of.error_x, in.state)});
        e.measurements.push_back({times[k], 1, around(v, of.error_v, in.speed())});
    }
    return e;
}

inline sivid::recorded_model model_in(units const& in) {
    auto model = sivid::record_model(oscillator{});
    model.about.states[0].limit = model.about.states[0].limit * in.state;
    model.about.states[1].limit = model.about.states[1].limit * in.speed();
    return model;
}

/// Base prior of g, k and c, and the same in units; `true_constants` of it.
inline sivid::box prior_in(units const& in) {
    double const g = in.acceleration() / in.input, k = 1 / (in.time * in.time), c = 1 / in.time;
    return sivid::box{sivid::interval(0.8 * g, 1.4 * g), sivid::interval(1.5 * k, 3 * k),
                      sivid::interval(0.2 * c, 1 * c)};
}
inline std::vector<double> true_constants(units const& in) {
    return {true_g * in.acceleration() / in.input, true_k / (in.time * in.time), true_c / in.time};
}

inline sivid::identification_problem problem_in(units const& in, missing const& real = {},
                                                sizes const& of = {}) {
    return {model_in(in), {{"g", "k", "c"}, {}}, prior_in(in), {experiment_in(in, real, of)}};
}

/// The double as a decimal that lives as long as the program.
inline sivid::decimal decimal_of(double x) {
    static std::set<std::string> kept; // a node of a set stays where it is
    std::array<char, 64> text{};
    auto const end = std::to_chars(text.data(), text.data() + text.size(), std::abs(x)).ptr;
    auto const& own = *kept.emplace(text.data(), end).first;
    return {own.c_str(), own.size(), x < 0};
}

/// The effects of `all_planted`, in units.
inline std::vector<sivid::effect> catalogue_in(units const& in) {
    namespace any = sivid::effects;
    auto const to = [](double low, double high) {
        return any::range{decimal_of(low), decimal_of(high)};
    };
    sivid::effect cube;
    cube.name = "cube";
    cube.parameters = {{"b", "1/(m^2 s^2)", decimal_of(0),
                        decimal_of(in.acceleration() / std::pow(in.state, 3)), decimal_of(0)}};
    cube.on_rates = [](sivid::effect_scope& m) {
        auto const& x = m.state("x");
        m.rate("v") -= m.parameter() * x * x * x;
    };
    return {any::input_delay("late", "u", to(0, in.time)),
            cube,
            any::dry_friction("friction", "v", "m/s^2", to(0, in.acceleration()),
                              decimal_of(0.05 * in.speed())),
            any::sensor_latency("latency", {"x"}, to(0, in.time)),
            any::sensor_bias("bias", "x", "m", to(-in.state, in.state)),
            any::sensor_scale("gain", {"v"}, to(-0.5, 0.5)),
            any::input_lag("lag", "u", "N", to(0, in.time), 20 * in.input),
            any::quadratic_damping("drag", "v", "1/m", to(0, 1 / in.state))};
}

} // namespace support::in_units

#endif
