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

template <std::size_t W>
[[nodiscard]] pack<W> operator-(pack<W> const& a) noexcept {
    return pack_traits<W>::neg(a);
}
template <std::size_t W>
[[nodiscard]] pack<W> operator+(pack<W> const& a, pack<W> const& b) noexcept {
    return pack_traits<W>::add(a, b);
}
template <std::size_t W>
[[nodiscard]] pack<W> operator-(pack<W> const& a, pack<W> const& b) noexcept {
    return pack_traits<W>::sub(a, b);
}
template <std::size_t W>
[[nodiscard]] pack<W> operator*(pack<W> const& a, pack<W> const& b) noexcept {
    return pack_traits<W>::mul(a, b);
}
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

template <std::size_t W>
[[nodiscard]] pack<W> sqr(pack<W> const& a) noexcept {
    return pack_traits<W>::sqr(a);
}
template <std::size_t W>
[[nodiscard]] pack<W> abs(pack<W> const& a) noexcept {
    return pack_traits<W>::abs(a);
}
template <std::size_t W>
[[nodiscard]] pack<W> exp(pack<W> const& a) noexcept {
    return pack_traits<W>::exp(a);
}
template <std::size_t W>
[[nodiscard]] pack<W> expm1(pack<W> const& a) noexcept {
    return pack_traits<W>::expm1(a);
}
template <std::size_t W>
[[nodiscard]] pack<W> sin(pack<W> const& a) noexcept {
    return pack_traits<W>::sin(a);
}
template <std::size_t W>
[[nodiscard]] pack<W> cos(pack<W> const& a) noexcept {
    return pack_traits<W>::cos(a);
}
template <std::size_t W>
[[nodiscard]] pack<W> atan(pack<W> const& a) noexcept {
    return pack_traits<W>::atan(a);
}
template <std::size_t W>
[[nodiscard]] pack<W> sinh(pack<W> const& a) noexcept {
    return pack_traits<W>::sinh(a);
}
template <std::size_t W>
[[nodiscard]] pack<W> cosh(pack<W> const& a) noexcept {
    return pack_traits<W>::cosh(a);
}
template <std::size_t W>
[[nodiscard]] pack<W> tanh(pack<W> const& a) noexcept {
    return pack_traits<W>::tanh(a);
}
template <std::size_t W>
[[nodiscard]] pack<W> asinh(pack<W> const& a) noexcept {
    return pack_traits<W>::asinh(a);
}
template <std::size_t W>
[[nodiscard]] pack<W> sign(pack<W> const& a) noexcept {
    return pack_traits<W>::sign(a);
}
template <std::size_t W>
[[nodiscard]] pack<W> min(pack<W> const& a, pack<W> const& b) noexcept {
    return pack_traits<W>::min(a, b);
}
template <std::size_t W>
[[nodiscard]] pack<W> max(pack<W> const& a, pack<W> const& b) noexcept {
    return pack_traits<W>::max(a, b);
}
template <std::size_t W>
[[nodiscard]] pack<W> hull(pack<W> const& a, pack<W> const& b) noexcept {
    return pack_traits<W>::hull(a, b);
}
template <std::size_t W>
[[nodiscard]] pack<W> intersect(pack<W> const& a, pack<W> const& b) noexcept {
    return pack_traits<W>::intersect(a, b);
}
template <std::size_t W>
[[nodiscard]] pack<W> hypot(pack<W> const& a, pack<W> const& b) noexcept {
    return pack_traits<W>::hypot(a, b);
}
template <std::size_t W>
[[nodiscard]] pack<W> deadband(pack<W> const& a, pack<W> const& b) noexcept {
    return pack_traits<W>::deadband(a, b);
}
template <std::size_t W>
[[nodiscard]] pack<W> saturate(pack<W> const& a, pack<W> const& lo, pack<W> const& hi) noexcept {
    return pack_traits<W>::saturate(a, lo, hi);
}
template <std::size_t W>
[[nodiscard]] pack<W> mul_add(pack<W> const& a, pack<W> const& b, pack<W> const& c) noexcept {
    return pack_traits<W>::mul_add(a, b, c);
}

