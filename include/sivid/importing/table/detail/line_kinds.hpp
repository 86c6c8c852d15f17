// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_TABLE_DETAIL_LINE_KINDS_HPP
#define SIVID_IMPORTING_TABLE_DETAIL_LINE_KINDS_HPP

#include <sivid/importing/detail/import_mapping.hpp>
#include <sivid/importing/table/detail/recorded_rows.hpp>
#include <sivid/importing/table/detail/time_text.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid {

/// Whether a text says in one of the usual ways that there is no reading.
[[nodiscard]] inline bool means_nothing(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    for (auto const* word :
         {"nan", "inf", "+inf", "-inf", "n/a", "na", "null", "none", "-", "--", "---", "?"})
        if (text == word) return true;
    return text.empty();
}

/// A hexadecimal number that is no decimal one.
[[nodiscard]] inline bool is_hexadecimal(std::string_view text) {
    if (text.starts_with("0x") || text.starts_with("0X")) text.remove_prefix(2);
    return !text.empty() &&
           text.find_first_not_of("0123456789abcdefABCDEF") == std::string_view::npos &&
           text.find_first_of("0123456789") != std::string_view::npos;
}

/// What to do about a cell that is no number.
[[nodiscard]] inline std::string number_remedy(std::string const& cell, char decimal) {
    if (auto const hidden = hidden_in(cell); !hidden.empty())
        return "it holds " + hidden + ": remove it, or put what it stands for";
    auto const listed = text_of("list the text under \"missing\" if it means no reading");
    if (means_nothing(cell)) return listed;
    if (is_hexadecimal(cell)) return "it may be hexadecimal: write decimal numbers";
    return text_of(
        "correct it (no marks between thousands), state the mark of decimals (\"decimal\", "
        "now '",
        std::string(1, decimal), "'), or ", listed);
}

/// Whether the lines of a file are of several kinds, as the messages of several sensors in one log:
/// a text that stands in several lines but not in all of them, in a column that nobody reads; or a
/// few whole numbers there that take turns from line to line, as the numbers of sensors do. Which
/// of them count is then a choice, and no import makes it.
class line_kinds {
public:
    /// @param columns  how many there are
    /// @param read     those that the mapping names
    line_kinds(std::size_t columns, std::vector<std::size_t> const& read) : texts_(columns) {
        for (auto const c : read) texts_[c].read = true;
    }

    /// A line that would count.
    void count(std::vector<std::string> const& cells, source_form const& form) {
        for (std::size_t c = 0; c < texts_.size() && c < cells.size(); ++c) {
            auto& column = texts_[c];
            if (column.read) continue;
            auto const& cell = cells[c];
            bool const nothing = form.is_missing(cell) || means_nothing(cell);
            bool const plain = nothing || parse_reading(cell, form.decimal) || read_date(cell) ||
                               read_time_of_day(cell) || cell.starts_with("0x");
            if (plain) {
                ++(nothing ? column.blanks : column.numbers);
                column.turns.count(cell);
            } else if (column.count.size() < most || column.count.count(cell) > 0) {
                ++column.count[cell];
            } else {
                ++column.others;
            }
        }
    }

    /// @param headings  of the columns, "" or "_" where they have no name
    /// @throws input_error  where a text varies, or whole numbers take turns
    void require_one(std::vector<std::string> const& headings, std::string const& file) const {
        for (std::size_t c = 0; c < texts_.size(); ++c) {
            auto const& column = texts_[c];
            if (column.count.empty()) {
                if (!column.turns.taken()) continue;
                auto tags = column;
                tags.count = column.turns.numbers(), tags.numbers = 0;
                refuse(tags, "whole numbers take turns", c, headings[c], file);
            }
            if (column.count.size() == 1 && column.numbers + column.blanks == 0) continue;
            if (most_frequent(column).second == 1) continue; // notes: each stands in one line
            refuse(column, "a text varies", c, headings[c], file);
        }
    }

private:
    static constexpr std::size_t most = 1000; ///< texts that are told apart

    /// Whole numbers that may tell lines apart. A signal has more values, a mode few changes.
    class number_turns {
    public:
        void count(std::string const& cell) {
            constexpr std::size_t kinds = 8; // sensors on one wire
            bool const whole = cell.find_first_not_of("0123456789") == std::string::npos;
            if (!whole || cell.empty() || (seen_.size() == kinds && seen_.count(cell) == 0))
                other_ = true;
            if (other_) return;
            if (lines_++ > 0 && cell != last_) ++changes_;
            last_ = cell;
            ++seen_[cell];
        }
        /// Whether most lines differ from the one before, and each number comes again.
        [[nodiscard]] bool taken() const {
            return !other_ && seen_.size() > 1 && 2 * changes_ > lines_ &&
                   std::all_of(seen_.begin(), seen_.end(),
                               [](auto const& n) { return n.second > 1; });
        }
        [[nodiscard]] std::map<std::string, std::size_t> const& numbers() const { return seen_; }

