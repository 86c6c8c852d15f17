// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_DECIMAL_HPP
#define SIVID_NUMBER_DECIMAL_HPP

/// @file
/// Decimals read and written without losing what they mean: `0.1_dec` is one tenth, not the double
/// nearest to it. Reading gives the tightest enclosure, writing rounds outward.

#include <sivid/compiled.hpp>
#include <sivid/number/interval.hpp>
#include <sivid/number/rounding.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

// The syntax of number texts and their exact rounding to neighbouring doubles. Work is bounded:
// digits past the 800th only matter by being zero or not, exponents saturate.

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

namespace sivid {

namespace detail {

/// Tightest enclosure of a valid text; an upper (lower) bound beyond the range is infinite.
SIVID_DECL interval enclose_text(std::string_view text, number_text const& n, bool negative);

/// The nearest double, ties to even; infinite beyond the range.
SIVID_DECL double nearest_text(std::string_view text, number_text const& n, bool negative);

} // namespace detail

/// An exact decimal (or hexadecimal) number, kept as the text of its literal.
struct decimal {
    char const* text = "0"; ///< static storage, unsigned
    std::size_t size = 1;
    bool negative = false;

    constexpr std::string_view view() const noexcept { return {text, size}; }
    constexpr decimal operator-() const noexcept { return {text, size, !negative}; }
    constexpr decimal operator+() const noexcept { return *this; }
};

namespace detail {
template <>
inline constexpr bool is_exact<decimal> = true;

template <char... C>
inline constexpr std::array<char, sizeof...(C) + 1> literal_text{C..., '\0'};
} // namespace detail

inline namespace literals {
/// `0.1_dec`: exactly one tenth. Integers, decimals and hexadecimal floats as C++ writes them.
template <char... C>
constexpr decimal operator""_dec() noexcept {
    constexpr std::string_view text{detail::literal_text<C...>.data(), sizeof...(C)};
    static_assert(detail::scan_number(text).valid, "not a decimal or hexadecimal number");
    return {text.data(), text.size(), false};
}
} // namespace literals

/// The tightest interval that contains d. A number beyond the range of double gives a half-line.
SIVID_DECL interval enclose(decimal d);

/// The double nearest to d, ties to even; not an enclosure.
SIVID_DECL double nearest(decimal d);

/// The tightest interval that contains the number written in `text`; nothing if it is malformed
/// (the whole text must be one number) or beyond the range of double.
/// @cost  bounded by the length of the text plus about 20 us; 30 ns up to 15 digits
SIVID_DECL std::optional<interval> parse_decimal(std::string_view text);

/// The double nearest to the number written in `text`; nothing if malformed or beyond the range.
SIVID_DECL std::optional<double> parse_nearest(std::string_view text);

/// Anything with an exact meaning: a decimal, a whole number, an interval.
template <class T>
concept exact_number = exact_operand<T> || std::same_as<T, interval>;

/// The least interval that contains both, for instance hull(0.10_dec, 0.12_dec) or hull(0.1_dec,
/// 3).
template <exact_number A, exact_number B>
    requires(!(std::same_as<A, interval> && std::same_as<B, interval>))
interval hull(A const& a, B const& b) { return hull(detail::exactly(a), detail::exactly(b)); }

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/number/impl/decimal.ipp>
#endif

#endif
