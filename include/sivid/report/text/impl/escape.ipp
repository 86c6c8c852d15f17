// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_TEXT_IMPL_ESCAPE_IPP
#define SIVID_REPORT_TEXT_IMPL_ESCAPE_IPP

#include <sivid/report/text/escape.hpp>

#include <sivid/io/text/printable_text.hpp>

#include <cstdint>

namespace sivid::report {

/// The code point at the front of a non-empty text; one bad byte of what UTF-8 or XML 1.0 forbids
/// (controls, non-characters), and of direction overrides: they could make a name read as another
/// one.
inline io_detail::code_point shown_code_point(std::string_view text) {
    auto const c = io_detail::first_code_point(text);
    auto const within = [&](std::uint32_t from, std::uint32_t to) {
        return from <= c.value && c.value <= to;
    };
    bool const control =
        (c.value < 0x20 && c.value != '\t' && c.value != '\n') || within(0x7F, 0x9F);
    bool const non_character = (c.value & 0xFFFEu) == 0xFFFEu;
    bool const reordering = within(0x202A, 0x202E) || within(0x2066, 0x2069);
    return control || non_character || reordering ? io_detail::code_point{} : c;
}

SIVID_DECL std::string escape(std::string_view text) {
    std::string out;
    out.reserve(text.size() + text.size() / 8);
    while (!text.empty()) {
        auto const c = shown_code_point(text);
        if (c.value == io_detail::code_point::bad) {
            out += "\xEF\xBF\xBD";
        } else if (c.value == '&') {
            out += "&amp;";
        } else if (c.value == '<') {
            out += "&lt;";
        } else if (c.value == '>') {
            out += "&gt;";
        } else if (c.value == '"') {
            out += "&quot;";
        } else if (c.value == '\'') {
            out += "&#39;";
        } else {
            out += text.substr(0, c.size);
        }
        text.remove_prefix(c.size);
    }
    return out;
}

SIVID_DECL double approximate_text_width(std::string_view text, double size) {
    double em = 0;
    while (!text.empty()) {
        auto const c = shown_code_point(text);
        bool const narrow =
            std::string_view{"iljtfrI.,:;|!'()[]/ "}.find(
                c.value < 0x80 ? static_cast<char>(c.value) : 'x') != std::string_view::npos;
        bool const wide = c.value < 0x80 && ((c.value >= 'A' && c.value <= 'Z' && c.value != 'I') ||
                                             c.value == 'm' || c.value == 'w' || c.value == '%');
        em += c.value >= 0x2E80 ? 1.0 : narrow ? 0.32 : wide ? 0.78 : 0.62;
        text.remove_prefix(c.size);
    }
    return em * size;
}

SIVID_DECL std::string shorten(std::string_view text, std::size_t longest) {
    std::size_t end = 0;
    std::size_t count = 0;
    std::size_t end_before_ellipsis = 0;
    while (end < text.size()) {
        if (count + 1 == longest) end_before_ellipsis = end;
        if (count == longest) {
            return std::string{text.substr(0, end_before_ellipsis)} + "\xE2\x80\xA6";
        }
        end += shown_code_point(text.substr(end)).size;
        ++count;
    }
    return std::string{text};
}

} // namespace sivid::report

#endif
