// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_SCENARIO_HPP
#define SIVID_IO_SCENARIO_HPP

#include <sivid/compiled.hpp>
#include <sivid/io/dataset/model_names.hpp>
#include <sivid/io/dataset_value.hpp>
#include <sivid/measurement/signal.hpp>
#include <sivid/model/bound_model.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

/// Scenarios as small JSON files: how long, where from, and each input as a named shape.
///
///     { "format": "sivid-scenario-1", "name": "S3", "about": "...", "duration": 3,
///       "initial": { "u": 2, "v": 0, "r": 0, "x": 0, "y": 0, "psi": 0 },
///       "inputs": { "W": { "shape": "constant", "value": 83.333333 },
///                   "delta": { "shape": "sine", "offset": 0.26, "amplitude": 0.26,
///                              "frequency": 0.25, "phase": 0 } } }
///
/// Shapes: constant (value); sine (offset + amplitude sin(2 pi frequency t + phase), frequency in
/// Hz); ramp (from, to, begin, end: constant before and after); samples (t, values: straight lines
/// between). An initial state may be a range [lower, upper]: predictions start anywhere in it,
/// simulations in its middle, and a data set made of it states the range. The format may be called
/// hovercraft-scenario-1, too.
namespace sivid {

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
[[nodiscard]] SIVID_DECL signal exact_signal(input_shape const& s, double duration);

struct scenario_description {
    std::string name, about;
    double duration = 0;               ///< [time]
    std::vector<input_shape> inputs;   ///< one for each input of the model
    std::vector<stated_range> initial; ///< one for each state of the model
};

/// Reads a scenario from a text.
/// @param name  of the text, for messages
/// @throws input_error that says what is wrong and where
[[nodiscard]] SIVID_DECL scenario_description parse_scenario(std::string const& name,
                                                             std::string const& text,
                                                             model_names const& model);

/// A scenario as a text that reads back as the same one.
[[nodiscard]] SIVID_DECL std::string scenario_json(scenario_description const& s,
                                                   model_names const& model);

/// Reads a scenario file.
/// @throws input_error
[[nodiscard]] SIVID_DECL scenario_description read_scenario(std::filesystem::path const& file,
                                                            model_names const& model);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/io/impl/scenario.ipp>
#endif

#endif
