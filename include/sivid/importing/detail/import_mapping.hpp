// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_DETAIL_IMPORT_MAPPING_HPP
#define SIVID_IMPORTING_DETAIL_IMPORT_MAPPING_HPP

#include <sivid/importing/detail/column_formula.hpp>
#include <sivid/io/dataset/model_names.hpp>
#include <sivid/io/dataset/unit_conversion.hpp>
#include <sivid/io/dataset_value.hpp>
#include <sivid/io/input_error.hpp>
#include <sivid/model/unit.hpp>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// A column of a recorded file, by its heading or by its number from 1.
struct column_reference {
    std::string heading;
    std::size_t number = 0; ///< 0: by heading
    input_place place;      ///< in the mapping, for messages

    [[nodiscard]] friend bool operator==(column_reference const& a, column_reference const& b) {
        return a.heading == b.heading && a.number == b.number;
    }
};

/// Where the error bound of a quantity comes from.
struct bound_source {
    enum class kind {
        none,    ///< inputs only: the readings are exact
        number,  ///< one bound, in the model's unit
        column,  ///< a column in the unit of the readings
        proposed ///< propose_error_bound on the fit scenarios
    };
    kind from = kind::none;
    exact_decimal number;
    column_reference column;
    input_place place;
};

/// How an input or a channel of the model follows from columns.
struct quantity_mapping {
    std::string name, unit;
    std::vector<column_reference> columns = {{}};
    std::optional<column_formula> formula; ///< of the columns; nothing: the reading is the one
    unit_conversion conversion;
    std::optional<unsigned> signed_bits;  ///< the readings are registers whose last bit is a sign
    std::optional<unsigned> counter_bits; ///< the readings are counts that wrap
    /// The readings are what is left modulo something in this interval.
    std::optional<std::pair<exact_decimal, exact_decimal>> period;
    std::optional<std::pair<exact_decimal, exact_decimal>> range; ///< of possible readings
    bound_source error;
    /// Inputs only: so long [s] may samples be missing; nothing: none may.
    std::optional<exact_decimal> bridge;
    std::optional<exact_decimal> bridge_error; ///< there the input is within this; nothing: exact
    /// Channels only: the reading was taken within `clock` [s] of its time, while what it shows
    /// changes by `slope` a second at most, or (`curved`) changes its rate so.
    exact_decimal clock, slope;
    bool curved = false;
    exact_decimal model_error; ///< channels only: joins the bound of all readings, not of starts
    bool elsewhere = false;    ///< in a further file, whose mapping has it, too
    input_place place;
};

/// What happens where a recorder's log breaks.
enum class break_policy {
    refuse, ///< bad input
    keep,   ///< gaps only: go on, and say so
    split,  ///< a new scenario
    drop    ///< restarts only: leave out everything from there on
};

/// Of readings at one time that differ.
enum class same_time {
    refuse, ///< bad input
    first,  ///< the first one counts
    last    ///< the last one counts
};

/// Which lines of a file count, by the text in one of their columns.
struct line_choice {
    bool all = false; ///< they are of one kind, whatever their texts are
    column_reference column;
    std::vector<std::string> is;

    [[nodiscard]] bool takes(std::string const& cell) const {
        return all || std::find(is.begin(), is.end(), cell) != is.end();
    }
    [[nodiscard]] friend bool operator==(line_choice const&, line_choice const&) = default;
};

/// How the times of a column are written.
enum class time_form {
    number, ///< of a unit
    date,   ///< ISO 8601 with an offset from UTC
    clock   ///< hh:mm:ss since midnight
};

/// The form of a recorded file.
struct source_form {
    enum class kind { csv, serial, matlab };
    kind from = kind::csv;
    char separator = ','; ///< ' ' stands for any run of blanks
    char decimal = '.';
    std::vector<std::string> missing; ///< cells that mean "no reading", beside empty ones
    std::size_t skip_lines = 0;       ///< csv: before the heading
    std::optional<bool> heading;      ///< csv: whether there is one; nothing: not stated
    std::size_t skip_after_heading = 0;
    std::vector<std::string> fields; ///< serial: what a line holds; "_" is not looked at
    exact_decimal longest_gap;       ///< serial: the longest usual step of the time [s]
    bool check_sums = false;         ///< serial: each line ends with *HHHH, its crc16
    break_policy gap = break_policy::refuse, restart = break_policy::refuse;
    std::optional<line_choice> lines; ///< nothing: not stated
    bool short_lines = false;         ///< csv: cells missing at the end of a line are no readings
    same_time doubled = same_time::refuse;

    [[nodiscard]] bool is_missing(std::string const& cell) const {
        return cell.empty() || std::find(missing.begin(), missing.end(), cell) != missing.end();
    }
    [[nodiscard]] friend bool operator==(source_form const&, source_form const&) = default;
};

/// How the time of the data set follows from a column: t = reading * 10^power + offset.
struct time_mapping {
    column_reference column;
    std::optional<exact_decimal> sample_time; ///< no column: row k, from 0, is at k times this
    std::string unit = "s";
    time_form form = time_form::number; ///< others are in seconds
    unit_conversion to_seconds;
    std::optional<unsigned> counter_bits; ///< serial: the counter wraps
    bool from_first = false;              ///< t = 0 is the first row with all inputs
    exact_decimal offset;                 ///< otherwise [s]
};

