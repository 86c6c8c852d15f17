// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_DECIMAL_HPP
#define SIVID_NUMBER_DECIMAL_HPP

/// @file
/// Decimals read and written without losing what they mean: `0.1_dec` is one tenth, not the double
/// nearest to it. Reading gives the tightest enclosure, writing rounds outward.

#include <sivid/compiled.hpp>
#include <sivid/number/interval.hpp>
#include <sivid/number/rounding.hpp>
#include <sivid/number/text/detail/decimal_text.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

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
