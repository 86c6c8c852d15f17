// SPDX-License-Identifier: MIT
#ifndef HOVERCRAFT_SCENARIO_HPP
#define HOVERCRAFT_SCENARIO_HPP

#include <sivid/io/dataset_value.hpp>
#include <sivid/io/json_document.hpp>
#include <sivid/io/model_names.hpp>
#include <sivid/model/bound_model.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <functional>
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
[[nodiscard]] inline sivid::signal exact_signal(input_shape const& s, double duration) {
    using kind = input_shape::kind;
    using sivid::sampled_signal;
    switch (s.shape) {
    case kind::constant:
        return sampled_signal({0}, {s.offset}, sivid::interpolation::hold);
    case kind::sine:
        return sivid::analytic_signal::from([&s](auto const& t) {
            return s.offset + s.amplitude * sin(2 * std::numbers::pi * s.frequency * t + s.phase);
        });
    case kind::ramp:
        return sampled_signal({s.begin - 1, s.begin, s.end, std::max(s.end, duration) + 1},
                              {s.from, s.from, s.to, s.to}, sivid::interpolation::linear);
    case kind::samples:
        break;
    }
    // Held before the first sample and after the last one.
    auto times = s.times;
    auto values = s.values;
    times.insert(times.begin(), times.front() - 1);
    values.insert(values.begin(), values.front());
    times.push_back(std::max(times.back(), duration) + 1);
    values.push_back(values.back());
    return sampled_signal(std::move(times), std::move(values), sivid::interpolation::linear);
}

struct scenario_description {
    std::string name, about;
    double duration = 0;                      ///< [s]
    std::vector<input_shape> inputs;          ///< one for each input of the model
    std::vector<sivid::stated_range> initial; ///< one for each state of the model
};

class scenario_reader {
public:
    explicit scenario_reader(sivid::model_names const& model) : model_{model} {}

    /// @throws sivid::input_error that says what is wrong and where
    [[nodiscard]] scenario_description read(sivid::json_value const& root) const {
        root.allow_only({"format", "name", "about", "duration", "initial", "inputs"});
        if (root.at("format").string() != "hovercraft-scenario-1")
            root.at("format").fail("unknown format", "write hovercraft-scenario-1");
        scenario_description result;
        result.name = root.at("name").string();
        if (result.name.find_first_of("/\\") != std::string::npos || result.name.front() == '.')
            root.at("name").fail("the name cannot be a file name", "use letters, digits, - and _");
        if (auto const* about = root.find("about")) result.about = about->any_string();
        result.duration = number(root.at("duration"));
        if (!(result.duration > 0))
            root.at("duration").fail("the duration is not above 0", "state it in seconds");
        auto const& initial = root.at("initial");
        only(initial, model_.states);
        for (auto const& s : model_.states) result.initial.push_back(range(initial.at(s.name)));
        auto const& inputs = root.at("inputs");
        only(inputs, model_.inputs);
        for (auto const& i : model_.inputs) result.inputs.push_back(shape(inputs.at(i.name)));
        return result;
    }

private:
    static double number(sivid::json_value const& entry) { return *nearest(entry.number()); }

    static void only(sivid::json_value const& list, std::vector<sivid::name_unit> const& names) {
        for (std::size_t i = 0; i < list.members().size(); ++i)
            if (!sivid::index_of(names, list.name_of(i)))
                list.members()[i].fail(std::string{"unknown name "} +
                                           sivid::in_quotes(list.name_of(i)),
                                       std::string{"the model has: "} + sivid::joined_names(names));
    }

    static sivid::stated_range range(sivid::json_value const& entry) {
        sivid::exact_decimal low, high;
        if (entry.type() == sivid::json_value::kind::array) {
            if (entry.elements().size() != 2)
                entry.fail("a range needs two numbers", "write [lower, upper]");
            low = entry.elements()[0].number();
            high = entry.elements()[1].number();
            if (high < low) entry.fail("lower is above upper", "write [lower, upper]");
        } else {
            low = high = entry.number();
        }
        return {low, high, *sivid::enclose(low, high)};
    }

