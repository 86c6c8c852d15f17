// SPDX-License-Identifier: MIT
#ifndef SIVID_TESTS_SUPPORT_PACK_FUNCTIONS_HPP
#define SIVID_TESTS_SUPPORT_PACK_FUNCTIONS_HPP

/// @file
/// Operators and functions of packs as in formulas, those that models are made of: the 1788 value
/// in every lane, a cut of the domain silent; with `mask& cut` as last argument the lanes that were
/// cut are set in it.

#include <sivid/number/pack.hpp>

#include <cstddef>
#include <cstdint>

namespace sivid {
inline namespace SIVID_PACK_TARGET {

/// One bit for each lane.
using cut_lanes = std::uint64_t;

/// The derived error bounds of the pack's own kernels, in units of 2^-53 relative to the value,
/// before the one directed rounding of each bound. A bound is therefore within ceil(2 error) + 2
/// floats of the value. Arguments of sin, cos, tan beyond 2^20 go through the vocabulary type.
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
// With a domain that may be cut.
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
SIVID_PACK_UNARY(sin, sin)
SIVID_PACK_UNARY(cos, cos)
SIVID_PACK_UNARY(atan, atan)
SIVID_PACK_UNARY(tanh, tanh)
SIVID_PACK_UNARY(sign, sign)
SIVID_PACK_BINARY(min, min)
SIVID_PACK_BINARY(max, max)
SIVID_PACK_BINARY(hull, hull)
SIVID_PACK_BINARY(intersect, intersect)
SIVID_PACK_CUT(sqrt)
SIVID_PACK_CUT(log)
SIVID_PACK_CUT(tan)
template <std::size_t W>
[[nodiscard]] pack<W> pown(pack<W> const& a, int n, cut_lanes& cut) noexcept {
    return pack_traits<W>::pown(a, n, cut);
}
template <std::size_t W>
[[nodiscard]] pack<W> pown(pack<W> const& a, int n) noexcept {
    cut_lanes cut = 0;
    return pack_traits<W>::pown(a, n, cut);
}

#undef SIVID_PACK_UNARY
#undef SIVID_PACK_BINARY
#undef SIVID_PACK_CUT

} // namespace SIVID_PACK_TARGET
} // namespace sivid

#endif
