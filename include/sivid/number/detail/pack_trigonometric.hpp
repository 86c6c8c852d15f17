// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_DETAIL_PACK_TRIGONOMETRIC_HPP
#define SIVID_NUMBER_DETAIL_PACK_TRIGONOMETRIC_HPP

/// @file
/// Kernels of sin, cos, tan on |x| <= `trigonometric_limit` (docs/pack_functions.md, section 6).

#include <sivid/number/detail/pack_exponential.hpp>

#include <array>
#include <cstddef>

namespace sivid::simd {
inline namespace SIVID_PACK_TARGET {

namespace kernel_error {
inline constexpr double sin_cos = 0.8, tan = 1.5;
}

inline constexpr double trigonometric_limit = 0x1p20;

/// pi/2 = p1 + p2 + p3 + p4 + 2^-159.8...; the first three have 33 bits, so that k p1, k p2, k p3 are
/// exact for |k| <= 2^20.
inline constexpr double two_over_pi = 0x1.45f306dc9c883p-1;
inline constexpr std::array<double, 4> half_pi_parts{0x1.921fb54400000p+0, 0x1.0b4611a600000p-34,
                                                     0x1.3198a2e000000p-69, 0x1.b839a252049c1p-104};

/// x = k pi/2 + r + rest, |r| < 0.7854, relative error below 2^-68.
template <class V>
struct turn_argument {
    V k, r, rest;
};
template <class V>
[[nodiscard]] turn_argument<V> reduce_turns(V x) noexcept {
    V const k = nearest_integer(x * V(two_over_pi));
    V const a = fma(-k, V(half_pi_parts[0]), x);  // exact
    exact_pair<V> const b = two_sum(a, -(k * V(half_pi_parts[1])));
    exact_pair<V> const c = two_sum(b.head, -(k * V(half_pi_parts[2])));
    V const low = (b.tail + c.tail) - k * V(half_pi_parts[3]);
    exact_pair<V> const r = fast_two_sum(c.head, low);
    return {k, r.head, r.tail};
}

/// floor(x / (pi/2)): the quadrant, counted on. r is never zero for x != 0, and has the sign of the
/// exact rest.
template <class V>
[[nodiscard]] V quadrant(turn_argument<V> a) noexcept {
    return select(a.r < V(0.0), a.k - V(1.0), a.k);
}

template <class V>
struct sine_pair {
    expansion<V> sin, cos;
};
/// sin and cos of r + rest.
template <class V>
[[nodiscard]] sine_pair<V> sine_kernel(turn_argument<V> a) noexcept {
    static constexpr auto signs = [](auto c) {  // alternate
        for (std::size_t i = 0; i < c.size(); i += 2) c[i] = -c[i];
        return c;
    };
    static constexpr auto odd = signs(reciprocal_factorials<8>(3, 2));    // -1/3!, 1/5!, ...
    static constexpr auto even = signs(reciprocal_factorials<9>(2, 2));   // -1/2!, 1/4!, ...
    static constexpr auto from_fourth = [] {
        std::array<double, 8> c{};
        for (std::size_t i = 0; i < 8; ++i) c[i] = even[i + 1];
        return c;
    }();
    V const r = a.r, z = r * r, half_z = z * V(0.5);
    V const sin_tail = fma(r * z, horner(z, odd), fma(-half_z, a.rest, a.rest));
    exact_pair<V> const c = fast_two_sum(V(1.0), -half_z);
    V const cos_tail = c.tail + fma(z * z, horner(z, from_fourth), -(r * a.rest));
    return {{r, sin_tail}, {c.head, cos_tail}};
}

/// Whether k is odd, and k mod 4 in {0, 1, 2, 3}.
template <class V>
[[nodiscard]] V modulo_four(V k) noexcept {
    return k - V(4.0) * floor_integer(k * V(0.25));
}

/// sin(x + shift pi/2) and the quadrant of its argument.
template <class V>
struct wave_value {
    expansion<V> value;
    V quadrant;
};
template <class V>
[[nodiscard]] wave_value<V> wave_kernel(V x, double shift) noexcept {
    turn_argument<V> const a = reduce_turns(x);
    sine_pair<V> const y = sine_kernel(a);
    V const q = modulo_four(a.k + V(shift));
    auto const use_cos = (q == V(1.0)) | (q == V(3.0));
    expansion<V> const e{select(use_cos, y.cos.head, y.sin.head),
                         select(use_cos, y.cos.tail, y.sin.tail)};
    return {with_sign(e, V(1.5) - q), quadrant(a) + V(shift)};
}

/// The range of sin(t + shift pi/2), shift an integer, both ends within the limit. The sine rises on
/// piece p, from (p - 1/2) pi to (p + 1/2) pi, for even p, and falls for odd p.
template <class V>
[[nodiscard]] bounds<V> wave(bounds<V> x, double shift) noexcept {
    constexpr double delta = kernel_error::sin_cos * unit_roundoff;
    wave_value<V> const a = wave_kernel(x.lo, shift), b = wave_kernel(x.hi, shift);
    V const half(0.5), one(1.0);
    V const lo = min(lower_bound_of_any(a.value, delta), lower_bound_of_any(b.value, delta));
    V const hi = max(upper_bound_of_any(a.value, delta), upper_bound_of_any(b.value, delta));
    V const first = floor_integer((a.quadrant + one) * half);
    V const last = floor_integer((b.quadrant + one) * half);
    V const extrema = last - first;
    auto const falling = first > V(2.0) * floor_integer(first * half);  // odd
    auto const many = extrema > V(1.5);
    auto const has_any = extrema > half;
    auto const has_maximum = many | (has_any & !falling);
    auto const has_minimum = many | (has_any & falling);
    return {select(has_minimum, -one, max(-one, lo)), select(has_maximum, one, min(one, hi))};
}

template <class V>
[[nodiscard]] bounds<V> sin_within_limit(bounds<V> x) noexcept {
    bounds<V> const y = wave(x, 0.0);
    // t <= sin t for t in [-inf, 0], and sin t >= 0 on [0, 3]; likewise above.
    return {select((x.lo <= V(0.0)) & (x.hi <= V(3.0)), max(x.lo, y.lo), y.lo),
            select((x.hi >= V(0.0)) & (x.lo >= V(-3.0)), min(x.hi, y.hi), y.hi)};
}
template <class V>
[[nodiscard]] bounds<V> cos_within_limit(bounds<V> x) noexcept {
    bounds<V> const y = wave(x, 1.0);
    auto const zero = (x.lo == V(0.0)) & (x.hi == V(0.0));
    return {select(zero, V(1.0), y.lo), y.hi};
}

template <class V>
[[nodiscard]] expansion<V> tan_kernel(turn_argument<V> a) noexcept {
    sine_pair<V> const y = sine_kernel(a);
    V const parity = a.k - V(2.0) * floor_integer(a.k * V(0.5));
    auto const odd = parity > V(0.5);  // -cos/sin
    expansion<V> const n{select(odd, -y.cos.head, y.sin.head), select(odd, -y.cos.tail, y.sin.tail)};
    expansion<V> const d{select(odd, y.sin.head, y.cos.head), select(odd, y.sin.tail, y.cos.tail)};
    return quotient(normalized(n), normalized(d));
}

/// Rising between poles; everything if a pole lies between the ends. No other result has an infinite
/// bound.
template <class V>
[[nodiscard]] bounds<V> tan_within_limit(bounds<V> x) noexcept {
    constexpr double delta = kernel_error::tan * unit_roundoff;
    turn_argument<V> const a = reduce_turns(x.lo), b = reduce_turns(x.hi);
    V const half(0.5), one(1.0);
    V const first = floor_integer((quadrant(a) + one) * half);
    V const last = floor_integer((quadrant(b) + one) * half);
    auto const pole = last > first;
    V const lo = lower_bound_of_any(tan_kernel(a), delta);
    V const hi = upper_bound_of_any(tan_kernel(b), delta);
    return {select(pole, V(-infinity), lo), select(pole, V(infinity), hi)};
}

}  // namespace SIVID_PACK_TARGET
}  // namespace sivid::simd

#endif
