// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_DATASET_IMPORT_HPP
#define SIVID_IO_DATASET_IMPORT_HPP

#include <sivid/io/import_mapping_reader.hpp>
#include <sivid/io/scenario_import.hpp>
#include <sivid/io/serial_log.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// What an import gives.
struct imported_dataset {
    dataset data;
    model_names names; ///< as many of the model's names as the data set uses
    import_protocol protocol;
};

/// Turns recorded files into a data set; users call import_dataset.
class dataset_import {
public:
    explicit dataset_import(import_mapping const& mapping) : mapping_{mapping} {}

    [[nodiscard]] imported_dataset run() {
        result_.names = mapping_.names();
        result_.protocol.dataset = mapping_.id;
        result_.protocol.mapping = mapping_.file.filename().string();
        for (auto const& s : mapping_.scenarios) read(s);
        check_names();
        for (auto const& s : open_) propose(s.inputs, true);
        for (auto const& s : open_) propose(s.channels, false);

        auto& data = result_.data;
        data.id = mapping_.id;
        data.model = mapping_.model;
        for (auto const& p : mapping_.parameters)
            data.parameters.push_back(
                {*index_of(result_.names.constants, p.name), p.name, p.unit, p.prior});
        for (auto const& f : mapping_.fixed)
            data.fixed.push_back(
                {*index_of(result_.names.constants, f.name), f.value, f.enclosure});
        data.max_outlier_fraction = mapping_.max_outlier_fraction;
        for (auto const& s : open_) data.scenarios.push_back(closed(s));
        for (auto const& s : data.scenarios)
            if (s.role == scenario_role::fit) return std::move(result_);
        throw input_error{
            {.file = mapping_.file.string(), .pointer = "/scenarios", .is_json = true},
            "no scenario with the role fit is left",
            "see what the log's breaks leave"};
    }

private:
    using kind = import_protocol::kind;

    void read(scenario_mapping const& s) {
        auto const text = read_text(s.file);
        auto& protocol = result_.protocol;
        auto const stretches = s.form.from == source_form::kind::csv
                                   ? std::vector{read_recorded_table(s, text, protocol)}
                                   : read_serial_log(s, text, protocol);
        bool const only = stretches.size() == 1;
        auto const before = open_.size();
        for (std::size_t i = 0; i < stretches.size(); ++i) {
            auto const name = only ? s.name : s.name + "-" + std::to_string(i + 1);
            try {
                open_.push_back(scenario_import{s, name, only, protocol}.read(stretches[i]));
            } catch (input_error const& e) {
                if (only) throw;
                for (auto const& row : stretches[i].rows)
                    protocol.add(kind::dropped, name, "",
                                 text_of("no scenario can be made: ", e.problem()), row.line);
                continue;
            }
            auto& last = open_.back();
            last.after_break = i > 0;
            if (last.after_break)
                protocol.add(kind::changed, name, "",
                             "begins after a break: initial_after_break holds, not initial");
            import_protocol::scenario_summary summary;
            summary.name = name;
            summary.role = s.role == scenario_role::fit ? "fit" : "holdout";
            summary.file = s.file.filename().string();
            summary.lines = lines_of(text).size();
            summary.first = last.first_line;
            summary.last = last.last_line;
            summary.rows = last.rows;
            summary.measurements = last.measurement_count();
            summary.duration = exact_decimal::shortest(*nearest(last.duration)).text();
            protocol.scenarios.push_back(std::move(summary));
        }
        if (open_.size() == before)
            throw input_error{{.file = s.file.string()},
                              "no stretch of the log makes a scenario",
                              "check the columns, \"longest_gap\", \"gap\" and \"restart\""};
    }