// With a cut domain.
template <std::size_t W>
[[nodiscard]] pack<W> sqrt(pack<W> const& a, cut_lanes& cut) noexcept {
    return pack_traits<W>::sqrt(a, cut);
}
template <std::size_t W>
[[nodiscard]] pack<W> sqrt(pack<W> const& a) noexcept {
    cut_lanes cut = 0;
    return pack_traits<W>::sqrt(a, cut);
}
template <std::size_t W>
[[nodiscard]] pack<W> log(pack<W> const& a, cut_lanes& cut) noexcept {
    return pack_traits<W>::log(a, cut);
}
template <std::size_t W>
[[nodiscard]] pack<W> log(pack<W> const& a) noexcept {
    cut_lanes cut = 0;
    return pack_traits<W>::log(a, cut);
}
template <std::size_t W>
[[nodiscard]] pack<W> log1p(pack<W> const& a, cut_lanes& cut) noexcept {
    return pack_traits<W>::log1p(a, cut);
}
template <std::size_t W>
[[nodiscard]] pack<W> log1p(pack<W> const& a) noexcept {
    cut_lanes cut = 0;
    return pack_traits<W>::log1p(a, cut);
}
template <std::size_t W>
[[nodiscard]] pack<W> tan(pack<W> const& a, cut_lanes& cut) noexcept {
    return pack_traits<W>::tan(a, cut);
}
template <std::size_t W>
[[nodiscard]] pack<W> tan(pack<W> const& a) noexcept {
    cut_lanes cut = 0;
    return pack_traits<W>::tan(a, cut);
}
template <std::size_t W>
[[nodiscard]] pack<W> asin(pack<W> const& a, cut_lanes& cut) noexcept {
    return pack_traits<W>::asin(a, cut);
}
template <std::size_t W>
[[nodiscard]] pack<W> asin(pack<W> const& a) noexcept {
    cut_lanes cut = 0;
    return pack_traits<W>::asin(a, cut);
}
template <std::size_t W>
[[nodiscard]] pack<W> acos(pack<W> const& a, cut_lanes& cut) noexcept {
    return pack_traits<W>::acos(a, cut);
}
template <std::size_t W>
[[nodiscard]] pack<W> acos(pack<W> const& a) noexcept {
    cut_lanes cut = 0;
    return pack_traits<W>::acos(a, cut);
}
template <std::size_t W>
[[nodiscard]] pack<W> acosh(pack<W> const& a, cut_lanes& cut) noexcept {
    return pack_traits<W>::acosh(a, cut);
}
template <std::size_t W>
[[nodiscard]] pack<W> acosh(pack<W> const& a) noexcept {
    cut_lanes cut = 0;
    return pack_traits<W>::acosh(a, cut);
}
template <std::size_t W>
[[nodiscard]] pack<W> atanh(pack<W> const& a, cut_lanes& cut) noexcept {
    return pack_traits<W>::atanh(a, cut);
}
template <std::size_t W>
[[nodiscard]] pack<W> atanh(pack<W> const& a) noexcept {
    cut_lanes cut = 0;
    return pack_traits<W>::atanh(a, cut);
}
template <std::size_t W>
[[nodiscard]] pack<W> pow(pack<W> const& a, pack<W> const& b, cut_lanes& cut) noexcept {
    return pack_traits<W>::pow(a, b, cut);
}
template <std::size_t W>
[[nodiscard]] pack<W> pow(pack<W> const& a, pack<W> const& b) noexcept {
    cut_lanes cut = 0;
    return pack_traits<W>::pow(a, b, cut);
}
template <std::size_t W>
[[nodiscard]] pack<W> atan2(pack<W> const& a, pack<W> const& b, cut_lanes& cut) noexcept {
    return pack_traits<W>::atan2(a, b, cut);
}
template <std::size_t W>
[[nodiscard]] pack<W> atan2(pack<W> const& a, pack<W> const& b) noexcept {
    cut_lanes cut = 0;
    return pack_traits<W>::atan2(a, b, cut);
}
template <std::size_t W>
[[nodiscard]] pack<W> pown(pack<W> const& a, int n, cut_lanes& cut) noexcept {
    return pack_traits<W>::pown(a, n, cut);
}
template <std::size_t W>
[[nodiscard]] pack<W> pown(pack<W> const& a, int n) noexcept {
    cut_lanes cut = 0;
    return pack_traits<W>::pown(a, n, cut);
}

} // namespace SIVID_PACK_TARGET
} // namespace sivid

#endif