/// What the mapping says of a state at a start.
struct mapped_start {
    enum class kind {
        stated, ///< it is in `range`
        value,  ///< it is what the channel shows; `range`, if bounded, has its rate of change
        rate    ///< it is the rate of what the channel shows
    };
    std::string name;
    kind from = kind::stated;
    stated_range range; ///< of a rate: of the derivative of what is shown after `degree`
    std::string unit;   ///< of a stated range; empty: the model's
    bool bounded = true;
    std::size_t degree = 1;              ///< of a rate: 1 bounds x'', 2 bounds x'''
    std::optional<exact_decimal> within; ///< of a rate: readings so near [s] count, earlier as well
    std::string channel;
    input_place place;
};

/// Rows whose reading of a column is in a range.
struct row_condition {
    column_reference column;
    std::pair<exact_decimal, exact_decimal> within;
};

/// Windows that a record is cut into, each with a start of its own: the k-th, from 1, of a stretch
/// of rows begins first + (k - 1) every behind its first row (or behind t = 0), or at the first
/// common reading after that if its start needs one.
struct window_mapping {
    exact_decimal length, every, first; ///< [s], every >= length
    std::optional<row_condition> rows;  ///< of such rows is a stretch; nothing: of all
    std::size_t most = 0;               ///< so many; 0: as many as there are
    std::size_t holdout_every = 0;      ///< each k-th is held out; 0: none
    std::vector<std::size_t> holdout;   ///< or these
    std::vector<mapped_start> initial;  ///< at the start of each
    input_place place;

    [[nodiscard]] bool is_holdout(std::size_t number) const {
        return (holdout_every > 0 && number % holdout_every == 0) ||
               std::find(holdout.begin(), holdout.end(), number) != holdout.end();
    }
};

/// The clock of a further file. Its time t is t + offset + drift (t - m) by the clock of the first
/// one, m being the middle of what the further file holds.
struct clock_mapping {
    std::pair<exact_decimal, exact_decimal> offset, drift; ///< lowest and highest; [s], 1
    /// What both files recorded, within the sum of their errors: `here` in the further one, in the
    /// first one the `there`-th of its `watched`.
    std::optional<quantity_mapping> here;
    std::size_t there = 0;
    std::optional<exact_decimal> rate; ///< it changes by so much a second at most; nothing:
    exact_decimal level;               ///< it is above or below this between two such readings
    input_place place;
};

/// How one recorded file, or several, become a scenario.
struct scenario_mapping {
    std::string name;
    scenario_role role = scenario_role::fit;
    std::filesystem::path file;
    interpolation between = interpolation::linear;
    source_form form;
    time_mapping time;
    std::optional<exact_decimal> duration; ///< nothing: as long as all inputs last
    std::vector<quantity_mapping> inputs, channels;
    std::vector<mapped_start> initial;             ///< stated ones: at t = 0 alone
    std::vector<mapped_start> initial_after_break; ///< of the scenarios that a split begins
    std::optional<window_mapping> windows;
    std::size_t thin = 1; ///< each so-many-th reading of a channel is kept
    /// Of a scenario: its further files with what they hold, which stands in `inputs` and
    /// `channels` of the scenario, too.
    std::vector<scenario_mapping> further;
    std::optional<clock_mapping> clock;    ///< of a further file
    std::vector<quantity_mapping> watched; ///< read beside those
    input_place place;

    /// The unit of a start: the stated one, or that of the channel whose readings show it; empty:
    /// the model's, or not stated.
    [[nodiscard]] std::string unit_of(mapped_start const& start) const {
        if (start.from == mapped_start::kind::stated) return start.unit;
        auto const q = std::find_if(channels.begin(), channels.end(),
                                    [&](auto const& c) { return c.name == start.channel; });
        if (q == channels.end() || q->unit.empty()) return {};
        return start.from == mapped_start::kind::rate ? rate_unit(q->unit, "s") : q->unit;
    }
};

/// The content of a file in the format sivid-mapping-1; read_import_mapping makes it.
struct import_mapping {
    struct parameter {
        std::string name, unit;
        stated_range prior;
    };
    struct constant {
        std::string name;
        exact_decimal value;
        interval enclosure;
        std::string unit{}; ///< empty: the model's
    };
    std::filesystem::path file;
    std::string id, model;
    std::vector<parameter> parameters;
    std::vector<constant> fixed;
    exact_decimal max_outlier_fraction;
    std::vector<dataset_effect> effects;
    std::vector<scenario_mapping> scenarios;

    /// The names that occur: as much of the model as the data set needs to know.
    [[nodiscard]] model_names names() const {
        model_names result;
        result.name = model;
        auto const add = [](std::vector<name_unit>& list, std::string const& name,
                            std::string const& unit) {
            auto const known = index_of(list, name);
            if (!known)
                list.push_back({name, unit});
            else if (list[*known].unit.empty())
                list[*known].unit = unit;
        };
        for (auto const& p : parameters) add(result.constants, p.name, p.unit);
        for (auto const& f : fixed) add(result.constants, f.name, f.unit);
        for (auto const& s : scenarios) {
            for (auto const& q : s.inputs) add(result.inputs, q.name, q.unit);
            for (auto const& q : s.channels) add(result.channels, q.name, q.unit);
            for (auto const* list : {&s.initial, &s.initial_after_break})
                for (auto const& r : *list) add(result.states, r.name, s.unit_of(r));
            if (!s.windows) continue;
            for (auto const& r : s.windows->initial) add(result.states, r.name, s.unit_of(r));
        }
        result.state_ranges.assign(result.states.size(), interval::whole());
        return result;
    }
};

} // namespace sivid

#endif // SIVID_IMPORTING_DETAIL_IMPORT_MAPPING_HPP
