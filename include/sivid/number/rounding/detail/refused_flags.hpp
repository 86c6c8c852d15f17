// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_ROUNDING_DETAIL_REFUSED_FLAGS_HPP
#define SIVID_NUMBER_ROUNDING_DETAIL_REFUSED_FLAGS_HPP

/// @file
/// Refuses builds in which interval arithmetic would not prove anything.

#include <cfloat>
#include <limits>
#include <stdexcept>

#if defined(__FAST_MATH__)
#error "sivid: -ffast-math breaks every inclusion; compile without it"
#endif
#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ != 0
#error "sivid: -ffinite-math-only removes infinities and the empty interval; compile without it"
#endif
#if defined(__ASSOCIATIVE_MATH__)
#error "sivid: -fassociative-math breaks exact residuals; compile without it"
#endif
#if defined(__RECIPROCAL_MATH__)
#error "sivid: -freciprocal-math replaces divisions; compile without it"
#endif
#if defined(__NO_SIGNED_ZEROS__)
#error "sivid: -fno-signed-zeros is part of fast-math; compile without it"
#endif
#if defined(_M_FP_FAST)
#error "sivid: /fp:fast breaks every inclusion; compile without it"
#endif
#if (defined(__x86_64__) || defined(__i386__)) && !defined(__SSE2_MATH__)
#error "sivid: x87 arithmetic rounds twice; compile with -mfpmath=sse"
#endif
#if defined(__MINGW32__) && defined(__AVX__) && !defined(__clang__)
#error "sivid: g++ for Windows misaligns vectors of AVX (GCC bug 54412); compile for SSE2"
#endif
#if !defined(FLT_EVAL_METHOD) || FLT_EVAL_METHOD != 0
#error "sivid: doubles must be evaluated as doubles (FLT_EVAL_METHOD == 0)"
#endif

namespace sivid {

static_assert(std::numeric_limits<double>::is_iec559 && std::numeric_limits<double>::digits == 53);
static_assert(sizeof(double) == 8 && sizeof(void*) == 8, "sivid: a 64-bit machine is needed");

/// The machine's floating-point state, or the way this file was compiled, makes proofs impossible.
class unsound_environment : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

} // namespace sivid

#endif
