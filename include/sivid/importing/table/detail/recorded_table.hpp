// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_TABLE_DETAIL_RECORDED_TABLE_HPP
#define SIVID_IMPORTING_TABLE_DETAIL_RECORDED_TABLE_HPP

#include <sivid/importing/detail/import_mapping.hpp>
#include <sivid/importing/detail/import_protocol.hpp>
#include <sivid/importing/table/detail/line_kinds.hpp>
#include <sivid/importing/table/detail/recorded_rows.hpp>
#include <sivid/importing/table/detail/recorded_text.hpp>
#include <sivid/importing/table/detail/time_text.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid {

/// Reads a table in the form and with the columns that the mapping states; users call
/// read_recorded_table.
class recorded_table_reader {
public:
    recorded_table_reader(scenario_mapping const& s, import_protocol& protocol)
        : s_{s},
          form_{s.form},
          protocol_{protocol},
          file_{s.file.string()},
          stamps_{s.time, s.form.decimal},
          rows_{s, protocol,
                [this](std::size_t line, bool, auto const& problem, auto const& remedy) {
                    fail(line, time_column_ ? *time_column_ + 1 : 0, problem, remedy);
                }},
          skip_{s.form.skip_lines} {}

    [[nodiscard]] recorded_table read(std::string_view text) {
        require_lines(text, file_);
        for (auto const& line : lines_of(text)) take(line);
        if (headings_.empty())
            throw input_error{{.file = file_},
                              text.empty() ? "the file is empty: no heading line"
                                           : "no heading line",
                              "the first line names the columns"};
        filter_->require_any();
        if (!form_.lines) kinds_->require_one(headings_, file_);
        return rows_.take();
    }

private:
    using kind = import_protocol::kind;
    using cells_of_line = std::vector<std::string>;

    [[noreturn]] void fail(std::size_t line, std::size_t column, std::string problem,
                           std::string remedy) const {
        bool const named = column > 0 && column <= headings_.size();
        throw input_error{{.file = file_,
                           .line = line,
                           .column = column,
                           .heading = named ? headings_[column - 1] : "",
                           .pointer = ""},
                          std::move(problem),
                          std::move(remedy)};
    }

    void take(recorded_line const& line) {
        if (skip_ > 0) {
            --skip_;
            protocol_.add(kind::dropped, s_.name, "", "skipped, as the mapping says", line.number);
            return;
        }
        for (char const c : {'\0', '\r'})
            if (line.text.find(c) != std::string_view::npos)
                fail(line.number, 0, "the line holds " + hidden_in(std::string(1, c)),
                     "remove it, with what is broken around it");
        auto const plain = without_blanks(line.text);
        auto cells = split_cells(line.text, form_.separator);
        bool const blank =
            plain.empty() && (headings_.empty() || (headings_.size() > 1 && cells->size() < 2));
        bool const comment = plain.starts_with('#') && !(cells && form_.is_missing(cells->front()));
        if (blank || (comment && !(headings_.empty() && names_columns(cells)))) {
            protocol_.add(kind::dropped, s_.name, "", "blank or comment", line.number);
            if (!headings_.empty() || (blank && form_.heading == false)) passed_ = line.number;
            if (comment && cells && headings_.empty()) comment_ = {line.number, *cells};
            return;
        }
        if (passed_ > 0 && s_.time.sample_time)
            fail(passed_, 0, "a blank line or a comment above a row: it may stand for a row",
                 "remove it, or fill its cells, since only their number tells when rows were");
        if (plain.empty() && headings_.size() == 1) cells->assign(1, "");
        if (!cells)
            fail(line.number, 0, "a quotation mark out of place",
                 "quote whole cells, and end each on its line");
        if (headings_.empty()) {
            heads(line.number, *cells);
            if (form_.heading != false) return;
        }
        row(line.number, std::move(*cells));
    }

