// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_DECIMAL_HPP
#define SIVID_NUMBER_DECIMAL_HPP

/// @file
/// Decimals read and written without losing what they mean: `0.1_dec` is one tenth, not the double
/// nearest to it. Reading gives the tightest enclosure, writing rounds outward.

#include <sivid/compiled.hpp>
#include <sivid/number/decimal_text.hpp>
#include <sivid/number/interval.hpp>
#include <sivid/number/rounding.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace sivid {

namespace detail {

/// Tightest enclosure of a valid text; an upper (lower) bound beyond the range is infinite.
SIVID_ENTRY interval enclose_text(std::string_view text, number_text const& n, bool negative);

/// The nearest double, ties to even; infinite beyond the range.
SIVID_ENTRY double nearest_text(std::string_view text, number_text const& n, bool negative);

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
template <char... C>
inline constexpr std::array<char, sizeof...(C) + 1> literal_text{C..., '\0'};
}

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
SIVID_ENTRY interval enclose(decimal d);

/// The double nearest to d, ties to even; not an enclosure.
SIVID_ENTRY double nearest(decimal d);

/// The tightest interval that contains the number written in `text`; nothing if it is malformed
/// (the whole text must be one number) or beyond the range of double.
/// @cost  bounded by the length of the text plus about 20 us; 30 ns up to 15 digits
SIVID_ENTRY std::optional<interval> parse_decimal(std::string_view text);

/// The double nearest to the number written in `text`; nothing if malformed or beyond the range.
SIVID_ENTRY std::optional<double> parse_nearest(std::string_view text);

/// Anything with an exact meaning: a decimal, a whole number, an interval.
template <class T>
concept exact_number = std::same_as<T, decimal> || std::integral<T> || std::same_as<T, interval>;

namespace detail {
inline interval exactly(decimal d) { return enclose(d); }
inline interval exactly(interval const& x) { return x; }
template <std::integral N>
interval exactly(N n) {
    return interval{n, n};
}
} // namespace detail

/// The least interval that contains both, for instance hull(0.10_dec, 0.12_dec) or hull(0.1_dec,
/// 3).
template <exact_number A, exact_number B>
    requires(!(std::same_as<A, interval> && std::same_as<B, interval>))
interval hull(A const& a, B const& b) { return hull(detail::exactly(a), detail::exactly(b)); }

// Decimals beside intervals.
template <std::same_as<interval> I>
I operator+(I const& x, decimal d) {
    return x + enclose(d);
}
template <std::same_as<interval> I>
I operator+(decimal d, I const& x) {
    return enclose(d) + x;
}
template <std::same_as<interval> I>
I operator-(I const& x, decimal d) {
    return x - enclose(d);
}
template <std::same_as<interval> I>
I operator-(decimal d, I const& x) {
    return enclose(d) - x;
}
template <std::same_as<interval> I>
I operator*(I const& x, decimal d) {
    return x * enclose(d);
}
template <std::same_as<interval> I>
I operator*(decimal d, I const& x) {
    return enclose(d) * x;
}
template <std::same_as<interval> I>
I operator/(I const& x, decimal d) {
    return x / enclose(d);
}
template <std::same_as<interval> I>
I operator/(decimal d, I const& x) {
    return enclose(d) / x;
}

#if !defined(SIVID_COMPILED) || defined(SIVID_COMPILE_DECIMAL)
namespace detail {

/// The fast way: at most 15 digits and a power of ten that is a double make two exact operands of
/// one product or quotient. Returns false if the text needs the slow way.
inline bool short_decimal(std::string_view text, number_text const& n, double& digits, int& power) {
    if (n.hexadecimal || n.digit_count > 15) return false;
    std::int64_t const exponent = n.point - static_cast<std::int64_t>(n.digit_count);
    if (exponent < -22 || exponent > 22) return false;
    std::int64_t value = 0;
    std::size_t seen = 0;
    for (std::size_t i = n.first; seen < n.digit_count; ++i) {
        int const d = digit_value(text[i], false);
        if (d < 0) continue;
        value = value * 10 + d;
        ++seen;
    }
    digits = static_cast<double>(value);
    power = static_cast<int>(exponent);
    return true;
}

inline constexpr std::array<double, 23> powers_of_ten{
    1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
    1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

SIVID_ENTRY interval enclose_text(std::string_view text, number_text const& n, bool negative) {
    double digits = 0.0, lo, hi;
    int power = 0;
    if (short_decimal(text, n, digits, power)) {
        double const ten = powers_of_ten[static_cast<std::size_t>(power < 0 ? -power : power)];
        lo = power < 0 ? div_down(digits, ten) : mul_down(digits, ten);
        hi = power < 0 ? div_up(digits, ten) : mul_up(digits, ten);
    } else {
        rounded_magnitude const r = round_text(text, n);
        lo = r.below;
        hi = r.exact ? lo : next_up(lo);
    }
    return negative ? unchecked_interval(-hi, -lo) : unchecked_interval(lo, hi);
}

SIVID_ENTRY double nearest_text(std::string_view text, number_text const& n, bool negative) {
    rounded_magnitude const r = round_text(text, n);
    bool const odd = (bits(r.below) & 1) != 0;
    bool const up = !r.exact && (r.half > 0 || (r.half == 0 && odd));
    double const y = up ? next_up(r.below) : r.below;
    return negative ? -y : y;
}

} // namespace detail

SIVID_ENTRY interval enclose(decimal d) {
    return detail::enclose_text(d.view(), detail::scan_number(d.view()), d.negative);
}

SIVID_ENTRY double nearest(decimal d) {
    return detail::nearest_text(d.view(), detail::scan_number(d.view()), d.negative);
}

SIVID_ENTRY std::optional<interval> parse_decimal(std::string_view text) {
    detail::number_text const n = detail::scan_number(text);
    if (!n.valid) return std::nullopt;
    interval const x = detail::enclose_text(text, n, n.negative);
    if (!is_bounded(x)) return std::nullopt;
    return x;
}

SIVID_ENTRY std::optional<double> parse_nearest(std::string_view text) {
    detail::number_text const n = detail::scan_number(text);
    if (!n.valid) return std::nullopt;
    double const x = detail::nearest_text(text, n, n.negative);
    if (detail::is_infinite(x)) return std::nullopt;
    return x;
}
#endif

} // namespace sivid

#endif
