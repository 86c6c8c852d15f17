// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_TEXT_PRINTABLE_TEXT_HPP
#define SIVID_IO_TEXT_PRINTABLE_TEXT_HPP

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace sivid {

namespace io_detail {

/// One code point at the begin of a text, and its bytes; size 1 and value `bad` for a byte that is
/// no UTF-8.
struct code_point {
    static constexpr std::uint32_t bad = 0xFFFFFFFF;
    std::uint32_t value = bad;
    std::size_t size = 1;
};

[[nodiscard]] inline code_point first_code_point(std::string_view text) {
    auto const byte = [&](std::size_t i) {
        return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i]));
    };
    auto const lead = byte(0);
    if (lead < 0x80) return {lead, 1};
    std::size_t const size = lead >= 0xF0 && lead < 0xF5   ? 4
                             : lead >= 0xE0 && lead < 0xF0 ? 3
                             : lead >= 0xC2 && lead < 0xE0 ? 2
                                                           : 0;
    if (size == 0 || size > text.size()) return {};
    std::uint32_t value = lead & (0x7Fu >> size);
    for (std::size_t i = 1; i < size; ++i) {
        if ((byte(i) & 0xC0u) != 0x80u) return {};
        value = value << 6 | (byte(i) & 0x3Fu);
    }
    bool const too_long = (size == 3 && value < 0x800) || (size == 4 && value < 0x10000);
    if (too_long || value > 0x10FFFF || (value >= 0xD800 && value < 0xE000)) return {};
    return {value, size};
}

/// What has no place in a line of text: control characters (C0, DEL, C1), line and paragraph
/// separators, and marks without a width that hide text or turn its direction.
[[nodiscard]] constexpr bool is_unprintable(std::uint32_t c) {
    return c < 0x20 || (c >= 0x7F && c < 0xA0) || c == 0xAD || c == 0x61C || c == 0x180E ||
           c == 0x200B || (c >= 0x200E && c <= 0x200F) || (c >= 0x2028 && c <= 0x202E) ||
           (c >= 0x2060 && c <= 0x206F) || c == 0xFEFF || (c >= 0xFFF9 && c <= 0xFFFB) ||
           (c >= 0xE0000 && c <= 0xE0FFF) || c > 0x10FFFF;
}

} // namespace io_detail

/// What of a text must not go to a terminal, a table or a page: the first control character, mark
/// that turns or hides text, or byte that is no UTF-8; its number as U+001B. Empty when there is
/// none.
[[nodiscard]] inline std::string unprintable_in(std::string_view text) {
    while (!text.empty()) {
        auto const c = io_detail::first_code_point(text);
        if (c.value == io_detail::code_point::bad) return "a byte that is not UTF-8";
        if (io_detail::is_unprintable(c.value)) {
            std::string number;
            for (auto rest = c.value; rest > 0 || number.size() < 4; rest /= 16) {
                number.insert(number.begin(), "0123456789ABCDEF"[rest % 16]);
            }
            return "U+" + number;
        }
        text.remove_prefix(c.size);
    }
    return {};
}

/// A text from outside as it may go to a terminal, a table or a page: each control character, mark
/// that turns or hides text, and byte that is no UTF-8 is '?'.
/// @param longest  bytes; what is longer ends in "..."
/// @param lines    line feeds stay
[[nodiscard]] inline std::string printable_text(std::string_view text,
                                                std::size_t longest = std::string_view::npos,
                                                bool lines = false) {
    std::string result;
    while (!text.empty()) {
        auto const c = io_detail::first_code_point(text);
        if (c.size > longest - std::min(longest, result.size())) return result + "...";
        bool const stays = (lines && c.value == '\n') || !io_detail::is_unprintable(c.value);
        result += stays ? text.substr(0, c.size) : std::string_view{"?"};
        text.remove_prefix(c.size);
    }
    return result;
}

/// The same of a path: what is longer loses its begin, since its end tells more.
[[nodiscard]] inline std::string printable_path(std::string_view path, std::size_t longest = 200) {
    if (path.size() <= longest) return printable_text(path);
    auto begin = path.size() - longest;
    while (begin < path.size() && (static_cast<unsigned char>(path[begin]) & 0xC0u) == 0x80u) {
        ++begin;
    }
    return "..." + printable_text(path.substr(begin));
}

} // namespace sivid

#endif // SIVID_IO_TEXT_PRINTABLE_TEXT_HPP