    /// Whether a comment has all headings that the mapping names: it is the heading then.
    [[nodiscard]] bool names_columns(std::optional<cells_of_line> const& cells) const {
        if (!cells || form_.heading == false) return false;
        bool any = false;
        for (auto const& c : references()) {
            if (c.number > 0) continue;
            any = true;
            if (std::find(cells->begin(), cells->end(), c.heading) == cells->end()) return false;
        }
        return any;
    }
    [[nodiscard]] bool is_numbered(std::size_t column) const {
        auto const all = references();
        return std::any_of(all.begin(), all.end(),
                           [&](column_reference const& c) { return c.number == column; });
    }
    [[nodiscard]] std::vector<column_reference> references() const {
        auto result = columns_of(s_);
        if (!s_.time.sample_time) result.push_back(s_.time.column);
        return result;
    }

    /// The line that names the columns, or with `heading` false the first row.
    void heads(std::size_t line, cells_of_line const& cells) {
        headings_ = first_ = cells;
        if (form_.heading == false)
            for (std::size_t i = 0; i < cells.size(); ++i) headings_[i] = std::to_string(i + 1);
        else if (headings_.size() > 1 && headings_.back().empty() && !is_numbered(headings_.size()))
            headings_.pop_back(); // a separator at the end of the line begins no column
        try {
            for (auto const& c : columns_of(s_))
                columns_.push_back(find_column(c, headings_, file_));
            if (!s_.time.sample_time) time_column_ = find_column(s_.time.column, headings_, file_);
            filter_.emplace(form_, headings_, file_);
        } catch (input_error const& e) {
            if (!comment_ || comment_->second.size() < 2) throw;
            std::string named;
            for (auto const& cell : comment_->second)
                if (!cell.empty()) named += text_of(named.empty() ? "" : ", ", in_quotes(cell));
            throw input_error{e.place(), e.problem(),
                              text_of("line ", std::to_string(comment_->first),
                                      " was skipped as a comment: if it is the heading, name the "
                                      "columns as they stand there: ",
                                      named.substr(0, 400), "; otherwise ", e.remedy())};
        }
        auto read = columns_;
        if (time_column_) read.push_back(*time_column_);
        kinds_.emplace(headings_.size(), read);
        skip_ = form_.skip_after_heading;
        auto const all = references();
        // What is found by its name is a heading.
        if (!form_.heading && std::all_of(all.begin(), all.end(), [&](column_reference const& c) {
                return c.number > 0 && (form_.is_missing(cells[c.number - 1]) ||
                                        parse_reading(cells[c.number - 1], form_.decimal));
            }))
            fail(line, 0, "the line of the headings may be a row: its mapped cells are numbers",
                 "state \"heading\" in the mapping's source: false if it is the first row, true "
                 "if it names the columns");
    }

    void row(std::size_t line, cells_of_line cells) {
        if (auto const why = filter_->refusal(cells); why && !why->empty()) {
            protocol_.add(kind::dropped, s_.name, "", *why, line);
            return;
        }
        if (form_.heading != false && cells == first_)
            fail(line, 0, "the heading stands here again: files were joined",
                 "remove the line; if the times begin anew, cut the file here");
        bool const blank =
            std::all_of(cells.begin(), cells.end(), [](auto const& c) { return c.empty(); });
        if (cells.size() == headings_.size() + 1 && cells.back().empty() && !blank)
            cells.pop_back(); // a separator at the end
        if (cells.size() < headings_.size() && form_.short_lines) {
            protocol_.add(kind::changed, s_.name, "",
                          "cells are missing at the end of the line: no readings, as the mapping "
                          "says",
                          line);
            cells.resize(headings_.size());
        }
        if (cells.size() != headings_.size())
            fail(line, 0,
                 text_of(std::to_string(cells.size()), " cells in a table of ",
                         std::to_string(headings_.size()), " columns"),
                 text_of(cells.size() < headings_.size()
                             ? "state \"short_lines\": \"missing\" in the mapping's source if the "
                               "cells at its end were left out, "
                             : "",
                         "correct the line, or import the file as a serial log, which drops such "
                         "lines"));
        require_no_units(line, cells);
        auto const stamp = time_column_ ? time(line, cells[*time_column_]) : std::nullopt;
        std::vector<std::optional<exact_decimal>> readings;
        for (auto const c : columns_) readings.push_back(number(line, c, cells[c]));
        kinds_->count(cells, form_);
        rows_.add(line, stamp, std::move(readings));
        any_row_ = true;
    }