    /// A split may give a name that another scenario has.
    void check_names() const {
        for (std::size_t i = 0; i < open_.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                if (open_[i].name == open_[j].name)
                    throw input_error{
                        open_[i].mapping->place,
                        text_of("two scenarios are called ", in_quotes(open_[i].name)),
                        "rename one: stretches of a log are numbered -1, -2, ..."};
    }

    /// Proposes the open bounds, once for each quantity: the largest of all fit scenarios, since it
    /// is one instrument and the data held out must not enter.
    void propose(std::vector<imported_quantity> const& list, bool inputs) {
        for (auto const& q : list) {
            if (q.mapping->error.from != bound_source::kind::proposed) continue;
            if (proposed_.count({inputs, q.mapping->name}) > 0) continue;
            import_protocol::proposed_bound note{q.mapping->name, q.mapping->unit, "", {}};
            double bound = 0;
            for (auto const& other : open_) {
                if (other.mapping->role != scenario_role::fit) continue;
                for (auto const& same : inputs ? other.inputs : other.channels) {
                    if (same.mapping->name != q.mapping->name ||
                        same.mapping->error.from != bound_source::kind::proposed)
                        continue;
                    note.scenarios.emplace_back(other.name, proposal_for(same));
                    warn(other, q.mapping->name, note.scenarios.back().second);
                    bound = std::max(bound, note.scenarios.back().second.bound);
                }
            }
            if (!(bound > 0)) {
                std::string why;
                for (auto const& [name, p] : note.scenarios)
                    why += (why.empty() ? ": " : "; ") + p.refusal + " (" + name + ")";
                throw input_error{q.mapping->error.place,
                                  text_of("no error bound of ", in_quotes(q.mapping->name),
                                          " can be proposed from the fit scenarios", why),
                                  "state it as a number"};
            }
            auto const rounded = rounded_up(exact_decimal::shortest(bound), 3);
            note.bound = rounded.text();
            proposed_[{inputs, q.mapping->name}] = rounded;
            result_.protocol.bounds.push_back(std::move(note));
        }
    }

    /// Says where a proposed bound leaves more outliers than the data set allows.
    void warn(open_scenario const& s, std::string const& name, error_bound_proposal const& p) {
        if (p.outliers > mapping_.max_outlier_fraction.times(s.measurement_count()).floor())
            result_.protocol.add(
                kind::assumed, s.name, name,
                text_of(std::to_string(p.outliers),
                        " samples may violate the proposed bound, more than "
                        "max_outlier_fraction allows: raise it, or state a bound"));
    }

    /// The bound of a sample with what its conversion adds.
    [[nodiscard]] exact_decimal bound(imported_quantity const& q, imported_sample const& sample,
                                      bool input) const {
        auto result = sample.error;
        if (q.mapping->error.from == bound_source::kind::number) result = q.mapping->error.number;
        if (q.mapping->error.from == bound_source::kind::proposed)
            result = proposed_.at({input, q.mapping->name});
        auto more = sample.reading.rounding;
        if (input) // the file means the nearest double
            more = more +
                   magnitude(exact_value(*nearest(sample.reading.value)) - sample.reading.value);
        return more.is_zero() ? result : rounded_up(result + more, 9);
    }

    [[nodiscard]] scenario closed(open_scenario const& s) const {
        scenario result;
        result.name = s.name;
        result.role = s.mapping->role;
        result.duration = *nearest(s.duration);
        for (auto const& name : result_.names.inputs) {
            auto const q = std::find_if(s.inputs.begin(), s.inputs.end(), [&](auto const& i) {
                return i.mapping->name == name.name;
            });
            dataset_input input;
            std::vector<double> times, values;
            for (auto const& sample : q->samples) {
                times.push_back(*nearest(sample.time));
                values.push_back(*nearest(sample.reading.value));
                if (q->mapping->error.from == bound_source::kind::none) continue;
                input.stated_error.push_back(bound(*q, sample, true));
                input.error.push_back(upper(enclosed(s, sample, input.stated_error.back())));
            }
            input.signal = sampled_signal{std::move(times), std::move(values), s.mapping->between};
            result.inputs.push_back(std::move(input));
        }
        struct entry {
            measurement m;
            stated_measurement stated;
        };
        std::vector<entry> all;
        for (auto const& q : s.channels)
            for (auto const& sample : q.samples) {
                auto error = bound(q, sample, false);
                auto const& value = sample.reading.value;
                auto const ends = enclose(value - error, value + error);
                if (!ends) (void)enclosed(s, sample, error + magnitude(value));
                all.push_back({{*nearest(sample.time),
                                *index_of(result_.names.channels, q.mapping->name), *ends},
                               {value, error}});
            }
        std::sort(all.begin(), all.end(), [](entry const& a, entry const& b) {
            return std::pair{a.m.time, a.m.channel} < std::pair{b.m.time, b.m.channel};
        });
        for (auto& e : all) {
            result.measurements.push_back(e.m);
            result.stated.push_back(std::move(e.stated));
        }
        result.initial.assign(result_.names.states.size(), {interval::whole(), std::nullopt});
        for (auto const& r : s.after_break ? s.mapping->initial_after_break : s.mapping->initial)
            result.initial[*index_of(result_.names.states, r.name)] = {r.range.enclosure, r.range};
        return result;
    }

    static interval enclosed(open_scenario const& s, imported_sample const& sample,
                             exact_decimal const& x) {
        auto const result = enclose(x);
        if (!result)
            throw input_error{{.file = s.mapping->file.string(), .line = sample.line},
                              "value and error bound are beyond the range of double",
                              "check factor and error"};
        return *result;
    }

    import_mapping const& mapping_;
    std::vector<open_scenario> open_;
    std::map<std::pair<bool, std::string>, exact_decimal> proposed_;
    imported_dataset result_;
};

/// Imports the recorded files that a mapping names.
/// @guarantee  every reading that is in the data set is in it with the converted decimal, within
/// its
///             bound enlarged by what the conversion rounds; every line that is not has a note
/// @throws input_error
[[nodiscard]] inline imported_dataset import_dataset(import_mapping const& mapping) {
    return dataset_import{mapping}.run();
}

} // namespace sivid

#endif // SIVID_IO_DATASET_IMPORT_HPP
