// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_IMPL_SCENARIO_IPP
#define SIVID_IO_IMPL_SCENARIO_IPP

#include <sivid/io/scenario.hpp>

#include <sivid/compiled.hpp>
#include <sivid/io/dataset/mapping_entries.hpp>
#include <sivid/io/text/json_document.hpp>
#include <sivid/io/text/json_writer.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace sivid {

SIVID_DECL signal exact_signal(input_shape const& s, double duration) {
    using kind = input_shape::kind;
    switch (s.shape) {
    case kind::constant:
        return sampled_signal({0}, {s.offset}, interpolation::hold);
    case kind::sine:
        return analytic_signal::from([&s](auto const& t) {
            using std::atan;
            using T = std::remove_cvref_t<decltype(t)>;
            T const turn = 8 * atan(T(1)); // 2 pi, enclosed
            return s.offset + s.amplitude * sin(turn * s.frequency * t + s.phase);
        });
    case kind::ramp:
        return sampled_signal({s.begin - 1, s.begin, s.end, std::max(s.end, duration) + 1},
                              {s.from, s.from, s.to, s.to}, interpolation::linear);
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
    return sampled_signal(std::move(times), std::move(values), interpolation::linear);
}

namespace io_detail {

class scenario_reader {
public:
    explicit scenario_reader(model_names const& model) : model_{model} {}

    /// @throws input_error that says what is wrong and where
    [[nodiscard]] scenario_description read(json_value const& root) const {
        root.allow_only({"format", "name", "about", "duration", "initial", "inputs"});
        auto const& format = root.at("format").string();
        if (format != "sivid-scenario-1" && format != "hovercraft-scenario-1")
            root.at("format").fail("unknown format", "write sivid-scenario-1");
        scenario_description result;
        result.name = mapping_entries::file_name(root.at("name"));
        if (auto const* about = root.find("about")) result.about = about->any_string();
        result.duration = *nearest(mapping_entries::duration(root.at("duration")));
        auto const& initial = root.at("initial");
        only(initial, model_.states);
        for (auto const& s : model_.states) result.initial.push_back(range(initial.at(s.name)));
        auto const& inputs = root.at("inputs");
        only(inputs, model_.inputs);
        for (auto const& i : model_.inputs) result.inputs.push_back(shape(inputs.at(i.name)));
        return result;
    }

private:
    static double number(json_value const& entry) { return *nearest(entry.number()); }

    static void only(json_value const& list, std::vector<name_unit> const& names) {
        for (std::size_t i = 0; i < list.members().size(); ++i)
            (void)mapping_entries::index_of(names, list.name_of(i), list.members()[i], "name");
    }

    static stated_range range(json_value const& entry) {
        auto const [low, high] = entry.type() == json_value::kind::array
                                     ? mapping_entries::ends(entry)
                                     : std::pair{entry.number(), entry.number()};
        return {low, high, *enclose(low, high)};
    }

    static std::vector<double> numbers(json_value const& list) {
        std::vector<double> result;
        for (auto const& entry : list.elements()) result.push_back(number(entry));
        return result;
    }

    static input_shape shape(json_value const& entry) {
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
                entry.at("t").fail("the times do not increase", "correct them, each time once");
        } else {
            entry.at("shape").fail(std::string{"unknown shape "} + in_quotes(name),
                                   "known here: constant, sine, ramp, samples");
        }
        return s;
    }

    model_names const& model_;
};

} // namespace io_detail

SIVID_DECL scenario_description parse_scenario(std::string const& name, std::string const& text,
                                               model_names const& model) {
    return io_detail::scenario_reader(model).read(parse_json(name, text));
}

SIVID_DECL std::string scenario_json(scenario_description const& s, model_names const& model) {
    using kind = input_shape::kind;
    json_writer json;
    json.begin_object().members("format", "sivid-scenario-1", "name", s.name, "about", s.about);
    json.members("duration", s.duration).key("initial").begin_object();
    for (std::size_t i = 0; i < model.states.size(); ++i) {
        auto const& start = s.initial[i];
        json.key(model.states[i].name);
        if (start.lower == start.upper) {
            json.value(start.lower);
        } else {
            json.value(std::array{start.lower, start.upper});
        }
    }
    json.end_object().key("inputs").begin_object();
    for (std::size_t i = 0; i < model.inputs.size(); ++i) {
        auto const& u = s.inputs[i];
        json.key(model.inputs[i].name);
        switch (u.shape) {
        case kind::constant:
            json.object("shape", "constant", "value", u.offset);
            break;
        case kind::sine:
            json.object("shape", "sine", "offset", u.offset, "amplitude", u.amplitude, "frequency",
                        u.frequency, "phase", u.phase);
            break;
        case kind::ramp:
            json.object("shape", "ramp", "from", u.from, "to", u.to, "begin", u.begin, "end",
                        u.end);
            break;
        case kind::samples:
            json.object("shape", "samples", "t", u.times, "values", u.values);
            break;
        }
    }
    json.end_object().end_object();
    return json.text();
}

SIVID_DECL scenario_description read_scenario(std::filesystem::path const& file,
                                              model_names const& model) {
    return io_detail::scenario_reader(model).read(read_json(file));
}

} // namespace sivid

#endif