    /// The line below the heading may name units.
    void require_no_units(std::size_t line, cells_of_line const& cells) const {
        if (any_row_ || form_.heading == false) return;
        auto used = columns_;
        if (time_column_) used.push_back(*time_column_);
        bool text = false;
        for (auto const c : used) {
            if (parse_reading(cells[c], form_.decimal) || stamps_.about(cells[c])) return;
            text = text || !(form_.is_missing(cells[c]) || means_nothing(cells[c]));
        }
        bool const timed = time_column_ && !form_.is_missing(cells[*time_column_]);
        if (!text || (time_column_ && !timed)) return;
        fail(line, 0,
             "no mapped cell of the first line below the heading is a number: it may name units",
             text_of("state \"skip_after_heading\": ", std::to_string(form_.skip_after_heading + 1),
                     " in the mapping's source"));
    }

    [[nodiscard]] std::optional<exact_decimal> time(std::size_t line, std::string const& cell) {
        if (form_.is_missing(cell)) return std::nullopt;
        auto const column = *time_column_ + 1;
        if (auto const other = stamps_.other_offset(cell))
            fail(line, column, other->problem, other->remedy);
        if (auto const stamp = stamps_(cell)) return stamp;
        if (auto const known = stamps_.about(cell))
            fail(line, column, known->problem, known->remedy);
        fail(line, column, in_quotes(cell) + " is no time of the unit that the mapping states",
             hidden_in(cell).empty() && !is_hexadecimal(cell) ? "correct it, or remove the line"
                                                              : number_remedy(cell, form_.decimal));
    }
    [[nodiscard]] std::optional<exact_decimal> number(std::size_t line, std::size_t column,
                                                      std::string const& cell) const {
        if (form_.is_missing(cell)) return std::nullopt;
        auto const value = parse_reading(cell, form_.decimal);
        if (!value)
            fail(line, column + 1, in_quotes(cell) + " is not a finite number",
                 number_remedy(cell, form_.decimal));
        return value;
    }

    scenario_mapping const& s_;
    source_form const& form_;
    import_protocol& protocol_;
    std::string file_;
    stamp_reader stamps_;
    recorded_rows rows_;
    std::size_t skip_;
    std::size_t passed_ = 0; ///< the last line that may have been a row
    bool any_row_ = false;
    std::optional<std::pair<std::size_t, cells_of_line>> comment_; ///< the last above the heading
    cells_of_line headings_, first_; ///< names of the columns, and the line that they come from
    std::vector<std::size_t> columns_;
    std::optional<std::size_t> time_column_;
    std::optional<line_filter> filter_;
    std::optional<line_kinds> kinds_;
};

/// Reads a table in the form and with the columns that the mapping states. A table is refused where
/// a log would be cleaned.
///   Blanks alone are a row without a reading where they make as many cells as a row has, and where
/// there is one column. Other blank lines and comments are noted; without a column of times they
/// may stand above and below the rows only, since the rows after one that is lost would be early.
/// A comment that has all headings that the mapping names is the heading.
/// @throws input_error  for a ragged line, a cell that is no number, a time that does not increase,
///                      a first line of which nobody knows whether it is a heading, lines of
///                      several kinds
[[nodiscard]] inline recorded_table
read_recorded_table(scenario_mapping const& s, std::string_view text, import_protocol& protocol) {
    return recorded_table_reader{s, protocol}.read(text);
}

} // namespace sivid

#endif // SIVID_IMPORTING_TABLE_DETAIL_RECORDED_TABLE_HPP
