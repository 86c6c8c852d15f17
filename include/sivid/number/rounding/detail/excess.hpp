// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_ROUNDING_DETAIL_EXCESS_HPP
#define SIVID_NUMBER_ROUNDING_DETAIL_EXCESS_HPP

/// @file
/// How much wider than necessary the elementary functions of `interval` are.

#include <sivid/number/rounding/detail/machine.hpp>

namespace sivid {

/// Floats by which a bound may lie beyond the value.
///
/// With glibc: those by which a result of the C library, called in round-to-nearest, is moved
/// outward. They are tested, not proven: at least one float of margin is left over the largest
/// error seen against MPFR with glibc 2.36 on x86-64 (docs/numbers.md). The width of the enclosure
/// at a point is at most twice that, in units of the last place of the float below it. The proven
/// alternatives are `SIVID_OWN_FUNCTIONS` and number/mp_functions.hpp.
///
/// With any other C library, and where `SIVID_OWN_FUNCTIONS` is defined: nothing is trusted, the
/// bounds are proved (detail/own_functions.hpp), and these numbers are what was seen at most.
namespace excess {
#if SIVID_TRUSTS_LIBRARY
inline constexpr int exp = 2, expm1 = 2, log = 2, log1p = 2, pow = 2;
inline constexpr int sin = 2, cos = 2, tan = 2, asin = 2, acos = 2, atan = 2, atan2 = 4;
inline constexpr int sinh = 4, cosh = 4, tanh = 4, asinh = 4, acosh = 4, atanh = 4, cbrt = 6;
#else
inline constexpr int exp = 3, expm1 = 8, log = 4, log1p = 4, pow = 3;
inline constexpr int sin = 3, cos = 3, tan = 4, asin = 3, acos = 3, atan = 3, atan2 = 6;
inline constexpr int sinh = 5, cosh = 3, tanh = 5, asinh = 8, acosh = 8, atanh = 8;
#endif
} // namespace excess

} // namespace sivid

#endif