    static std::vector<double> numbers(sivid::json_value const& list) {
        std::vector<double> result;
        for (auto const& entry : list.elements()) result.push_back(number(entry));
        return result;
    }

    static input_shape shape(sivid::json_value const& entry) {
        using kind = input_shape::kind;
        auto const& name = entry.at("shape").string();
        input_shape s;
        if (name == "constant") {
            entry.allow_only({"shape", "value"});
            s.offset = number(entry.at("value"));
        } else if (name == "sine") {
            entry.allow_only({"shape", "offset", "amplitude", "frequency", "phase"});
            s.shape = kind::sine;
            s.offset = number(entry.at("offset"));
            s.amplitude = number(entry.at("amplitude"));
            s.frequency = number(entry.at("frequency"));
            s.phase = number(entry.at("phase"));
        } else if (name == "ramp") {
            entry.allow_only({"shape", "from", "to", "begin", "end"});
            s.shape = kind::ramp;
            s.from = number(entry.at("from"));
            s.to = number(entry.at("to"));
            s.begin = number(entry.at("begin"));
            s.end = number(entry.at("end"));
            if (!(s.begin < s.end))
                entry.at("end").fail("the ramp ends before it begins", "give begin < end");
        } else if (name == "samples") {
            entry.allow_only({"shape", "t", "values"});
            s.shape = kind::samples;
            s.times = numbers(entry.at("t"));
            s.values = numbers(entry.at("values"));
            if (s.times.empty() || s.times.size() != s.values.size())
                entry.fail("as many values as times are needed, at least one", "correct the lists");
            if (std::adjacent_find(s.times.begin(), s.times.end(), std::greater_equal<>{}) !=
                s.times.end())
                entry.at("t").fail("the times do not increase", "sort them");
        } else {
            entry.at("shape").fail(std::string{"unknown shape "} + sivid::in_quotes(name),
                                   "known here: constant, sine, ramp, samples");
        }
        return s;
    }

    sivid::model_names const& model_;
};

/// Reads a scenario file.
/// @throws sivid::input_error
[[nodiscard]] inline scenario_description read_scenario(std::filesystem::path const& file,
                                                        sivid::model_names const& model) {
    return scenario_reader(model).read(sivid::read_json(file));
}

/// A scenario that is built in: Table 2.4 of the report as S1, S2, S3, and those of `scenarios/`.
struct built_in_scenario {
    std::string_view name, text;
};
/// All of them; the build puts the files of `scenarios/` here.
[[nodiscard]] std::vector<built_in_scenario> const& built_in_scenarios();

/// The scenarios that a command line asks for: "all" (S1, S2, S3), a built-in name, or a file.
/// @throws sivid::input_error
[[nodiscard]] inline std::vector<scenario_description>
find_scenarios(std::string const& wanted, sivid::model_names const& model) {
    std::vector<scenario_description> result;
    std::string known;
    for (auto const& s : built_in_scenarios()) {
        known += std::string{known.empty() ? "" : ", "} + std::string{s.name};
        bool const of_table =
            wanted == "all" && (s.name == "S1" || s.name == "S2" || s.name == "S3");
        if (s.name != wanted && !of_table) continue;
        auto const file = std::string{"scenario "} + std::string{s.name};
        result.push_back(
            scenario_reader(model).read(sivid::json_builder{file}.parse(std::string{s.text})));
    }
    if (!result.empty()) return result;
    if (!std::filesystem::exists(wanted))
        throw sivid::input_error{{.file = wanted},
                                 "no such scenario and no such file",
                                 std::string{"give a JSON file, or one of: all, "} + known};
    return {read_scenario(wanted, model)};
}

} // namespace hovercraft_example

#endif
