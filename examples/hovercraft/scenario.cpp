// SPDX-License-Identifier: MIT
#include "scenario.hpp"

#include <sivid/io/json_document.hpp>

#include <algorithm>
#include <functional>
#include <numbers>

namespace hovercraft_example {

sivid::signal exact_signal(input_shape const& s, double duration) {
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

namespace {

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

} // namespace

scenario_description parse_scenario(std::string const& name, std::string const& text,
                                    sivid::model_names const& model) {
    return scenario_reader(model).read(sivid::parse_json(name, text));
}

scenario_description read_scenario(std::filesystem::path const& file,
                                   sivid::model_names const& model) {
    return scenario_reader(model).read(sivid::read_json(file));
}

std::vector<scenario_description> find_scenarios(std::string const& wanted,
                                                 sivid::model_names const& model) {
    std::vector<scenario_description> result;
    std::string known;
    for (auto const& s : built_in_scenarios()) {
        known += std::string{known.empty() ? "" : ", "} + std::string{s.name};
        bool const of_table =
            wanted == "all" && (s.name == "S1" || s.name == "S2" || s.name == "S3");
        if (s.name != wanted && !of_table) continue;
        auto const file = std::string{"scenario "} + std::string{s.name};
        result.push_back(parse_scenario(file, std::string{s.text}, model));
    }
    if (!result.empty()) return result;
    if (!std::filesystem::exists(wanted))
        throw sivid::input_error{{.file = wanted},
                                 "no such scenario and no such file",
                                 std::string{"give a JSON file, or one of: all, "} + known};
    return {read_scenario(wanted, model)};
}

} // namespace hovercraft_example