    private:
        bool other_ = false;
        std::size_t lines_ = 0, changes_ = 0;
        std::string last_;
        std::map<std::string, std::size_t> seen_;
    };
    struct column_texts {
        bool read = false;
        std::size_t numbers = 0, blanks = 0, others = 0;
        std::map<std::string, std::size_t> count;
        number_turns turns;
    };

    [[noreturn]] static void refuse(column_texts const& column, char const* what, std::size_t c,
                                    std::string const& heading, std::string const& file) {
        throw input_error{
            {.file = file, .column = c + 1, .heading = heading == "_" ? std::string{} : heading},
            text_of("the lines are of several kinds: ", what,
                    " in a column that is not mapped: ", listed(column)),
            text_of("state in the mapping's source which count, as in \"lines\": {\"column\": ",
                    std::to_string(c + 1), ", \"is\": \"", most_frequent(column).first,
                    "\"}, or \"lines\": \"all\" if they are of one kind")};
    }

    static std::pair<std::string, std::size_t> most_frequent(column_texts const& column) {
        return *std::max_element(column.count.begin(), column.count.end(),
                                 [](auto const& a, auto const& b) { return a.second < b.second; });
    }
    static std::string listed(column_texts const& column) {
        constexpr std::size_t shown = 8;
        std::vector<std::pair<std::string, std::size_t>> all(column.count.begin(),
                                                             column.count.end());
        std::stable_sort(all.begin(), all.end(),
                         [](auto const& a, auto const& b) { return a.second > b.second; });
        std::string text;
        std::size_t rest = column.others;
        auto const add = [&](std::string const& what, std::size_t count) {
            if (count > 0)
                text += text_of(text.empty() ? "" : ", ", what, " (", std::to_string(count),
                                count == 1 ? " line)" : " lines)");
        };
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (i < shown)
                add(in_quotes(all[i].first), all[i].second);
            else
                rest += all[i].second;
        }
        add("other texts", rest);
        add("numbers", column.numbers);
        add("blanks", column.blanks);
        return text;
    }

    std::vector<column_texts> texts_;
};

/// Tells which lines count, as the mapping says.
class line_filter {
public:
    /// @param headings  of the columns
    line_filter(source_form const& form, std::vector<std::string> const& headings,
                std::string const& file)
        : choice_{form.lines && !form.lines->all ? &*form.lines : nullptr}, file_{file} {
        if (choice_ != nullptr) column_ = find_column(choice_->column, headings, file);
    }

    /// The column that tells the lines apart, if there is one.
    [[nodiscard]] std::optional<std::size_t> column() const {
        return choice_ == nullptr ? std::nullopt : std::optional{column_};
    }
    /// @returns  why the line does not count; "" if it does, nothing where it lacks the column
    [[nodiscard]] std::optional<std::string> refusal(std::vector<std::string> const& cells) {
        if (choice_ == nullptr) return std::string{};
        if (column_ >= cells.size()) return std::nullopt;
        auto const& cell = cells[column_];
        if (choice_->takes(cell)) {
            any_ = true;
            return std::string{};
        }
        constexpr std::size_t most = 20; // notes; a log may have thousands of texts there
        if (others_.size() < most || others_.count(cell) > 0) {
            ++others_[cell];
            return text_of("of another kind, as the mapping says: ", in_quotes(cell));
        }
        return "of another kind, as the mapping says";
    }

    /// @throws input_error  where no line was of the kinds that count
    void require_any() const {
        if (choice_ == nullptr || any_) return;
        std::string known;
        for (auto const& [text, count] : others_)
            known += text_of(known.empty() ? "" : ", ", in_quotes(text), " (",
                             std::to_string(count), count == 1 ? " line)" : " lines)");
        throw input_error{
            choice_->column.place,
            text_of(file_, ": no line has ", in_quotes(choice_->is.front()), " in this column"),
            known.empty() ? "check the column" : "write one of these: " + known};
    }

private:
    line_choice const* choice_;
    std::string file_;
    std::size_t column_ = 0;
    bool any_ = false;
    std::map<std::string, std::size_t> others_;
};

} // namespace sivid

#endif // SIVID_IMPORTING_TABLE_DETAIL_LINE_KINDS_HPP
