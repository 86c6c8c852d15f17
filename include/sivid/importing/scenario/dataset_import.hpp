// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_SCENARIO_DATASET_IMPORT_HPP
#define SIVID_IMPORTING_SCENARIO_DATASET_IMPORT_HPP

#include <sivid/importing/mapping/import_mapping_reader.hpp>
#include <sivid/importing/scenario/detail/input_bridge.hpp>
#include <sivid/importing/scenario/detail/scenario_import.hpp>
#include <sivid/importing/scenario/detail/start_proposal.hpp>
#include <sivid/importing/table/recorded_files.hpp>
#include <sivid/number/text/joined.hpp>
#include <sivid/number/text/nearest_text.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
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
    explicit dataset_import(import_mapping const& mapping, import_tools tools = {})
        : mapping_{mapping}, files_{mapping, std::move(tools)} {}

    [[nodiscard]] imported_dataset run() {
        result_.names = mapping_.names();
        result_.protocol.dataset = mapping_.id;
        result_.protocol.mapping = mapping_.file.filename().string();
        for (auto const& s : mapping_.scenarios) read(s);
        check_names();
        for (auto const& s : mapping_.scenarios) {
            require_bridges(s, open_, result_.protocol);
            for (auto const& f : s.further) require_bridges(f, open_, result_.protocol);
        }
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
                {*index_of(result_.names.constants, f.name), f.value, f.enclosure, f.unit});
        data.max_outlier_fraction = mapping_.max_outlier_fraction;
        data.effects = mapping_.effects;
        for (auto const& s : open_) data.scenarios.push_back(closed(s));
        check_starts();
        for (std::size_t i = 0; i < result_.names.inputs.size(); ++i) compare_kinds(i);
        for (auto const& n : result_.protocol.notes())
            if (n.what == kind::assumed)
                data.assumptions.push_back(printable_text(
                    text_of(n.scenario, ": ", n.field, n.field.empty() ? "" : ": ", n.reason),
                    1000));
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
        auto const& source = files_.read(s);
        auto const& stretches = source.stretches;
        auto& protocol = result_.protocol;
        take_over(source.notes, s.name);
        bool const only = stretches.size() == 1;
        std::vector<recorded_table const*> further;
        for (auto const& f : s.further) {
            auto const& other = files_.read(s, f);
            take_over(other.notes, f.name);
            if (!only || other.stretches.size() != 1)
                throw input_error{f.place, "one of the files is split into stretches",
                                  "cut it, and import each stretch with what belongs to it"};
            further.push_back(&other.stretches.front());
        }
        auto const before = open_.size();
        std::optional<input_error> first;
        for (std::size_t i = 0; i < stretches.size(); ++i) {
            auto const name = only ? s.name : s.name + "-" + std::to_string(i + 1);
            std::vector<open_scenario> next;
            try {
                next = scenario_import{s, name, only, protocol}.read(stretches[i], further);
            } catch (input_error const& e) {
                if (only) throw;
                if (!first) first = e;
                for (auto const& row : stretches[i].rows)
                    protocol.add(kind::dropped, name, "",
                                 text_of("no scenario can be made: ", e.problem()), row.line);
                continue;
            }
            if (i > 0)
                protocol.add(kind::changed, name, "",
                             "begins after a break: initial_after_break holds, not initial");
            for (auto& scenario : next) {
                scenario.after_break = i > 0;
                add_summary(scenario, source.lines);
                open_.push_back(std::move(scenario));
            }
        }
        if (open_.size() == before)
            throw input_error{first->place(),
                              "no stretch of the log makes a scenario; of the first one: " +
                                  first->problem(),
                              first->remedy()};
    }
    void take_over(std::vector<import_protocol::note> const& notes, std::string const& scenario) {
        auto& protocol = result_.protocol;
        for (auto const& n : notes) {
            if (n.lines.empty()) protocol.add(n.what, scenario, n.field, n.reason);
            for (auto const line : n.lines) protocol.add(n.what, scenario, n.field, n.reason, line);
        }
    }
    void add_summary(open_scenario const& s, std::size_t lines) {
        import_protocol::scenario_summary summary;
        summary.name = s.name;
        if (s.stretch != s.name) summary.stretch = s.stretch;
        summary.role = s.role == scenario_role::fit ? "fit" : "holdout";
        summary.file = s.mapping->file.filename().string();
        summary.lines = lines;
        summary.first = s.first_line;
        summary.last = s.last_line;
        summary.rows = s.rows;
        summary.measurements = s.measurement_count();
        summary.begin = exact_decimal::shortest(*nearest(s.begin)).text();
        summary.duration = exact_decimal::shortest(*nearest(s.duration)).text();
        result_.protocol.scenarios.push_back(std::move(summary));
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

    /// Candidates for bounds, and the open ones, once for each quantity: of all fit scenarios, as
    /// it is one instrument and the data held out must not enter.
    void propose(std::vector<imported_quantity> const& list, bool inputs) {
        for (auto const& q : list) {
            auto const& name = q.mapping->name;
            if (q.mapping->error.from == bound_source::kind::none) continue;
            if (!suggested_.insert({inputs, name}).second) continue;
            import_protocol::suggested_bound note{name, q.mapping->unit, "", {}};
            quantity_mapping const* open = nullptr;
            std::vector<recorded_series> records;
            std::string first; // stretch of them
            for (auto const& other : open_) {
                for (auto const& same : inputs ? other.inputs : other.channels) {
                    if (same.mapping->name != name) continue;
                    bool const proposed = same.mapping->error.from == bound_source::kind::proposed;
                    if (proposed) open = same.mapping;
                    if (other.role != scenario_role::fit) continue;
                    if (records.empty()) first = other.stretch;
                    records.push_back(series_of(same, other));
                    if (proposed) warn(other, records.back(), name);
                }
            }
            note.candidates = error_bound_candidates(records);
            if (!inputs && !records.empty()) warn_of_steps(*q.mapping, note.candidates, first);
            if (open != nullptr) {
                auto const near =
                    std::ranges::find(note.candidates, "neighbours", &bound_candidate::from);
                bool const known = near != note.candidates.end();
                if (!known || !(near->bound > 0))
                    throw input_error{
                        open->error.place,
                        text_of("no error bound of ", in_quotes(name),
                                " can be proposed from the fit scenarios: ",
                                known ? joined(near->rests_on, "; ") : "there are none"),
                        "state it as a number"};
                auto const rounded = rounded_up(exact_decimal::shortest(near->bound), 3);
                note.bound = rounded.text();
                proposed_[{inputs, name}] = rounded;
            }
            result_.protocol.bounds.push_back(std::move(note));
        }
    }
    /// With the inputs of its scenario for the command.
    [[nodiscard]] static recorded_series series_of(imported_quantity const& q,
                                                   open_scenario const& s) {
        recorded_series result{s.name, {}, {}, {}};
        for (auto const& sample : q.samples) {
            result.times.push_back(*nearest(sample.time));
            result.values.push_back(*nearest(sample.reading.value));
        }
        for (auto const& u : s.inputs)
            for (auto const& sample : u.samples)
                result.command.insert(result.command.end(),
                                      {*nearest(sample.time), *nearest(sample.reading.value)});
        return result;
    }

    /// Says where a proposed bound leaves more outliers than the data set allows.
    void warn(open_scenario const& s, recorded_series const& r, std::string const& name) {
        auto const p = propose_error_bound(r.times, r.values);
        if (p.outliers > mapping_.max_outlier_fraction.times(s.reading_count()).floor())
            result_.protocol.add(
                kind::assumed, s.stretch, name,
                text_of(std::to_string(p.outliers),
                        " samples may violate the proposed bound, more than "
                        "max_outlier_fraction allows: raise it, or state a bound"));
    }

    /// Says where a stated bound of a channel is less than what its readings are rounded by.
    void warn_of_steps(quantity_mapping const& q, std::vector<bound_candidate> const& candidates,
                       std::string const& stretch) {
        auto const step = std::ranges::find(candidates, "step", &bound_candidate::from);
        if (q.error.from != bound_source::kind::number || step == candidates.end() ||
            !(*nearest(q.error.number) < step->bound * (1 - 1e-9)))
            return;
        result_.protocol.add(kind::assumed, stretch, q.name,
                             text_of("the stated bound ", q.error.number.text(),
                                     " is less than half a step of its readings, ",
                                     nearest_text(step->bound, 3),
                                     ": that holds only where nothing was rounded"));
    }
    /// The bound of a sample with what its conversion adds.
    [[nodiscard]] exact_decimal bound(imported_quantity const& q, imported_sample const& sample,
                                      bool input) const {
        auto result = sample.error;
        if (q.mapping->error.from == bound_source::kind::number) result = q.mapping->error.number;
        if (q.mapping->error.from == bound_source::kind::proposed)
            result = proposed_.at({input, q.mapping->name});
        auto more = sample.reading.rounding + sample.late;
        if (input) // the file means the nearest double
            more = more + magnitude(exact_decimal::of(*nearest(sample.reading.value)) -
                                    sample.reading.value);
        return more.is_zero() ? result : rounded_up(result + more, 9);
    }

    [[nodiscard]] scenario closed(open_scenario const& s) {
        scenario result;
        result.name = s.name;
        result.role = s.role;
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
                input.error.push_back(upper(enclosed(*q, sample, input.stated_error.back())));
            }
            bridge(s, *q, input);
            input.signal = sampled_signal{std::move(times), std::move(values), s.mapping->between};
            result.inputs.push_back(std::move(input));
        }
        struct entry {
            measurement m;
            stated_measurement stated;
        };
        std::vector<entry> all;
        for (auto const& q : s.channels)
            for (std::size_t k = 0; k < q.samples.size(); k += s.mapping->thin) {
                auto r = reading(q, q.samples[k], q.mapping->model_error);
                all.push_back(
                    {{r.time, *index_of(result_.names.channels, q.mapping->name), r.bound},
                     {std::move(r.value), std::move(r.error)}});
            }
        std::sort(all.begin(), all.end(), [](entry const& a, entry const& b) {
            return std::pair{a.m.time, a.m.channel} < std::pair{b.m.time, b.m.channel};
        });
        for (auto& e : all) {
            result.measurements.push_back(e.m);
            result.stated.push_back(std::move(e.stated));
        }
        result.initial.assign(result_.names.states.size(), {interval::whole(), std::nullopt});
        for (auto const* m : starts_of(s))
            if (auto const range = start(s, *m))
                result.initial[*index_of(result_.names.states, m->name)] = {range->enclosure, range,
                                                                            s.mapping->unit_of(*m)};
        check_budget(s);
        return result;
    }

    [[nodiscard]] start_reading reading(imported_quantity const& q, imported_sample const& sample,
                                        exact_decimal const& more = {}) const {
        auto const& value = sample.reading.value;
        auto error = bound(q, sample, false) + more;
        auto const ends = enclose(value - error, value + error);
        if (!ends) (void)enclosed(q, sample, error + magnitude(value));
        return {*nearest(sample.time), value, std::move(error), *ends};
    }

    /// What the mapping says of each state where a scenario begins. What it states for t = 0 does
    /// not hold for a later window; what it proposes holds everywhere.
    [[nodiscard]] static std::vector<mapped_start const*> starts_of(open_scenario const& s) {
        std::vector<mapped_start const*> result;
        auto const add = [&](std::vector<mapped_start> const& list, bool stated) {
            for (auto const& m : list)
                if ((stated || m.from != mapped_start::kind::stated) &&
                    std::none_of(result.begin(), result.end(),
                                 [&](auto const* other) { return other->name == m.name; }))
                    result.push_back(&m);
        };
        bool const first = s.begin.is_zero();
        if (s.mapping->windows) add(s.mapping->windows->initial, true);
        if (s.after_break) add(s.mapping->initial_after_break, first);
        add(s.mapping->initial, first && !s.after_break);
        return result;
    }

    /// Where a state starts; nothing: the readings do not say it, which is noted.
    [[nodiscard]] std::optional<stated_range> start(open_scenario const& s, mapped_start const& m) {
        if (m.from == mapped_start::kind::stated) return m.range;
        auto const q = std::find_if(s.channels.begin(), s.channels.end(),
                                    [&](auto const& c) { return c.mapping->name == m.channel; });
        std::vector<start_reading> readings;
        if (m.within)
            for (auto const& sample : q->before) readings.push_back(reading(*q, sample));
        for (auto const& sample : q->samples) readings.push_back(reading(*q, sample));
        auto const& fraction = mapping_.max_outlier_fraction;
        auto const found = propose_start(m, readings, fraction.times(s.reading_count()).floor());
        bool const rate = m.from == mapped_start::kind::rate;
        auto& unknown = unknown_starts_[&m];
        if (!found.range) {
            auto const why = text_of("the start of ", in_quotes(m.name), " in ", in_quotes(s.name),
                                     ": ", found.refusal);
            if (found.contradicted)
                throw input_error{m.place,
                                  text_of(why, " of ", in_quotes(m.channel),
                                          " within their error bounds and ",
                                          !rate           ? "the rate"
                                          : m.degree == 1 ? "the acceleration"
                                                          : "the jerk"),
                                  "one of the bounds is too small: enlarge it"};
            unknown.second = why;
            result_.protocol.add(kind::decided, s.stretch, m.name,
                                 text_of("start not known where there are ", found.refusal),
                                 s.first_line);
            return std::nullopt;
        }
        unknown.first = true;
        auto const range = text_of("[", m.range.lower.text(), ", ", m.range.upper.text(), "]");
        auto const whole = s.mapping->windows ? "each window" : "the scenario";
        result_.protocol.add(
            kind::assumed, s.stretch, m.name,
            text_of("start from readings: ", rate ? "it is the rate of what " : "it is what ",
                    in_quotes(m.channel), " shows",
                    m.bounded ? text_of(!rate           ? ", and changes"
                                        : m.degree == 1 ? ", and changes itself"
                                                        : ", and changes its own rate",
                                        " by ", range, " a second at any time ",
                                        m.within ? text_of("within ", m.within->text(), " s of it")
                                                 : text_of("of ", whole))
                              : std::string{},
                    fraction.is_zero()
                        ? std::string{", and no reading is outside its bound"}
                        : text_of(", and at most ", fraction.text(), " of the readings of ", whole,
                                  ", thinned out or not, are outside their bounds")));
        return found.range;
    }

    /// A start that is never known where one was to be proposed.
    void check_starts() const {
        for (auto const& [m, found] : unknown_starts_)
            if (!found.first)
                throw input_error{m->place, found.second,
                                  text_of("state its box, ", in_quotes(m->name),
                                          ": [lower, upper], or bound how fast it changes: "
                                          "{\"channel\": ..., \"rate\": ...}")};
    }

    /// An input that acts in no scenario held out, or in all of them, though it does otherwise in
    /// those to fit: what is found there is judged by no other data.
    void compare_kinds(std::size_t input) {
        std::size_t count[2][2] = {}; // held out, acts
        for (auto const& s : result_.data.scenarios) {
            auto const& values = s.inputs[input].signal.values();
            bool const acts =
                std::any_of(values.begin(), values.end(), [](double const x) { return x != 0; });
            ++count[s.role == scenario_role::holdout][acts];
        }
        for (int const acts : {0, 1})
            if (auto const fit = count[0][acts];
                fit > 0 && count[1][acts] == 0 && count[1][1 - acts] > 0)
                result_.protocol.add(kind::decided, "held out", result_.names.inputs[input].name,
                                     text_of(acts ? "acts" : "is 0", " in ", std::to_string(fit),
                                             " scenarios to fit and in none held out: what they "
                                             "show is not judged by others"));
    }

    /// A share of outliers that holds for a record need not hold for each part of it.
    void check_budget(open_scenario const& s) {
        auto const& fraction = mapping_.max_outlier_fraction;
        if (fraction.is_zero() || (!s.mapping->windows && s.mapping->thin == 1)) return;
        auto const count = s.measurement_count();
        if (fraction.times(count).floor() == 0)
            throw input_error{{.file = mapping_.file.string(),
                               .pointer = "/max_outlier_fraction",
                               .is_json = true},
                              text_of("of the ", std::to_string(count), " measurements of ",
                                      in_quotes(s.name), " ", fraction.text(),
                                      " allows no outlier, although the record may have some"),
                              "state a larger fraction, longer windows or less thinning; or 0, if "
                              "there is none"};
        result_.protocol.add(kind::assumed, s.stretch, "",
                             text_of("of the measurements kept in each ",
                                     s.mapping->windows ? "window" : "scenario", " at most ",
                                     fraction.text(),
                                     " are outliers, wherever those of the record lie"));
    }

    static interval enclosed(imported_quantity const& q, imported_sample const& sample,
                             exact_decimal const& x) {
        auto const result = enclose(x);
        if (!result)
            throw input_error{{.file = q.from->file.string(), .line = sample.line},
                              "value and error bound are beyond the range of double",
                              "check factor and error"};
        return *result;
    }

    import_mapping const& mapping_;
    recorded_files files_;
    std::vector<open_scenario> open_;
    std::map<mapped_start const*, std::pair<bool, std::string>> unknown_starts_; ///< is one known?
    std::map<std::pair<bool, std::string>, exact_decimal> proposed_;
    std::set<std::pair<bool, std::string>> suggested_;
    imported_dataset result_;
};

/// Imports the recorded files that a mapping names.
/// @guarantee  every reading that is in the data set is in it with the converted decimal, within
/// its
///             bound enlarged by what the conversion rounds; every line that is not has a note
/// @throws input_error
[[nodiscard]] inline imported_dataset import_dataset(import_mapping const& mapping,
                                                     import_tools tools = {}) {
    return dataset_import{mapping, std::move(tools)}.run();
}

} // namespace sivid

#endif // SIVID_IMPORTING_SCENARIO_DATASET_IMPORT_HPP
