// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_TABLE_DETAIL_RECORDED_TEXT_HPP
#define SIVID_IMPORTING_TABLE_DETAIL_RECORDED_TEXT_HPP

#include <sivid/io/input_error.hpp>
#include <sivid/io/text/exact_decimal.hpp>
#include <sivid/io/text/printable_text.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid {

/// What stands in a cell or a line though an editor does not show it, by its name; "" where nothing
/// does.
[[nodiscard]] inline std::string hidden_in(std::string_view text) {
    constexpr std::pair<std::uint32_t, char const*> known[] = {
        {0x0000, "a NUL byte, as a loss of power leaves"},
        {0x000D, "a CR inside the line, which some programs end lines with"},
        {0x00A0, "a no-break space (U+00A0)"},
        {0x2007, "a figure space (U+2007)"},
        {0x2009, "a thin space (U+2009)"},
        {0x200B, "a space without width (U+200B)"},
        {0x202F, "a narrow no-break space (U+202F)"},
        {0x2212, "a minus sign of typesetters (U+2212)"},
        {0xFEFF, "a byte-order mark (U+FEFF)"}};
    for (; !text.empty(); text.remove_prefix(io_detail::first_code_point(text).size)) {
        auto const c = io_detail::first_code_point(text);
        for (auto const& [value, name] : known)
            if (c.value == value) return name;
        if (c.value == io_detail::code_point::bad && text.front() == '\xA0')
            return "a no-break space of Latin-1 (byte A0)";
    }
    return {};
}

/// Whether bytes are text of two bytes a character: with its byte-order mark, or with zeros in
/// every other place of its begin.
[[nodiscard]] inline bool is_utf16(std::string_view text) {
    if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) return true;
    std::size_t zeros[2] = {0, 0};
    auto const begin = text.substr(0, 4096);
    for (std::size_t i = 0; i < begin.size(); ++i) zeros[i % 2] += begin[i] == '\0';
    auto const [few, many] = std::minmax(zeros[0], zeros[1]);
    return 4 * many > begin.size() &&
           8 * few < many; // half of one parity, nearly none of the other
}

/// Refuses what would not come apart into lines.
/// @throws input_error
inline void require_lines(std::string_view text, std::string const& file) {
    if (is_utf16(text))
        throw input_error{{.file = file}, "the file is UTF-16", "convert it to UTF-8"};
    if (text.find('\n') == std::string_view::npos && text.find('\r') != std::string_view::npos)
        throw input_error{
            {.file = file}, "the lines end with CR alone", "convert the line ends to LF or CRLF"};
}

/// A line of a recorded file.
struct recorded_line {
    std::size_t number = 0; ///< from 1
    std::string_view text;  ///< without its end
    bool ended = true;      ///< false: the file ends before the line does
};

/// The lines of a text, ended by LF or CRLF. A byte-order mark at the begin of one, as where files
/// were joined, is no part of it.
[[nodiscard]] inline std::vector<recorded_line> lines_of(std::string_view text) {
    std::vector<recorded_line> lines;
    while (!text.empty()) {
        auto const end = text.find('\n');
        auto line = text.substr(0, end);
        if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
        if (line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
        lines.push_back({lines.size() + 1, line, end != std::string_view::npos});
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    }
    return lines;
}

/// @param separator  of cells: it is no blank
[[nodiscard]] inline std::string_view without_blanks(std::string_view text, char separator = ' ') {
    std::string_view const blanks = separator == '\t' ? " " : " \t";
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    return text.substr(0, text.find_last_not_of(blanks) + 1);
}

/// The cells of a line; blanks around them do not count. The separator ' ' stands for any run of
/// blanks. A cell in quotation marks may hold separators, and "" for a quotation mark.
/// @returns nothing when a quotation mark is out of place
[[nodiscard]] inline std::optional<std::vector<std::string>> split_cells(std::string_view line,
                                                                         char separator) {
    std::vector<std::string> cells;
    if (separator == ' ') {
        constexpr std::string_view blanks = " \t";
        for (auto rest = without_blanks(line); !rest.empty();) {
            auto const end = std::min(rest.find_first_of(blanks), rest.size());
            cells.emplace_back(rest.substr(0, end));
            rest = without_blanks(rest.substr(end));
        }
        return cells;
    }
    while (true) {
        auto const first = line.find_first_not_of(separator == '\t' ? " " : " \t");
        if (first != std::string_view::npos && line[first] == '"') {
            std::string cell;
            line.remove_prefix(first + 1);
            while (true) {
                auto const quote = line.find('"');
                if (quote == std::string_view::npos) return std::nullopt;
                cell += line.substr(0, quote);
                line.remove_prefix(quote + 1);
                if (line.empty() || line.front() != '"') break;
                cell += '"';
                line.remove_prefix(1);
            }
            auto const end = std::min(line.find(separator), line.size());
            if (!without_blanks(line.substr(0, end)).empty()) return std::nullopt;
            cells.push_back(std::move(cell));
            if (end == line.size()) return cells;
            line.remove_prefix(end + 1);
            continue;
        }
        auto const end = std::min(line.find(separator), line.size());
        auto const cell = line.substr(0, end);
        if (cell.find('"') != std::string_view::npos) return std::nullopt;
        cells.emplace_back(without_blanks(cell));
        if (end == line.size()) return cells;
        line.remove_prefix(end + 1);
    }
}

/// The number in a cell, with this decimal mark; its double is finite.
/// @returns nothing when it is no such number, or longer than 400 characters
[[nodiscard]] inline std::optional<exact_decimal> parse_reading(std::string_view cell,
                                                                char decimal) {
    constexpr std::size_t longest = 400;
    if (cell.size() > longest) return std::nullopt;
    std::string text{cell};
    if (decimal != '.') {
        if (text.find('.') != std::string::npos) return std::nullopt;
        std::replace(text.begin(), text.end(), decimal, '.');
    }
    auto const value = exact_decimal::parse(text);
    if (!value || !nearest(*value)) return std::nullopt;
    return value;
}

} // namespace sivid

#endif // SIVID_IMPORTING_TABLE_DETAIL_RECORDED_TEXT_HPP
