// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_IMPORT_MAPPING_HPP
#define SIVID_IO_IMPORT_MAPPING_HPP

#include <sivid/io/dataset_value.hpp>
#include <sivid/io/input_error.hpp>
#include <sivid/io/model_names.hpp>
#include <sivid/io/unit_conversion.hpp>

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

/// How an input or a channel of the model follows from a column.
struct quantity_mapping {
    std::string name, unit;
    column_reference column;
    unit_conversion conversion;
    std::optional<unsigned> counter_bits; ///< the readings are counts that wrap
    std::optional<std::pair<exact_decimal, exact_decimal>> range; ///< of possible readings
    bound_source error;
};

/// What happens where a recorder's log breaks.
enum class break_policy {
    refuse, ///< bad input
    keep,   ///< gaps only: go on, and say so
    split,  ///< a new scenario
    drop    ///< restarts only: leave out everything from there on
};

/// The form of a recorded file.
struct source_form {
    enum class kind { csv, serial };
    kind from = kind::csv;
    char separator = ','; ///< ' ' stands for any run of blanks
    char decimal = '.';
    std::vector<std::string> missing; ///< cells that mean "no reading", beside empty ones
    std::size_t skip_lines = 0;       ///< csv: before the heading
    std::size_t skip_after_heading = 0;
    std::vector<std::string> fields; ///< serial: what a line holds; "_" is not looked at
    exact_decimal longest_gap;       ///< serial: the longest usual step of the time [s]
    break_policy gap = break_policy::refuse, restart = break_policy::refuse;
};

/// How the time of the data set follows from a column: t = reading * 10^power + offset.
struct time_mapping {
    column_reference column;
    std::string unit = "s";
    unit_conversion to_seconds;
    std::optional<unsigned> counter_bits; ///< serial: the counter wraps
    bool from_first = false;              ///< t = 0 is the first row with all inputs
    exact_decimal offset;                 ///< otherwise [s]
};

/// A range that the mapping states for a state.
struct mapped_range {
    std::string name;
    stated_range range;
};

/// How one recorded file becomes a scenario.
struct scenario_mapping {
    std::string name;
    scenario_role role = scenario_role::fit;
    std::filesystem::path file;
    interpolation between = interpolation::linear;
    source_form form;
    time_mapping time;
    std::optional<exact_decimal> duration; ///< nothing: as long as all inputs last
    std::vector<quantity_mapping> inputs, channels;
    std::vector<mapped_range> initial;
    std::vector<mapped_range> initial_after_break; ///< of the scenarios that a split begins
    input_place place;
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
    };
    std::filesystem::path file;
    std::string id, model;
    std::vector<parameter> parameters;
    std::vector<constant> fixed;
    exact_decimal max_outlier_fraction;
    std::vector<scenario_mapping> scenarios;

    /// The names that occur: as much of the model as the data set needs to know.
    [[nodiscard]] model_names names() const {
        model_names result;
        result.name = model;
        auto const add = [](std::vector<name_unit>& list, std::string const& name,
                            std::string const& unit) {
            if (!index_of(list, name)) list.push_back({name, unit});
        };
        for (auto const& p : parameters) add(result.constants, p.name, p.unit);
        for (auto const& f : fixed) add(result.constants, f.name, "");
        for (auto const& s : scenarios) {
            for (auto const& q : s.inputs) add(result.inputs, q.name, q.unit);
            for (auto const& q : s.channels) add(result.channels, q.name, q.unit);
            for (auto const* list : {&s.initial, &s.initial_after_break})
                for (auto const& r : *list) add(result.states, r.name, "");
        }
        result.state_ranges.assign(result.states.size(), interval::whole());
        return result;
    }
};

} // namespace sivid

#endif // SIVID_IO_IMPORT_MAPPING_HPP
