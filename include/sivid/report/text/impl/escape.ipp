// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_TEXT_IMPL_ESCAPE_IPP
#define SIVID_REPORT_TEXT_IMPL_ESCAPE_IPP

#include <sivid/report/text/escape.hpp>

namespace sivid::report {

SIVID_DECL code_point first_code_point(std::string_view text) {
    auto const byte = [&](std::size_t i) {
        return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i]));
    };
    std::uint32_t const lead = byte(0);
    if (lead < 0x80) {
        bool const fine = lead >= 0x20 ? lead != 0x7F : (lead == '\t' || lead == '\n');
        return fine ? code_point{lead, 1, true} : code_point{};
    }
    std::size_t const length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
    if (lead < 0xC2 || lead > 0xF4 || text.size() < length) {
        return {};
    }
    std::uint32_t value = lead & (0x7Fu >> length);
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xC0u) != 0x80u) {
            return {};
        }
        value = (value << 6) | (byte(i) & 0x3Fu);
    }
    static constexpr std::array<std::uint32_t, 5> smallest{0, 0, 0x80, 0x800, 0x10000};
    bool const surrogate = value >= 0xD800 && value <= 0xDFFF;
    bool const control = value >= 0x80 && value < 0xA0;
    bool const non_character = (value & 0xFFFEu) == 0xFFFEu;
    // Direction overrides could make a name read as another one.
    bool const reordering =
        (value >= 0x202A && value <= 0x202E) || (value >= 0x2066 && value <= 0x2069);
    if (value < smallest[length] || value > 0x10FFFF || surrogate || control || non_character ||
        reordering) {
        return {};
    }
    return {value, length, true};
}

SIVID_DECL std::string escape(std::string_view text) {
    std::string out;
    out.reserve(text.size() + text.size() / 8);
    while (!text.empty()) {
        code_point const c = first_code_point(text);
        if (!c.valid) {
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
            out += text.substr(0, c.bytes);
        }
        text.remove_prefix(c.bytes);
    }
    return out;
}

SIVID_DECL double approximate_text_width(std::string_view text, double size) {
    double em = 0;
    while (!text.empty()) {
        code_point const c = first_code_point(text);
        bool const narrow =
            std::string_view{"iljtfrI.,:;|!'()[]/ "}.find(
                c.value < 0x80 ? static_cast<char>(c.value) : 'x') != std::string_view::npos;
        bool const wide = c.value < 0x80 && ((c.value >= 'A' && c.value <= 'Z' && c.value != 'I') ||
                                             c.value == 'm' || c.value == 'w' || c.value == '%');
        em += c.value >= 0x2E80 ? 1.0 : narrow ? 0.32 : wide ? 0.78 : 0.62;
        text.remove_prefix(c.bytes);
    }
    return em * size;
}

SIVID_DECL std::string shorten(std::string_view text, std::size_t longest) {
    std::size_t end = 0;
    std::size_t count = 0;
    std::size_t end_before_ellipsis = 0;
    while (end < text.size()) {
        if (count + 1 == longest) {
            end_before_ellipsis = end;
        }
        if (count == longest) {
            return std::string{text.substr(0, end_before_ellipsis)} + "\xE2\x80\xA6";
        }
        end += first_code_point(text.substr(end)).bytes;
        ++count;
    }
    return std::string{text};
}

} // namespace sivid::report

#endif
