// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_DATASET_DETAIL_DATASET_TABLES_HPP
#define SIVID_IO_DATASET_DETAIL_DATASET_TABLES_HPP

#include <sivid/io/dataset/model_names.hpp>
#include <sivid/io/dataset/stated_unit.hpp>
#include <sivid/io/dataset_value.hpp>
#include <sivid/io/text/csv_table.hpp>
#include <sivid/number/text/joined.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid {

/// Where a quantity stands in a table: the column of its values and, if there is one, of its error
/// bounds.
struct quantity_column {
    std::size_t index; ///< into the model's list
    std::size_t value;
    std::optional<std::size_t> error;
};

/// Finds the columns `<name>` and `<name>_err` of a table whose first column is t, in the model's
/// order.
/// @throws input_error for a first column that is not t, an unknown heading, an _err column without
/// its values
[[nodiscard]] inline std::vector<quantity_column>
find_columns(csv_table const& table, std::vector<name_unit> const& names, std::string const& what) {
    if (table.headings().front() != "t")
        table.fail(
            table.heading_line(), 0,
            text_of("the first column is ", in_quotes(table.headings().front()), " instead of t"),
            "begin with the time; cells are separated by commas");
    std::vector<quantity_column> columns;
    for (std::size_t i = 0; i < names.size(); ++i)
        if (auto const value = table.column(names[i].name))
            columns.push_back({i, *value, table.column(names[i].name + "_err")});
    for (std::size_t c = 1; c < table.headings().size(); ++c) {
        bool used = false;
        for (auto const& q : columns) used = used || q.value == c || q.error == c;
        if (used) continue;
        auto const& heading = table.headings()[c];
        constexpr std::string_view suffix = "_err";
        if (heading.size() > suffix.size() && heading.ends_with(suffix) &&
            index_of(names, heading.substr(0, heading.size() - suffix.size())))
            table.fail(table.heading_line(), c,
                       text_of("there is no column for the values of ", in_quotes(heading)),
                       "add it before this one");
        table.fail(table.heading_line(), c, text_of("unknown ", what, " ", in_quotes(heading)),
                   text_of("the model has: ", joined_names(names)));
    }
    return columns;
}

/// What a conversion gives for a cell.
template <class T>
[[nodiscard]] T converted(csv_table const& table, csv_table::row const& row, std::size_t column,
                          std::optional<T> value) {
    if (!value)
        table.fail(row.line, column, "the number is beyond the range of double in the model's unit",
                   "check the unit that the data set states");
    return *std::move(value);
}

/// The times of a table, strictly increasing.
[[nodiscard]] inline std::vector<double> read_times(csv_table const& table,
                                                    stated_unit const& unit) {
    std::vector<double> times;
    for (auto const& row : table.rows()) {
        auto const time = converted(table, row, 0, unit.nearest(table.number(row, 0)));
        if (!times.empty() && !(times.back() < time))
            table.fail(row.line, 0,
                       text_of("the time ", in_quotes(row.cells[0]),
                               " does not come after the one before it"),
                       "correct it, or leave the line out: each time stands once, and a clock that "
                       "began again is another scenario");
        times.push_back(time);
    }
    return times;
}

/// An error bound: a number above 0.
[[nodiscard]] inline exact_decimal read_error_bound(csv_table const& table,
                                                    csv_table::row const& row, std::size_t column) {
    if (row.cells[column].empty())
        table.fail(row.line, column, "the error bound is missing", "give one for every value");
    auto const error = table.number(row, column);
    if (!error.is_positive())
        table.fail(row.line, column, "the error bound is not above 0",
                   "a bound of an instrument is positive");
    return error;
}

