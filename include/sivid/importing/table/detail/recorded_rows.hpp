// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_TABLE_DETAIL_RECORDED_ROWS_HPP
#define SIVID_IMPORTING_TABLE_DETAIL_RECORDED_ROWS_HPP

#include <sivid/importing/detail/import_mapping.hpp>
#include <sivid/importing/detail/import_protocol.hpp>
#include <sivid/importing/table/detail/recorded_text.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// Readings of one recorded stretch: rows at increasing times, in a log several in one tick.
struct recorded_table {
    struct row {
        std::size_t line = 0;
        exact_decimal time;                              ///< [s], before the offset
        std::vector<std::optional<exact_decimal>> cells; ///< see columns_of; nothing: missing
        std::size_t lost{}; ///< lines above it that may have been rows and were dropped
    };
    std::vector<row> rows;
    std::size_t first_line = 0, last_line = 0;
};

/// The columns that a scenario needs of its first file, in the order of recorded_table's cells: for
/// the inputs, the channels and what is watched, the value's and, where the bound has one, the
/// bound's; then that of the rows that windows are cut of.
[[nodiscard]] inline std::vector<column_reference> columns_of(scenario_mapping const& s) {
    std::vector<column_reference> result;
    for (auto const* list : {&s.inputs, &s.channels, &s.watched})
        for (auto const& q : *list) {
            if (q.elsewhere) continue;
            result.insert(result.end(), q.columns.begin(), q.columns.end());
            if (q.error.from == bound_source::kind::column) result.push_back(q.error.column);
        }
    if (s.windows && s.windows->rows) result.push_back(s.windows->rows->column);
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
    std::string known, hidden;
    std::size_t found = headings.size();
    for (std::size_t i = 0; i < headings.size(); ++i) {
        if (hidden.empty()) hidden = hidden_in(headings[i]);
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
                                  hidden.empty() ? "" : "; one of them holds ", hidden,
                                  "; check \"separator\" and the lines before the heading "
                                  "(\"skip_lines\"), or name the column by its number")};
    return found;
}

/// Collects the rows of a table, whose times must increase: it has been through a program that
/// could have written it properly. Rows at one time that say the same are one.
class recorded_rows {
public:
    /// @param fail  (line, is it the time, problem, remedy): throws input_error
    using complaint =
        std::function<void(std::size_t, bool, std::string const&, std::string const&)>;
    recorded_rows(scenario_mapping const& s, import_protocol& protocol, complaint fail)
        : s_{s}, protocol_{protocol}, fail_{std::move(fail)} {}

    /// @param stamp  as read; without a column of times the row's number says when it was
    void add(std::size_t line, std::optional<exact_decimal> const& stamp,
             std::vector<std::optional<exact_decimal>> cells) {
        auto const& step = s_.time.sample_time;
        if (!step && !stamp)
            fail_(line, true, "the time is missing", "state it or remove the line");
        auto const seconds = s_.time.to_seconds(step ? step->times(table_.rows.size()) : *stamp);
        if (!seconds) fail_(line, true, "the time is beyond the range of double", "check its unit");
        auto const time = seconds->value + days_;
        if (table_.first_line == 0) table_.first_line = line;
        table_.last_line = line;
        recorded_table::row row{line, time, std::move(cells)};
        if (table_.rows.empty() || table_.rows.back().time < time)
            table_.rows.push_back(std::move(row));
        else if (table_.rows.back().time == time)
            add_double(std::move(row));
        else
            add_earlier(std::move(row));
    }
    [[nodiscard]] recorded_table take() { return std::move(table_); }

private:
    using kind = import_protocol::kind;

    void drop(std::size_t line, char const* why) {
        protocol_.add(kind::dropped, s_.name, "", why, line);
    }

    /// Another row at the time of the last one.
    void add_double(recorded_table::row row) {
        auto& last = table_.rows.back();
        bool other = false, contrary = false; // readings beside those of the last one, against them
        for (std::size_t i = 0; i < row.cells.size(); ++i) {
            other = other || row.cells[i] != last.cells[i];
            contrary = contrary || (row.cells[i] && last.cells[i] && row.cells[i] != last.cells[i]);
        }
        if (other && !contrary) return table_.rows.push_back(std::move(row));
        if (!other)
            return drop(row.line, "repeats the time and the readings of the line before it");
        if (s_.form.doubled == same_time::first)
            return drop(row.line, "the time of the line before it, whose readings count, as the "
                                  "mapping says");
        if (s_.form.doubled == same_time::refuse)
            fail_(row.line, true,
                  text_of("the time ", in_quotes(last.time.text()), " s is that of line ",
                          std::to_string(last.line), ", with other readings"),
                  "state in the mapping's source \"same_time\": \"first\" or \"last\" for which of "
                  "them counts, or \"lines\" if they are of two kinds; if rows follow each other "
                  "evenly, state the time's \"sample_time\" instead of its column");
        drop(last.line, "the time of the next line, whose readings count, as the mapping says");
        last = std::move(row);
    }

    /// A row whose time is before that of the last one: a clock has begun a new day, or a defect.
    void add_earlier(recorded_table::row row) {
        auto const day = *exact_decimal::parse("86400");
        auto const back = table_.rows.back().time - row.time;
        if (s_.time.form == time_form::clock && day < back + back) {
            days_ = days_ + day;
            row.time = row.time + day;
            protocol_.add(
                kind::decided, s_.name, "",
                "the clock goes back by more than half a day: one midnight has passed; whole "
                "days more would look the same",
                row.line);
            if (table_.rows.back().time < row.time) {
                table_.rows.push_back(std::move(row));
            } else { // 24:00:00, then 00:00:00
                add_double(std::move(row));
            }
            return;
        }
        fail_(
            row.line, true,
            text_of("the time goes back from ", table_.rows.back().time.text(), " to ",
                    row.time.text(), " s"),
            text_of("the recorder began again, its counter wrapped, or files were joined: ",
                    s_.form.from == source_form::kind::matlab
                        ? "cut the vectors here"
                        : "cut the file here, or import it as a serial log (\"kind\": \"serial\") "
                          "with \"restart\" or the time's \"counter_bits\""));
    }

    scenario_mapping const& s_;
    import_protocol& protocol_;
    complaint fail_;
    recorded_table table_;
    exact_decimal days_; ///< since the first row's midnight [s]
};

} // namespace sivid

#endif // SIVID_IMPORTING_TABLE_DETAIL_RECORDED_ROWS_HPP
