// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_TEXT_DETAIL_ROUNDED_DECIMAL_HPP
#define SIVID_REPORT_TEXT_DETAIL_ROUNDED_DECIMAL_HPP

#include <sivid/compiled.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <string_view>

/// Directed rounding of a double to a multiple of a power of ten, on its exact decimal expansion,
/// digit by digit: independent of the rounding mode.
namespace sivid::report {

enum class rounding { down, nearest, up };

/// sign * digits * 10^exponent with an integer `digits`: a decimal number, exact.
struct scaled_decimal {
    bool negative = false;
    std::string digits = "0";
    int exponent = 0;
};

namespace detail {

inline constexpr std::string_view minus_sign = "\xE2\x88\x92";

/// Position of the leading digit: |x| = d.ddd * 10^result (0 for zero).
SIVID_DECL int leading_exponent(double x);

SIVID_DECL std::string superscript(int value);

} // namespace detail

/// " x 10^e" in typographic form.
[[nodiscard]] SIVID_DECL std::string power_text(int exponent);

/// Rounds a finite double to a multiple of 10^quantum in the given direction.
/// @guarantee  down: result <= x, up: result >= x, as real numbers; the error is below 10^quantum.
[[nodiscard]] SIVID_DECL scaled_decimal round_decimal(double x, int quantum, rounding way);

/// Writes a scaled decimal without an exponent, e.g. "-0.0120".
[[nodiscard]] SIVID_DECL std::string plain_text(scaled_decimal const& d);

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/text/impl/rounded_decimal.ipp>
#endif

#endif
