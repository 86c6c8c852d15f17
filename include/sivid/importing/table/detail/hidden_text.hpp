// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_TABLE_DETAIL_HIDDEN_TEXT_HPP
#define SIVID_IMPORTING_TABLE_DETAIL_HIDDEN_TEXT_HPP

#include <sivid/io/input_error.hpp>
#include <sivid/io/text/printable_text.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

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

} // namespace sivid

#endif // SIVID_IMPORTING_TABLE_DETAIL_HIDDEN_TEXT_HPP