/// Reads `t,<input>[,<input>_err],...`: every input of the model, from 0 or before to `duration` or
/// after.
[[nodiscard]] inline std::vector<dataset_input> read_inputs(csv_table const& table,
                                                            model_names const& model,
                                                            interpolation kind, double duration,
                                                            stated_units const& units = {}) {
    auto const columns = find_columns(table, model.inputs, "input");
    for (std::size_t i = 0; i < model.inputs.size(); ++i) {
        bool found = false;
        for (auto const& q : columns) found = found || q.index == i;
        if (!found)
            table.fail(table.heading_line(),
                       text_of("the input ", in_quotes(model.inputs[i].name), " is missing"),
                       "add its column");
    }
    auto const times = read_times(table, units.time);

    std::vector<dataset_input> inputs;
    for (auto const& q : columns) {
        std::vector<double> knots, values;
        auto const& unit = stated_units::of(units.inputs, q.index);
        dataset_input input;
        for (std::size_t r = 0; r < table.rows().size(); ++r) {
            auto const& row = table.rows()[r];
            if (row.cells[q.value].empty()) { // a missing sample: no knot of this input here
                if (q.error && !row.cells[*q.error].empty())
                    (void)read_error_bound(table, row, *q.error);
                continue;
            }
            knots.push_back(times[r]);
            auto value = table.number(row, q.value);
            values.push_back(converted(table, row, q.value, unit.nearest(value)));
            if (!q.error) continue;
            auto error =
                converted(table, row, *q.error,
                          unit.error_of(values.back(), {std::move(value),
                                                        read_error_bound(table, row, *q.error)}));
            input.error.push_back(upper(converted(table, row, *q.error, enclose(error))));
            input.stated_error.push_back(std::move(error));
        }
        auto const last_line =
            table.rows().empty() ? table.heading_line() : table.rows().back().line;
        if (knots.empty())
            table.fail(last_line, q.value, "the input has no sample",
                       "state it from 0 to the duration");
        if (knots.front() > 0)
            table.fail(table.rows().front().line, q.value, "the input starts after t = 0",
                       "state it from 0 or before");
        if (knots.back() < duration)
            table.fail(last_line, q.value, "the input ends before the duration",
                       "state it to the duration or after");
        input.signal = sampled_signal{std::move(knots), std::move(values), kind};
        inputs.push_back(std::move(input));
    }
    return inputs;
}

/// Reads `t,<channel>,<channel>_err,...` into the scenario: times within [0, duration]; an empty
/// cell is a missing sample.
inline void read_measurements(csv_table const& table, model_names const& model, scenario& result,
                              stated_units const& units = {}) {
    auto const columns = find_columns(table, model.channels, "channel");
    for (auto const& q : columns)
        if (!q.error)
            table.fail(
                table.heading_line(), q.value,
                text_of("there is no column ", in_quotes(model.channels[q.index].name + "_err")),
                "add the error bounds of this channel");
    auto const times = read_times(table, units.time);
    for (std::size_t r = 0; r < table.rows().size(); ++r) {
        auto const& row = table.rows()[r];
        if (times[r] < 0 || times[r] > result.duration)
            table.fail(row.line, 0,
                       text_of("the time ", in_quotes(row.cells[0]), " is outside [0, duration]"),
                       "remove the line or correct the duration");
        for (auto const& q : columns) {
            if (row.cells[q.value].empty()) {
                if (!row.cells[*q.error].empty()) (void)read_error_bound(table, row, *q.error);
                continue;
            }
            auto [value, error] = converted(
                table, row, q.value,
                stated_units::of(units.channels, q.index)(
                    {table.number(row, q.value), read_error_bound(table, row, *q.error)}));
            auto const bound = enclose(value - error, value + error);
            if (!bound)
                table.fail(row.line, q.value,
                           "value and error bound are beyond the range of double",
                           "give smaller numbers");
            result.measurements.push_back({times[r], q.index, *bound});
            result.stated.push_back({std::move(value), std::move(error)});
        }
    }
}

} // namespace sivid

#endif // SIVID_IO_DATASET_DETAIL_DATASET_TABLES_HPP
