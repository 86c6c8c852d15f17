// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_EXCESS_HPP
#define SIVID_NUMBER_EXCESS_HPP

/// @file
/// How far the results of the C library are trusted. These numbers are tested, not proven: they
/// leave at least one float of margin over the largest error seen against MPFR with glibc 2.36 on
/// x86-64 (docs/numbers.md). The proven alternative is number/mp_interval.hpp.

#include <cmath> // defines __GLIBC__ where it applies

#if !defined(__GLIBC__)
#error "sivid: the error bounds of the elementary functions were tested with glibc only"
#endif

namespace sivid {

/// Floats by which a result of the C library, called in round-to-nearest, is moved outward on each
/// side. The width of the enclosure at a point is at most twice that, in units of the last place of
/// the float below it.
namespace excess {
inline constexpr int exp = 2, expm1 = 2, log = 2, log1p = 2, pow = 2;
inline constexpr int sin = 2, cos = 2, tan = 2, asin = 2, acos = 2, atan = 2, atan2 = 4;
inline constexpr int sinh = 4, cosh = 4, tanh = 4, asinh = 4, acosh = 4, atanh = 4, cbrt = 6;
} // namespace excess

} // namespace sivid

#endif
