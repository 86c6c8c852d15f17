// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_DATASET_WRITER_HPP
#define SIVID_IO_DATASET_WRITER_HPP

#include <sivid/io/dataset/model_names.hpp>
#include <sivid/io/dataset_value.hpp>
#include <sivid/io/file_set.hpp>
#include <sivid/io/input_error.hpp>
#include <sivid/io/text/exact_decimal.hpp>
#include <sivid/io/text/json_writer.hpp>
#include <sivid/io/text/text_file.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace sivid {

/// The text of `<scenario>.inputs.csv`. Inputs with different knots share one table; where an input
/// has no knot its cell is empty.
[[nodiscard]] inline std::string inputs_csv(scenario const& s, model_names const& model) {
    std::string text = "t";
    std::set<double> times{0.0, s.duration}; // of an input-free model; otherwise of the knots alone
    if (!s.inputs.empty()) times.clear();
    for (std::size_t i = 0; i < s.inputs.size(); ++i) {
        auto const& name = model.inputs.at(i).name;
        text += "," + name + (s.inputs[i].error.empty() ? "" : "," + name + "_err");
        times.insert(s.inputs[i].signal.times().begin(), s.inputs[i].signal.times().end());
    }
    text += "\n";
    std::vector<std::size_t> next(s.inputs.size(), 0);
    for (double const t : times) {
        text += exact_decimal::shortest(t).text();
        for (std::size_t i = 0; i < s.inputs.size(); ++i) {
            auto const& input = s.inputs[i];
            auto& k = next[i];
            bool const here = k < input.signal.times().size() && input.signal.times()[k] == t;
            text += ",";
            if (here) text += exact_decimal::shortest(input.signal.values()[k]).text();
            if (!input.error.empty()) {
                text += ",";
                if (here) text += input.stated_error.at(k).text();
            }
            if (here) ++k;
        }
        text += "\n";
    }
    return text;
}

/// The text of `<scenario>.measurements.csv`, with the channels that occur.
/// @throws output_error  for two measurements of a channel at one time: the table has one line for
///                       each time, and neither may be lost
[[nodiscard]] inline std::string measurements_csv(scenario const& s, model_names const& model) {
    std::set<std::size_t> channels;
    std::map<double, std::map<std::size_t, stated_measurement const*>> rows;
    for (std::size_t i = 0; i < s.measurements.size(); ++i) {
        auto const& m = s.measurements[i];
        channels.insert(m.channel);
        if (!rows[m.time].try_emplace(m.channel, &s.stated.at(i)).second)
            throw output_error{text_of(s.name, ".measurements.csv: two measurements of ",
                                       in_quotes(model.channels.at(m.channel).name), " at ",
                                       exact_decimal::shortest(m.time).text(), " ", model.time_unit,
                                       "; leave one of them out")};
    }
    std::string text = "t";
    for (auto c : channels)
        text += "," + model.channels.at(c).name + "," + model.channels.at(c).name + "_err";
    text += "\n";
    for (auto const& [time, cells] : rows) {
        text += exact_decimal::shortest(time).text();
        for (auto c : channels) {
            auto const cell = cells.find(c);
            text += cell == cells.end()
                        ? ",,"
                        : text_of(",", cell->second->value.text(), ",", cell->second->error.text());
        }
        text += "\n";
    }
    return text;
}

/// Adds what stands where samples of inputs are missing, if any are.
inline void add_bridged(json_writer& json, scenario const& s, model_names const& model) {
    if (std::all_of(s.inputs.begin(), s.inputs.end(),
                    [](auto const& input) { return input.bridged.empty(); }))
        return;
    json.key("bridged").begin_object();
    for (std::size_t i = 0; i < s.inputs.size(); ++i) {
        auto const& input = s.inputs[i];
        if (input.bridged.empty()) continue;
        json.key(model.inputs.at(i).name).begin_object(json_writer::layout::one_line);
        json.members("samples", input.missing).list("gaps", input.bridged, [](auto const& gap) {
            return std::array{gap.first, gap.second};
        });
        json.end_object();
    }
    json.end_object();
}

