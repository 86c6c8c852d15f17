// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_MANOEUVRE_HPP
#define SIVID_MODEL_MANOEUVRE_HPP

#include <sivid/measurement/signal.hpp>
#include <sivid/model/bound_model.hpp>
#include <sivid/model/unit.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// A number of a manoeuvre that may be chosen, with its limits.
struct manoeuvre_setting {
    std::string name;
    std::string unit;
    double lower = 0, upper = 0;
};

/// Something the robot can be told to do: inputs over a duration, perhaps with a few settings.
struct manoeuvre {
    std::string name;
    double duration = 1;                     ///< in the model's unit of time
    std::vector<double> start;               ///< the states at its begin
    std::vector<manoeuvre_setting> settings; ///< none: a fixed manoeuvre
    std::function<std::vector<signal>(std::vector<double> const&)> inputs;
};

/// An input that may be varied, and its limits, which every manoeuvre keeps.
struct varied_input {
    std::size_t index = 0; ///< of the model's inputs
    std::string name, unit;
    double lower = 0, upper = 0;
};

namespace model_detail {

/// How one input runs over time: from settings to a signal.
struct varied_shape {
    std::string name;
    /// Limits of the settings; levels are in the input's unit.
    std::function<std::vector<manoeuvre_setting>(varied_input const&, double duration,
                                                 std::string const& time_unit)>
        settings;
    std::function<signal(varied_input const&, double duration, double const* settings)> make;
};

inline manoeuvre_setting level(varied_input const& u, std::string const& which) {
    return {which + " of " + u.name, u.unit, u.lower, u.upper};
}
inline manoeuvre_setting share(varied_input const& u, std::string const& which) {
    return {which + " of " + u.name, "1", 0, 1};
}
/// Straight lines.
inline signal through(varied_input const& u, std::vector<double> times,
                      std::vector<double> values) {
    for (auto& v : values) v = std::clamp(v, u.lower, u.upper);
    return sampled_signal(std::move(times), std::move(values), interpolation::linear);
}
/// Straight lines between values at equal distances.
inline signal evenly(varied_input const& u, double duration, std::vector<double> values) {
    std::vector<double> times(values.size(), duration);
    auto const pieces = static_cast<double>(values.size() - 1);
    for (std::size_t k = 0; k + 1 < values.size(); ++k)
        times[k] = duration * static_cast<double>(k) / pieces;
    return through(u, std::move(times), std::move(values));
}
/// A wave of at most 1 about a mean; the amplitude is a share of what the limits leave.
template <class Wave>
signal waving(varied_input const& u, double duration, double mean, double amplitude,
              Wave const& wave) {
    constexpr std::size_t pieces = 48;
    double const reach = amplitude * std::min(mean - u.lower, u.upper - mean);
    std::vector<double> values;
    for (std::size_t k = 0; k <= pieces; ++k)
        values.push_back(mean + reach * wave(static_cast<double>(k) / pieces));
    return evenly(u, duration, std::move(values));
}

inline constexpr double whole_turn = 2 * std::numbers::pi;

inline varied_shape constant_shape() {
    return {"constant",
            [](varied_input const& u, double, std::string const&) {
                return std::vector{level(u, "level")};
            },
            [](varied_input const& u, double T, double const* s) {
                return through(u, {0, T}, {s[0], s[0]});
            }};
}
inline varied_shape ramp_shape() {
    return {"ramp",
            [](varied_input const& u, double, std::string const&) {
                return std::vector{level(u, "begin"), level(u, "end")};
            },
            [](varied_input const& u, double T, double const* s) {
                return through(u, {0, T}, {s[0], s[1]});
            }};
}
inline varied_shape steps_shape() {
    return {"steps",
            [](varied_input const& u, double T, std::string const& time) {
                return std::vector{level(u, "first level"),
                                   level(u, "second level"),
                                   level(u, "third level"),
                                   {"first step of " + u.name, time, 0.05 * T, 0.5 * T},
                                   {"second step of " + u.name, time, 0.55 * T, 0.95 * T}};
            },
            [](varied_input const& u, double T, double const* s) {
                double const rise = 0.01 * T; // no actuator jumps
                return through(u, {0, s[3], s[3] + rise, s[4], s[4] + rise, T},
                               {s[0], s[0], s[1], s[1], s[2], s[2]});
            }};
}
inline varied_shape sine_shape() {
    return {"sine",
            [](varied_input const& u, double T, std::string const& time) {
                return std::vector{
                    level(u, "mean"),
                    share(u, "amplitude"),
                    {"frequency of " + u.name, rate_unit("1", time), 0.5 / T, 5 / T}};
            },
            [](varied_input const& u, double T, double const* s) {
                return waving(u, T, s[0], s[1],
                              [&](double at) { return std::sin(whole_turn * s[2] * T * at); });
            }};
}
inline varied_shape multisine_shape() {
    return {"multisine",
            [](varied_input const& u, double, std::string const&) {
                return std::vector{level(u, "mean"),
                                   share(u, "amplitude"),
                                   {"first phase of " + u.name, "rad", 0, whole_turn},
                                   {"second phase of " + u.name, "rad", 0, whole_turn}};
            },
            [](varied_input const& u, double T, double const* s) {
                return waving(u, T, s[0], s[1], [&](double at) {
                    return (std::sin(whole_turn * at) + std::sin(whole_turn * 2 * at + s[2]) +
                            std::sin(whole_turn * 4 * at + s[3])) /
                           3;
                });
            }};
}
inline varied_shape knots_shape() {
    return {"free knots",
            [](varied_input const& u, double, std::string const&) {
                std::vector<manoeuvre_setting> all_knots;
                for (int k = 0; k <= 5; ++k)
                    all_knots.push_back(level(u, "knot " + std::to_string(k)));
                return all_knots;
            },
            [](varied_input const& u, double T, double const* s) {
                return evenly(u, T, {s, s + 6});
            }};
}
inline std::vector<varied_shape> const& varied_shapes() {
    static std::vector<varied_shape> const all{constant_shape(), ramp_shape(),      steps_shape(),
                                               sine_shape(),     multisine_shape(), knots_shape()};
    return all;
}

} // namespace model_detail

