// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_TABLE_DETAIL_RECORDED_TABLE_HPP
#define SIVID_IMPORTING_TABLE_DETAIL_RECORDED_TABLE_HPP

#include <sivid/importing/detail/import_mapping.hpp>
#include <sivid/importing/detail/import_protocol.hpp>
#include <sivid/importing/table/detail/recorded_text.hpp>
#include <sivid/io/text/text_file.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid {

/// Readings of one recorded stretch: rows at increasing times, in a log several in one tick.
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

/// Collects the rows of a table, whose times must increase: it has been through a program that
/// could have written it properly.
class recorded_rows {
public:
    /// @param fail  (line, is it the time, problem, remedy): throws input_error
    using complaint =
        std::function<void(std::size_t, bool, std::string const&, std::string const&)>;
    recorded_rows(scenario_mapping const& s, complaint fail) : s_{s}, fail_{std::move(fail)} {}

    /// @param stamp  as read; without a column of times the row's number says when it was
    void add(std::size_t line, std::optional<exact_decimal> const& stamp,
             std::vector<std::optional<exact_decimal>> cells) {
        auto const& step = s_.time.sample_time;
        if (!step && !stamp)
            fail_(line, true, "the time is missing", "state it or remove the line");
        auto const seconds = s_.time.to_seconds(step ? step->times(table_.rows.size()) : *stamp);
        if (!seconds) fail_(line, true, "the time is beyond the range of double", "check its unit");
        if (!table_.rows.empty() && !(table_.rows.back().time < seconds->value))
            fail_(line, true,
                  text_of("the time ", in_quotes(stamp ? stamp->text() : step->text()),
                          " does not come after the one before it"),
                  "sort the lines by time and keep each time once");
        if (table_.first_line == 0) table_.first_line = line;
        table_.last_line = line;
        table_.rows.push_back({line, seconds->value, std::move(cells)});
    }
    [[nodiscard]] recorded_table take() { return std::move(table_); }

private:
    scenario_mapping const& s_;
    complaint fail_;
    recorded_table table_;
};

/// Reads a table in the form and with the columns that the mapping states. A table is refused where
/// a log would be cleaned.
///   Blanks alone are a row without a reading where they make as many cells as a row has, and where
/// there is one column. Other blank lines and comments are noted; without a column of times they
/// may stand above and below the rows only, since the rows after one that is lost would be early.
/// @throws input_error  for a ragged line, a cell that is no number, a time that does not increase,
///                      a first line of which nobody knows whether it is a heading
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
    std::vector<std::size_t> columns;
    std::optional<std::size_t> time_column;
    recorded_rows rows{s, [&](std::size_t line, bool, auto const& problem, auto const& remedy) {
                           fail(line, time_column ? *time_column + 1 : 0, problem, remedy);
                       }};
    auto const heads = [&](std::size_t line, std::vector<std::string> const& cells) {
        headings = cells;
        if (s.form.heading == false)
            for (std::size_t i = 0; i < cells.size(); ++i) headings[i] = std::to_string(i + 1);
        auto references = columns_of(s);
        for (auto const& c : references) columns.push_back(find_column(c, headings, file));
        if (!s.time.sample_time) {
            references.push_back(s.time.column);
            time_column = find_column(s.time.column, headings, file);
        }
        // What is found by its name is a heading.
        if (!s.form.heading &&
            std::all_of(references.begin(), references.end(), [&](column_reference const& c) {
                return c.number > 0 && (s.form.is_missing(cells[c.number - 1]) ||
                                        parse_reading(cells[c.number - 1], s.form.decimal));
            }))
            fail(line, 0, "the line of the headings may be a row: its mapped cells are numbers",
                 "state \"heading\" in the mapping's source: false if it is the first row, true "
                 "if it names the columns");
    };
    std::size_t skip = s.form.skip_lines, passed = 0; // the last line that may have been a row
    for (auto const& line : lines_of(text)) {
        if (skip > 0) {
            --skip;
            protocol.add(kind::dropped, s.name, "", "skipped, as the mapping says", line.number);
            continue;
        }
        auto const plain = without_blanks(line.text);
        auto cells = split_cells(line.text, s.form.separator);
        bool const blank =
            plain.empty() && (headings.empty() || (headings.size() > 1 && cells->size() < 2));
        if (blank || (plain.starts_with('#') && !(cells && s.form.is_missing(cells->front())))) {
            protocol.add(kind::dropped, s.name, "", "blank or comment", line.number);
            if (!headings.empty() || (blank && s.form.heading == false)) passed = line.number;
            continue;
        }
        if (passed > 0 && s.time.sample_time)
            fail(passed, 0, "a blank line or a comment above a row: it may stand for a row",
                 "remove it, or fill its cells, since only their number tells when rows were");
        if (plain.empty() && headings.size() == 1) cells->assign(1, "");
        if (!cells)
            fail(line.number, 0, "a quotation mark out of place",
                 "quote whole cells, and end each on its line");
        if (headings.empty()) {
            heads(line.number, *cells);
            skip = s.form.skip_after_heading;
            if (s.form.heading != false) continue;
        }
        if (cells->size() != headings.size())
            fail(line.number, 0,
                 text_of(std::to_string(cells->size()), " cells in a table of ",
                         std::to_string(headings.size()), " columns"),
                 "correct the line, or import the file as a serial log, which drops such lines");
        auto const number = [&](std::size_t c) -> std::optional<exact_decimal> {
            auto const& cell = (*cells)[c];
            if (s.form.is_missing(cell)) return std::nullopt;
            auto const value = parse_reading(cell, s.form.decimal);
            if (!value)
                fail(line.number, c + 1, in_quotes(cell) + " is not a finite number",
                     text_of("correct it, state the decimal mark (now '",
                             std::string(1, s.form.decimal),
                             "'), or list the text under \"missing\""));
            return value;
        };
        auto const stamp = time_column ? number(*time_column) : std::nullopt;
        std::vector<std::optional<exact_decimal>> readings;
        for (auto const c : columns) readings.push_back(number(c));
        rows.add(line.number, stamp, std::move(readings));
    }
    if (headings.empty())
        throw input_error{{.file = file}, "no heading line", "the first line names the columns"};
    return rows.take();
}

} // namespace sivid

#endif // SIVID_IMPORTING_TABLE_DETAIL_RECORDED_TABLE_HPP
