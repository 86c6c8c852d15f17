// SPDX-License-Identifier: MIT
#ifndef HOVERCRAFT_SCENARIO_HPP
#define HOVERCRAFT_SCENARIO_HPP

#include <sivid/io/dataset_value.hpp>
#include <sivid/io/model_names.hpp>
#include <sivid/model/bound_model.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Scenarios as small JSON files: how long, where from, and each input as a named shape.
///
///     { "format": "hovercraft-scenario-1", "name": "S3", "about": "...", "duration": 3,
///       "initial": { "u": 2, "v": 0, "r": 0, "x": 0, "y": 0, "psi": 0 },
///       "inputs": { "W": { "shape": "constant", "value": 83.333333 },
///                   "delta": { "shape": "sine", "offset": 0.26, "amplitude": 0.26,
///                              "frequency": 0.25, "phase": 0 } } }
///
/// Shapes: constant (value); sine (offset + amplitude sin(2 pi frequency t + phase), frequency in
/// Hz); ramp (from, to, begin, end: constant before and after); samples (t, values: straight lines
/// between). An initial state may be a range [lower, upper]: the craft starts in its middle, and a
/// data set made of it states the range.
namespace hovercraft_example {

/// One input over time.
struct input_shape {
    enum class kind { constant, sine, ramp, samples } shape = kind::constant;
    double offset = 0, amplitude = 0, frequency = 0, phase = 0; ///< sine; constant: offset
    double from = 0, to = 0, begin = 0, end = 0;                ///< ramp
    std::vector<double> times, values;                          ///< samples

    [[nodiscard]] double operator()(double t) const {
        switch (shape) {
        case kind::constant:
            return offset;
        case kind::sine:
            return offset + amplitude * std::sin(2 * std::numbers::pi * frequency * t + phase);
        case kind::ramp:
            return from + (to - from) * std::clamp((t - begin) / (end - begin), 0.0, 1.0);
        case kind::samples:
            break;
        }
        auto const next = std::upper_bound(times.begin(), times.end(), t);
        if (next == times.begin()) return values.front();
        if (next == times.end()) return values.back();
        auto const k = static_cast<std::size_t>(next - times.begin());
        return std::lerp(values[k - 1], values[k], (t - times[k - 1]) / (times[k] - times[k - 1]));
    }
};

/// The shape without rounding or sampling: a formula, or straight lines between its own knots.
/// The numbers of the file stand for their nearest doubles.
[[nodiscard]] sivid::signal exact_signal(input_shape const& s, double duration);

struct scenario_description {
    std::string name, about;
    double duration = 0;                      ///< [s]
    std::vector<input_shape> inputs;          ///< one for each input of the model
    std::vector<sivid::stated_range> initial; ///< one for each state of the model
};

/// Reads a scenario from a text.
/// @param name  of the text, for messages
/// @throws sivid::input_error that says what is wrong and where
[[nodiscard]] scenario_description parse_scenario(std::string const& name, std::string const& text,
                                                  sivid::model_names const& model);

/// Reads a scenario file.
/// @throws sivid::input_error
[[nodiscard]] scenario_description read_scenario(std::filesystem::path const& file,
                                                 sivid::model_names const& model);

/// A scenario that is built in: Table 2.4 of the report as S1, S2, S3, and those of `scenarios/`.
struct built_in_scenario {
    std::string_view name, text;
};
/// All of them; the build puts the files of `scenarios/` here.
[[nodiscard]] std::vector<built_in_scenario> const& built_in_scenarios();

/// The scenarios that a command line asks for: "all" (S1, S2, S3), a built-in name, or a file.
/// @throws sivid::input_error
[[nodiscard]] std::vector<scenario_description> find_scenarios(std::string const& wanted,
                                                               sivid::model_names const& model);

} // namespace hovercraft_example

#endif