/// The library of shapes: constants, ramps, steps (within a hundredth of the duration), sines, sums
/// of three sines, lines through free knots; all of them straight lines between samples. All inputs
/// at once take each of them; and where there are several, each input alone does while the others
/// are constant.
///   Every value lies within its input's limits, as doubles compare.
/// @param start   the states at the begin
/// @param time_unit  the model's, of settings that are times
/// @param others  a signal for each input of the model; those that are varied are replaced
/// @throws std::invalid_argument  limits that are not finite or not in order, no input
[[nodiscard]] inline std::vector<manoeuvre>
manoeuvre_shapes(std::vector<varied_input> const& varied, std::vector<signal> const& others,
                 std::vector<double> const& start, double duration, std::string const& time_unit) {
    if (varied.empty()) throw std::invalid_argument("manoeuvres: there is no input to vary");
    for (auto const& u : varied) {
        if (!(u.lower < u.upper) || !std::isfinite(u.upper - u.lower) || u.index >= others.size())
            throw std::invalid_argument("manoeuvres: the limits of " + u.name +
                                        " must be finite, the lower one below the upper one");
    }
    auto const& shapes = model_detail::varied_shapes();
    auto const made = [&](std::string name, std::vector<std::size_t> const& kinds) {
        manoeuvre m{std::move(name), duration, start, {}, nullptr};
        std::vector<std::size_t> first;
        for (std::size_t v = 0; v < varied.size(); ++v) {
            first.push_back(m.settings.size());
            auto const own = shapes[kinds[v]].settings(varied[v], duration, time_unit);
            m.settings.insert(m.settings.end(), own.begin(), own.end());
        }
        m.inputs = [varied, others, duration, kinds, first](std::vector<double> const& settings) {
            auto signals = others;
            for (std::size_t v = 0; v < varied.size(); ++v) {
                auto const& shape = model_detail::varied_shapes()[kinds[v]];
                signals[varied[v].index] =
                    shape.make(varied[v], duration, settings.data() + first[v]);
            }
            return signals;
        };
        return m;
    };
    std::vector<manoeuvre> result;
    for (std::size_t kind = 0; kind < shapes.size(); ++kind)
        result.push_back(made(shapes[kind].name, std::vector<std::size_t>(varied.size(), kind)));
    if (varied.size() < 2) return result;
    for (std::size_t kind = 1; kind < shapes.size(); ++kind) {
        for (std::size_t v = 0; v < varied.size(); ++v) {
            std::vector<std::size_t> kinds(varied.size(), 0);
            kinds[v] = kind;
            result.push_back(
                made(shapes[kind].name + " of " + varied[v].name + ", the rest constant", kinds));
        }
    }
    return result;
}

} // namespace sivid

#endif
