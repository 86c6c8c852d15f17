// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_DATASET_WRITER_HPP
#define SIVID_IO_DATASET_WRITER_HPP

#include <sivid/compiled.hpp>
#include <sivid/io/dataset/model_names.hpp>
#include <sivid/io/dataset_value.hpp>
#include <sivid/io/file_set.hpp>
#include <sivid/io/input_error.hpp>
#include <sivid/io/text/exact_decimal.hpp>
#include <sivid/io/text/json_writer.hpp>
#include <sivid/io/text/text_file.hpp>

#include <algorithm>
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
                                       exact_decimal::shortest(m.time).text(),
                                       " s; leave one of them out")};
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

/// The text of `dataset.json`.
[[nodiscard]] inline std::string dataset_json(dataset const& data, model_names const& model) {
    using layout = json_writer::layout;
    json_writer json;
    auto const range = [&](stated_range const& r) {
        json.begin_array(layout::one_line).decimal(r.lower).decimal(r.upper).end_array();
    };
    json.begin_object();
    json.key("format")
        .string("sivid-dataset-1")
        .key("id")
        .string(data.id)
        .key("model")
        .string(data.model);
    json.key("parameters").begin_object();
    for (auto const& p : data.parameters) {
        json.key(p.name).begin_object(layout::one_line).key("prior");
        range(p.prior);
        if (!p.unit.empty()) json.key("unit").string(p.unit);
        json.end_object();
    }
    json.end_object();
    if (!data.fixed.empty()) {
        json.key("fixed").begin_object();
        for (auto const& f : data.fixed)
            json.key(model.constants.at(f.constant).name).decimal(f.stated);
        json.end_object();
    }
    json.key("max_outlier_fraction").decimal(data.max_outlier_fraction);
    json.key("scenarios").begin_array();
    for (auto const& s : data.scenarios) {
        bool const hold =
            !s.inputs.empty() && s.inputs.front().signal.kind() == interpolation::hold;
        json.begin_object();
        json.key("name").string(s.name).key("role").string(
            s.role == scenario_role::fit ? "fit" : "holdout");
        json.key("duration").nearest(s.duration);
        json.key("inputs")
            .string(s.name + ".inputs.csv")
            .key("interpolation")
            .string(hold ? "hold" : "linear");
        json.key("measurements").string(s.name + ".measurements.csv");
        json.key("initial").begin_object(layout::one_line);
        for (std::size_t i = 0; i < s.initial.size(); ++i) {
            if (!s.initial[i].stated) continue;
            json.key(model.states.at(i).name);
            range(*s.initial[i].stated);
        }
        json.end_object().end_object();
    }
    json.end_array();
    if (!data.effects.empty()) {
        json.key("effects").begin_object();
        for (auto const& e : data.effects) {
            json.key(e.name);
            if (e.off) {
                json.string("off");
                continue;
            }
            json.begin_object(layout::one_line);
            for (auto const& p : e.priors) {
                json.key(p.parameter).begin_array(layout::one_line);
                for (auto const* end : {&p.lower, &p.upper})
                    json.decimal(exact_decimal::parse(*end).value());
                json.end_array();
            }
            json.end_object();
        }
        json.end_object();
    }
    if (!data.assumptions.empty()) {
        json.key("assumptions").begin_array();
        for (auto const& a : data.assumptions) json.string(a);
        json.end_array();
    }
    json.end_object();
    return json.text();
}

/// Adds the files of a data set in the format sivid-dataset-1, dataset.json last.
/// @given  as read_dataset returns it: one interpolation in a scenario, indices within the model's
/// (trusted)
/// @throws output_error  as `file_set::add` and `measurements_csv`
SIVID_DECL void add_dataset(file_set& files, dataset const& data, model_names const& model);

/// Stores a data set as a folder in the format sivid-dataset-1; read_dataset gives the same value
/// back. All files take their names together (`file_set`): a full disk leaves what was there, and a
/// run that was killed leaves nothing that reads as complete.
/// @given  as for `add_dataset`
/// @throws output_error  also as `measurements_csv`; nothing has changed then
SIVID_DECL void write_dataset(dataset const& data, model_names const& model,
                              std::filesystem::path const& folder);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/io/impl/dataset_writer.ipp>
#endif

#endif // SIVID_IO_DATASET_WRITER_HPP
