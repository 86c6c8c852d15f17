// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_RECORDED_TABLE_HPP
#define SIVID_IO_RECORDED_TABLE_HPP

#include <sivid/io/import_mapping.hpp>
#include <sivid/io/import_protocol.hpp>
#include <sivid/io/recorded_text.hpp>
#include <sivid/io/text_file.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid {

/// Readings of one recorded stretch: rows at strictly increasing times.
struct recorded_table {
    struct row {
        std::size_t line = 0;
        exact_decimal time;                              ///< [s], before the offset
        std::vector<std::optional<exact_decimal>> cells; ///< see columns_of; nothing: missing
    };
    std::vector<row> rows;
    std::size_t first_line = 0, last_line = 0;
};

/// The columns that a scenario needs, in the order of recorded_table's cells: for the inputs, then
/// the channels, the value's and, where the bound has one, the bound's.
[[nodiscard]] inline std::vector<column_reference> columns_of(scenario_mapping const& s) {
    std::vector<column_reference> result;
    for (auto const* list : {&s.inputs, &s.channels})
        for (auto const& q : *list) {
            result.push_back(q.column);
            if (q.error.from == bound_source::kind::column) result.push_back(q.error.column);
        }
    return result;
}

/// Where a column stands among the headings.
/// @throws input_error  with the mapping's place
[[nodiscard]] inline std::size_t find_column(column_reference const& c,
                                             std::vector<std::string> const& headings,
                                             std::string const& file) {
    if (c.number > 0) {
        if (c.number > headings.size())
            throw input_error{c.place,
                              text_of(file, " has ", std::to_string(headings.size()),
                                      " columns, not ", std::to_string(c.number)),
                              "count from 1; check the separator"};
        return c.number - 1;
    }
    std::string known;
    std::size_t found = headings.size();
    for (std::size_t i = 0; i < headings.size(); ++i) {
        known += text_of(i > 0 ? ", " : "", in_quotes(headings[i]));
        if (headings[i] != c.heading) continue;
        if (found < headings.size())
            throw input_error{c.place, text_of(file, " has two columns ", in_quotes(c.heading)),
                              "name the column by its number, from 1"};
        found = i;
    }
    if (found == headings.size())
        throw input_error{c.place, text_of(file, " has no column ", in_quotes(c.heading)),
                          text_of("it has: ", known.substr(0, 400),
                                  "; check \"separator\" and the lines before the heading "
                                  "(\"skip_lines\"), or name the column by its number")};
    return found;
}

/// Reads a table with headings, in the form and with the columns that the mapping states. A table
/// is refused where a log would be cleaned: it has been through a program that could have written
/// it properly.
/// @throws input_error  for a ragged line, a cell that is no number, a time that does not increase
[[nodiscard]] inline recorded_table
read_recorded_table(scenario_mapping const& s, std::string_view text, import_protocol& protocol) {
    using kind = import_protocol::kind;
    auto const file = s.file.string();
    std::vector<std::string> headings;
    auto const fail = [&](std::size_t line, std::size_t column, std::string problem,
                          std::string remedy) {
        bool const named = column > 0 && column <= headings.size();
        throw input_error{{.file = file,
                           .line = line,
                           .column = column,
                           .heading = named ? headings[column - 1] : "",
                           .pointer = ""},
                          std::move(problem),
                          std::move(remedy)};
    };
    recorded_table result;
    std::vector<std::size_t> columns;
    std::size_t time_column = 0, skip = s.form.skip_lines;
    for (auto const& line : lines_of(text)) {
        if (skip > 0) {
            --skip;
            protocol.add(kind::dropped, s.name, "", "skipped, as the mapping says", line.number);
            continue;
        }
        auto const plain = without_blanks(line.text);
        if (plain.empty() || plain.front() == '#') continue;
        auto const cells = split_cells(line.text, s.form.separator);
        if (!cells)
            fail(line.number, 0, "a quotation mark out of place",
                 "quote whole cells, and end each on its line");
        if (headings.empty()) {
            headings = *cells;
            time_column = find_column(s.time.column, headings, file);
            for (auto const& c : columns_of(s)) columns.push_back(find_column(c, headings, file));
            skip = s.form.skip_after_heading;
            continue;
        }
        if (cells->size() != headings.size())
            fail(line.number, 0,
                 text_of(std::to_string(cells->size()), " cells in a table of ",
                         std::to_string(headings.size()), " columns"),
                 "correct the line, or import the file as a serial log, which drops such lines");
        auto const number = [&](std::size_t c) -> std::optional<exact_decimal> {
            auto const& cell = (*cells)[c];
            if (cell.empty() || std::find(s.form.missing.begin(), s.form.missing.end(), cell) !=
                                    s.form.missing.end())
                return std::nullopt;
            auto const value = parse_reading(cell, s.form.decimal);
            if (!value)
                fail(line.number, c + 1, in_quotes(cell) + " is not a finite number",
                     text_of("correct it, state the decimal mark (now '",
                             std::string(1, s.form.decimal),
                             "'), or list the text under \"missing\""));
            return value;
        };
        auto const time = number(time_column);
        if (!time)
            fail(line.number, time_column + 1, "the time is missing",
                 "state it or remove the line");
        recorded_table::row row;
        row.line = line.number;
        auto const seconds = s.time.to_seconds(*time);
        if (!seconds)
            fail(line.number, time_column + 1, "the time is beyond the range of double",
                 "check its unit");
        row.time = seconds->value;
        if (!result.rows.empty() && !(result.rows.back().time < row.time))
            fail(line.number, time_column + 1,
                 text_of("the time ", in_quotes((*cells)[time_column]),
                         " does not come after the one before it"),
                 "sort the lines by time and keep each time once");
        for (auto const c : columns) row.cells.push_back(number(c));
        if (result.first_line == 0) result.first_line = line.number;
        result.last_line = line.number;
        result.rows.push_back(std::move(row));
    }
    if (headings.empty())
        throw input_error{{.file = file}, "no heading line", "the first line names the columns"};
    return result;
}

} // namespace sivid

#endif // SIVID_IO_RECORDED_TABLE_HPP
