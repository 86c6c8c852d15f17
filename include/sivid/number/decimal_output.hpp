// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_DECIMAL_OUTPUT_HPP
#define SIVID_NUMBER_DECIMAL_OUTPUT_HPP

/// @file
/// Numbers written outward: the text of a lower bound is never above the bound, that of an upper
/// bound never below, and both are the shortest decimals less than one float away.

#include <sivid/compiled.hpp>
#include <sivid/number/decimal.hpp>
#include <sivid/number/interval.hpp>
#include <sivid/number/rounding.hpp>

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace sivid {

namespace detail {

/// Decimal digits d1 d2 ... dn of 0.d1d2...dn 10^point.
struct digit_string {
    std::string digits;
    int point = 0;
};

/// All digits of a finite x > 0: at most 767 are significant.
SIVID_DECL digit_string exact_digits(double x);

/// Plain notation while it is not longer than about 21 characters, else d.ddde±x.
SIVID_DECL std::string layout(digit_string d);

/// The first `count` digits, the rest cut off or carried up.
SIVID_DECL digit_string shortened(digit_string const& all, std::size_t count, bool up);

/// The shortest decimal on one side of a finite x > 0, less than one float away from it.
SIVID_DECL std::string shortest_magnitude(double x, bool up);

SIVID_DECL std::string in_brackets(std::string const& lo, std::string const& hi);

/// `digits` significant digits, or as many as the shortest text needs if that is 0.
SIVID_DECL std::string to_decimal(double x, bool up, int digits = 0);

} // namespace detail

/// The shortest decimal t <= x with no double in [t, x) (none strictly between either): 0.1 gives
/// "0.1" (the double is a little above). Infinities are "inf", "-inf".
SIVID_DECL std::string to_decimal_lower(double x);

/// The shortest decimal t >= x with no double in (x, t].
SIVID_DECL std::string to_decimal_upper(double x);

/// The greatest decimal <= x of at most `digits` significant digits, without trailing zeros.
SIVID_DECL std::string to_decimal_lower(double x, int digits);

/// The least decimal >= x of at most `digits` significant digits, without trailing zeros.
SIVID_DECL std::string to_decimal_upper(double x, int digits);

/// "[lo, hi]" with bounds rounded outward, or "[empty]".
SIVID_DECL std::string to_string(interval const& x);

/// The same with at most `digits` significant digits in each bound, rounded outward.
SIVID_DECL std::string to_string(interval const& x, int digits);

/// Exact hexadecimal text, for instance "-0x1.8p+1"; "inf", "-inf", "nan".
SIVID_DECL std::string to_hex(double x);

/// The double of which `text` is the exact hexadecimal text; nothing if it is malformed or no
/// double has that value. Accepts "inf", "-inf" and "nan".
SIVID_DECL std::optional<double> from_hex(std::string_view text);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/number/impl/decimal_output.ipp>
#endif

#endif
