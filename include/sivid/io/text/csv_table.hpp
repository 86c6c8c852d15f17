// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_TEXT_CSV_TABLE_HPP
#define SIVID_IO_TEXT_CSV_TABLE_HPP

#include <sivid/io/input_error.hpp>
#include <sivid/io/text/exact_decimal.hpp>
#include <sivid/io/text/text_file.hpp>
#include <sivid/number/text/joined.hpp>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid {

/// A comma-separated table: one heading line, then rows of as many cells. Lines that begin with '#'
/// are comments; blank lines, CRLF ends and a byte-order mark are accepted; there is no quoting,
/// and spaces around a cell do not count.
class csv_table {
public:
    struct row {
        std::size_t line;                        ///< in the file, from 1
        std::span<std::string_view const> cells; ///< as long as a table of this text lives
    };

    /// @throws input_error when missing, empty, quoted or ragged
    [[nodiscard]] static csv_table read(std::filesystem::path const& file) {
        return csv_table{file.string(), read_text(file)};
    }

    csv_table(std::string file, std::string text)
        : file_{std::move(file)}, content_{std::make_shared<content>(std::move(text))} {
        std::string_view rest = content_->text;
        std::vector<std::size_t> lines;
        std::size_t number = 0;
        while (!rest.empty()) {
            auto const end = std::min(rest.find('\n'), rest.size());
            auto line = rest.substr(0, end);
            rest.remove_prefix(std::min(end + 1, rest.size()));
            ++number;
            if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
            if (line.empty() || line.front() == '#' ||
                line.find_first_not_of(" \t") == std::string_view::npos)
                continue;
            if (headings_.empty()) {
                add_headings(number, line);
            } else {
                add_row(number, line);
                lines.push_back(number);
            }
        }
        if (headings_.empty())
            throw input_error{{.file = file_},
                              content_->text.empty() ? "the file is empty: no heading line"
                                                     : "no heading line",
                              "the first line names the columns: t,..."};
        std::span<std::string_view const> cells = content_->cells;
        rows_.reserve(lines.size());
        for (auto const line : lines) {
            rows_.push_back({line, cells.first(headings_.size())});
            cells = cells.subspan(headings_.size());
        }
    }

    [[nodiscard]] std::vector<std::string> const& headings() const { return headings_; }
    [[nodiscard]] std::size_t heading_line() const { return heading_line_; }
    [[nodiscard]] std::vector<row> const& rows() const { return rows_; }

    /// The column of this heading, or nothing.
    [[nodiscard]] std::optional<std::size_t> column(std::string_view heading) const {
        for (std::size_t i = 0; i < headings_.size(); ++i)
            if (headings_[i] == heading) return i;
        return std::nullopt;
    }

    /// The column of this heading.
    /// @throws input_error that names the columns there are
    [[nodiscard]] std::size_t required_column(std::string_view heading) const {
        if (auto const found = column(heading)) return *found;
        auto const known = joined(headings_, ", ", [](auto const& h) { return in_quotes(h); });
        bool const one = headings_.size() == 1;
        fail(heading_line_, "no column " + in_quotes(heading) + "; it has: " + known,
             one ? "cells are separated by commas" : "rename a column");
    }

    /// The number in a cell that must not be empty; that its double is finite is checked here.
    [[nodiscard]] exact_decimal number(row const& r, std::size_t column) const {
        auto const& cell = r.cells[column];
        if (cell.empty()) fail(r.line, column, "the cell is empty", "give a number");
        auto const value = exact_decimal::parse(cell);
        if (!value)
            fail(r.line, column, in_quotes(cell) + " is not a finite number",
                 "write a decimal such as 0.25 or 1e-3");
        if (!value->is_below_power_of_ten(308) && !enclose(*value))
            fail(r.line, column, in_quotes(cell) + " is beyond the range of double",
                 "give a smaller number");
        return *value;
    }

    [[noreturn]] void fail(std::size_t line, std::size_t column, std::string problem,
                           std::string remedy) const {
        throw input_error{{.file = file_,
                           .line = line,
                           .column = column + 1,
                           .heading = column < headings_.size() ? headings_[column] : "",
                           .pointer = ""},
                          std::move(problem),
                          std::move(remedy)};
    }
    [[noreturn]] void fail(std::size_t line, std::string problem, std::string remedy) const {
        throw input_error{{.file = file_, .line = line}, std::move(problem), std::move(remedy)};
    }

private:
    /// What the cells are views of: shared by the copies of a table.
    struct content {
        explicit content(std::string t) : text{std::move(t)} {}
        std::string const text;
        std::vector<std::string_view> cells; ///< row by row
    };

    void add_headings(std::size_t number, std::string_view line) {
        std::vector<std::string_view> cells;
        split(number, line, cells);
        heading_line_ = number;
        std::set<std::string_view> names;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            if (cells[i].empty())
                fail(number, i, "a column without a heading", "name it or remove it");
            if (!names.insert(cells[i]).second)
                fail(number, i, text_of("the heading ", in_quotes(cells[i]), " appears twice"),
                     "keep one of the columns");
        }
        headings_.assign(cells.begin(), cells.end());
    }

    void add_row(std::size_t number, std::string_view line) {
        auto const before = content_->cells.size();
        split(number, line, content_->cells);
        auto const count = content_->cells.size() - before;
        if (count != headings_.size())
            fail(number, std::min(count, headings_.size()),
                 std::to_string(count) + " cells in a table of " +
                     std::to_string(headings_.size()) + " columns",
                 "give every line as many cells as the heading, empty ones for missing samples");
    }

    void split(std::size_t number, std::string_view line,
               std::vector<std::string_view>& cells) const {
        for (std::size_t i = 0;; ++i) {
            auto const end = std::min(line.find(','), line.size());
            auto cell = line.substr(0, end);
            auto const first = std::min(cell.find_first_not_of(" \t"), cell.size());
            cell.remove_prefix(first);
            cell = cell.substr(0, cell.find_last_not_of(" \t") + 1);
            if (cell.find('"') != std::string_view::npos)
                fail(number, i, "a quotation mark", "cells are plain: remove the quotation marks");
            cells.push_back(cell);
            if (end == line.size()) return;
            line.remove_prefix(end + 1);
        }
    }

    std::string file_;
    std::shared_ptr<content> content_;
    std::size_t heading_line_ = 0;
    std::vector<std::string> headings_;
    std::vector<row> rows_;
};

} // namespace sivid

#endif // SIVID_IO_TEXT_CSV_TABLE_HPP
