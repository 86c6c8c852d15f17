// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_PACK_FUNCTIONS_HPP
#define SIVID_NUMBER_PACK_FUNCTIONS_HPP

/// @file
/// Operators and functions of packs as in formulas: the 1788 value in every lane, a cut of the
/// domain silent; with `mask& cut` as last argument the lanes that were cut are set in it.

#include <sivid/number/pack.hpp>
#include <sivid/number/pack_traits.hpp>

#include <cstddef>
#include <cstdint>

namespace sivid {
inline namespace SIVID_PACK_TARGET {

/// One bit for each lane.
using cut_lanes = std::uint64_t;

/// The derived error bounds of the pack's own kernels, in units of 2^-53 relative to the value,
/// before the one directed rounding of each bound. A bound is therefore within ceil(2 error) + 2
/// floats of the value. Arguments of sin, cos, tan beyond 2^20, pow, atan2 and the inverse
/// hyperbolic functions have the vocabulary type's `excess`.
namespace pack_error = simd::kernel_error;

#define SIVID_PACK_UNARY(name, of)                                                                 \
    template <std::size_t W>                                                                       \
    [[nodiscard]] pack<W> name(pack<W> const& a) noexcept {                                        \
        return pack_traits<W>::of(a);                                                              \
    }
#define SIVID_PACK_BINARY(name, of)                                                                \
    template <std::size_t W>                                                                       \
    [[nodiscard]] pack<W> name(pack<W> const& a, pack<W> const& b) noexcept {                      \
        return pack_traits<W>::of(a, b);                                                           \
    }
// With a domain that may be cut, without and with a second argument.
#define SIVID_PACK_CUT(name)                                                                       \
    template <std::size_t W>                                                                       \
    [[nodiscard]] pack<W> name(pack<W> const& a, cut_lanes& cut) noexcept {                        \
        return pack_traits<W>::name(a, cut);                                                       \
    }                                                                                              \
    template <std::size_t W>                                                                       \
    [[nodiscard]] pack<W> name(pack<W> const& a) noexcept {                                        \
        cut_lanes cut = 0;                                                                         \
        return pack_traits<W>::name(a, cut);                                                       \
    }
#define SIVID_PACK_CUT_BINARY(name, second)                                                        \
    template <std::size_t W>                                                                       \
    [[nodiscard]] pack<W> name(pack<W> const& a, second b, cut_lanes& cut) noexcept {              \
        return pack_traits<W>::name(a, b, cut);                                                    \
    }                                                                                              \
    template <std::size_t W>                                                                       \
    [[nodiscard]] pack<W> name(pack<W> const& a, second b) noexcept {                              \
        cut_lanes cut = 0;                                                                         \
        return pack_traits<W>::name(a, b, cut);                                                    \
    }

SIVID_PACK_UNARY(operator-, neg)
SIVID_PACK_BINARY(operator+, add)
SIVID_PACK_BINARY(operator-, sub)
SIVID_PACK_BINARY(operator*, mul)
template <std::size_t W>
[[nodiscard]] pack<W> operator/(pack<W> const& a, pack<W> const& b) noexcept {
    cut_lanes cut = 0;
    return pack_traits<W>::div(a, b, cut);
}
template <std::size_t W>
pack<W>& operator+=(pack<W>& a, pack<W> const& b) noexcept {
    return a = a + b;
}
template <std::size_t W>
pack<W>& operator-=(pack<W>& a, pack<W> const& b) noexcept {
    return a = a - b;
}
template <std::size_t W>
pack<W>& operator*=(pack<W>& a, pack<W> const& b) noexcept {
    return a = a * b;
}
template <std::size_t W>
pack<W>& operator/=(pack<W>& a, pack<W> const& b) noexcept {
    return a = a / b;
}

SIVID_PACK_UNARY(sqr, sqr)
SIVID_PACK_UNARY(abs, abs)
SIVID_PACK_UNARY(exp, exp)
SIVID_PACK_UNARY(expm1, expm1)
SIVID_PACK_UNARY(sin, sin)
SIVID_PACK_UNARY(cos, cos)
SIVID_PACK_UNARY(atan, atan)
SIVID_PACK_UNARY(sinh, sinh)
SIVID_PACK_UNARY(cosh, cosh)
SIVID_PACK_UNARY(tanh, tanh)
SIVID_PACK_UNARY(asinh, asinh)
SIVID_PACK_UNARY(sign, sign)
SIVID_PACK_BINARY(min, min)
SIVID_PACK_BINARY(max, max)
SIVID_PACK_BINARY(hull, hull)
SIVID_PACK_BINARY(intersect, intersect)
SIVID_PACK_BINARY(hypot, hypot)
SIVID_PACK_BINARY(deadband, deadband)
template <std::size_t W>
[[nodiscard]] pack<W> saturate(pack<W> const& a, pack<W> const& lo, pack<W> const& hi) noexcept {
    return pack_traits<W>::saturate(a, lo, hi);
}
SIVID_PACK_CUT(sqrt)
SIVID_PACK_CUT(log)
SIVID_PACK_CUT(log1p)
SIVID_PACK_CUT(tan)
SIVID_PACK_CUT(asin)
SIVID_PACK_CUT(acos)
SIVID_PACK_CUT(acosh)
SIVID_PACK_CUT(atanh)
SIVID_PACK_CUT_BINARY(pow, pack<W> const&)
SIVID_PACK_CUT_BINARY(atan2, pack<W> const&)
SIVID_PACK_CUT_BINARY(pown, int)

#undef SIVID_PACK_UNARY
#undef SIVID_PACK_BINARY
#undef SIVID_PACK_CUT
#undef SIVID_PACK_CUT_BINARY

} // namespace SIVID_PACK_TARGET
} // namespace sivid

#endif