namespace io_detail {

/// Adds the constants that are fixed, by name, if any are.
inline void add_fixed(json_writer& json, dataset const& data, model_names const& model) {
    if (data.fixed.empty()) return;
    json.key("fixed").begin_object();
    for (auto const& f : data.fixed) {
        json.key(model.constants.at(f.constant).name);
        if (f.unit.empty())
            json.value(f.stated);
        else
            json.object("value", f.stated, "unit", f.unit);
    }
    json.end_object();
}

/// Adds a scenario with the names of its tables.
inline void add_scenario(json_writer& json, scenario const& s, model_names const& model) {
    bool const hold = !s.inputs.empty() && s.inputs.front().signal.kind() == interpolation::hold;
    json.begin_object().members("name", s.name);
    json.members("role", s.role == scenario_role::fit ? "fit" : "holdout");
    json.members("duration", s.duration, "inputs", s.name + ".inputs.csv");
    json.members("interpolation", hold ? "hold" : "linear");
    json.members("measurements", s.name + ".measurements.csv");
    json.key("initial").begin_object(json_writer::layout::one_line);
    for (std::size_t i = 0; i < s.initial.size(); ++i) {
        auto const& [enclosure, stated, unit] = s.initial[i];
        if (!stated) continue;
        std::array const range{stated->lower, stated->upper};
        json.key(model.states.at(i).name);
        if (unit.empty())
            json.value(range);
        else
            json.object("range", range, "unit", unit);
    }
    json.end_object();
    add_bridged(json, s, model);
    json.end_object();
}

} // namespace io_detail

/// The text of `dataset.json`, with the units of what the tables hold: those of `model`.
[[nodiscard]] inline std::string dataset_json(dataset const& data, model_names const& model) {
    constexpr auto one_line = json_writer::layout::one_line;
    json_writer json;
    json.begin_object().members("format", "sivid-dataset-1", "id", data.id, "model", data.model);
    json.named("parameters", data.parameters, [&](dataset_parameter const& p) {
        json.begin_object(one_line).members("prior", std::array{p.prior.lower, p.prior.upper});
        if (!p.unit.empty()) json.members("unit", p.unit);
        json.end_object();
    });
    io_detail::add_fixed(json, data, model);
    json.members("max_outlier_fraction", data.max_outlier_fraction);
    json.members("time_unit", model.time_unit);
    auto const units = [&](char const* key, std::vector<name_unit> const& names) {
        auto const stated = [](name_unit const& q) { return !q.unit.empty(); };
        if (std::none_of(names.begin(), names.end(), stated)) return;
        json.key(key).begin_object(one_line);
        for (auto const& q : names)
            if (stated(q)) json.members(q.name, q.unit);
        json.end_object();
    };
    units("channel_units", model.channels);
    units("input_units", model.inputs);
    json.list("scenarios", data.scenarios,
              [&](scenario const& s) { io_detail::add_scenario(json, s, model); });
    if (!data.effects.empty()) {
        json.named("effects", data.effects, [&](dataset_effect const& e) {
            if (e.off) {
                json.value("off");
                return;
            }
            json.begin_object(one_line);
            for (auto const& p : e.priors)
                json.members(p.parameter, std::array{exact_decimal::parse(p.lower).value(),
                                                     exact_decimal::parse(p.upper).value()});
            json.end_object();
        });
    }
    if (!data.assumptions.empty()) json.members("assumptions", data.assumptions);
    json.end_object();
    return json.text();
}

/// Adds the files of a data set in the format sivid-dataset-1, dataset.json last.
/// @given  as read_dataset returns it: one interpolation in a scenario, indices within the model's
/// (trusted)
/// @throws output_error  as `file_set::add` and `measurements_csv`
inline void add_dataset(file_set& files, dataset const& data, model_names const& model) {
    for (auto const& s : data.scenarios) {
        files.add(s.name + ".inputs.csv", inputs_csv(s, model));
        files.add(s.name + ".measurements.csv", measurements_csv(s, model));
    }
    files.add("dataset.json", dataset_json(data, model));
}

/// Stores a data set as a folder in the format sivid-dataset-1; read_dataset gives the same value
/// back. All files take their names together (`file_set`): a full disk leaves what was there, and a
/// run that was killed leaves nothing that reads as complete.
/// @given  as for `add_dataset`
/// @throws output_error  also as `measurements_csv`; nothing has changed then
inline void write_dataset(dataset const& data, model_names const& model,
                          std::filesystem::path const& folder) {
    file_set files(folder);
    add_dataset(files, data, model);
    files.commit();
}

} // namespace sivid

#endif // SIVID_IO_DATASET_WRITER_HPP
