// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_TEXT_DETAIL_DECIMAL_TEXT_HPP
#define SIVID_NUMBER_TEXT_DETAIL_DECIMAL_TEXT_HPP

/// @file
/// The syntax of number texts and their exact rounding to neighbouring doubles. Work is bounded:
/// digits past the 800th only matter by being zero or not, exponents saturate.

#include <sivid/compiled.hpp>

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace sivid::detail {

/// A number text taken apart: (-1)^negative * 0.d1 d2 d3 ... * 10^point, or hexadecimal
/// 0.h1 h2 ... * 16^point * 2^exponent2. Digits are those of `text` from `first` on, separators and
/// the point left out.
struct number_text {
    bool valid = false, negative = false, hexadecimal = false;
    std::size_t first = 0, digit_count = 0; ///< from the first non-zero digit to the last digit
    std::int64_t point = 0;
    std::int64_t exponent2 = 0;
};

/// Exponents saturate here: far outside the range of double, far inside that of int64.
inline constexpr std::int64_t exponent_limit = 1'000'000'000'000;

constexpr int digit_value(char c, bool hexadecimal) noexcept {
    if (c >= '0' && c <= '9') return c - '0';
    if (!hexadecimal) return -1;
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/// [+-] digits [. digits] [e [+-] digits], or [+-] 0x hexdigits [. hexdigits] [p [+-] digits]. At
/// least one digit; `'` may separate digits as in C++ literals. Nothing else: no blanks, inf, nan.
constexpr number_text scan_number(std::string_view text) noexcept {
    number_text n;
    std::size_t i = 0;
    if (i < text.size() && (text[i] == '+' || text[i] == '-')) n.negative = text[i++] == '-';
    if (i + 1 < text.size() && text[i] == '0' && (text[i + 1] == 'x' || text[i + 1] == 'X')) {
        n.hexadecimal = true;
        i += 2;
    }
    bool any = false, seen_point = false, significant = false;
    for (; i < text.size(); ++i) {
        char const c = text[i];
        if (c == '\'') {
            bool const between = i > 0 && i + 1 < text.size() &&
                                 digit_value(text[i - 1], n.hexadecimal) >= 0 &&
                                 digit_value(text[i + 1], n.hexadecimal) >= 0;
            if (!between) return n;
            continue;
        }
        if (c == '.') {
            if (seen_point) return n;
            seen_point = true;
            continue;
        }
        int const d = digit_value(c, n.hexadecimal);
        if (d < 0) break;
        any = true;
        if (!significant && d != 0) {
            significant = true;
            n.first = i;
        }
        if (significant) ++n.digit_count;
        if (significant && !seen_point) ++n.point;
        if (!significant && seen_point) --n.point;
    }
    if (!any) return n;
    if (i < text.size()) {
        char const e = text[i++];
        bool const fits = n.hexadecimal ? e == 'p' || e == 'P' : e == 'e' || e == 'E';
        if (!fits) return n;
        bool down = false;
        if (i < text.size() && (text[i] == '+' || text[i] == '-')) down = text[i++] == '-';
        if (i == text.size()) return n;
        std::int64_t value = 0;
        for (; i < text.size(); ++i) {
            if (text[i] == '\'' && digit_value(text[i - 1], false) >= 0 && i + 1 < text.size())
                continue;
            int const d = digit_value(text[i], false);
            if (d < 0) return n;
            value = value * 10 + d;
            if (value > exponent_limit) value = exponent_limit;
        }
        (n.hexadecimal ? n.exponent2 : n.point) += down ? -value : value;
    }
    n.valid = true;
    return n;
}

/// |number| between neighbouring doubles.
struct rounded_magnitude {
    double below = 0.0;    ///< the greatest double <= |number|; the greatest of all if it overflows
    bool exact = true;     ///< `below` is the number
    bool overflow = false; ///< |number| > greatest double
    int half = -1;         ///< sign of |number| - middle of the neighbours, when not exact
};

/// Exact rounding of a valid text.  @cost  up to 20 us for long texts and large exponents
[[nodiscard]] SIVID_DECL rounded_magnitude round_text(std::string_view text, number_text const& n);

} // namespace sivid::detail

#ifndef SIVID_COMPILED
#include <sivid/number/text/impl/decimal_text.ipp>
#endif

#endif
