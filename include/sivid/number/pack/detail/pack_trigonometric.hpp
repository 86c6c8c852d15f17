// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_PACK_DETAIL_PACK_TRIGONOMETRIC_HPP
#define SIVID_NUMBER_PACK_DETAIL_PACK_TRIGONOMETRIC_HPP

/// @file
/// Kernels of sin, cos, tan on |x| <= `trigonometric_limit` (docs/pack_functions.md, section 6).

#include <sivid/number/pack/detail/pack_exponential.hpp>

#include <array>
#include <cstddef>

namespace sivid::simd {
inline namespace SIVID_PACK_TARGET {

namespace kernel_error {
inline constexpr double sin_cos = 0.8, tan = 1.5;
}

inline constexpr double trigonometric_limit = 0x1p20;

/// pi/2 = p1 + p2 + p3 + p4 + 2^-159.8...; the first three have 33 bits, so that k p1, k p2, k p3
/// are exact for |k| <= 2^20 (here |k| < 2^19.4).
inline constexpr double two_over_pi = 0x1.45f306dc9c883p-1;
inline constexpr std::array<double, 4> half_pi_parts{0x1.921fb54400000p+0, 0x1.0b4611a600000p-34,
                                                     0x1.3198a2e000000p-69, 0x1.b839a252049c1p-104};

/// x = k pi/2 + r + rest; turns = k + 1.5 2^52, with k in its low bits. |r| < 0.7854, relative
/// error below 2^-68; |rest| is at most an ulp of r and 2^-83.
template <class V>
struct turn_argument {
    V turns, r, rest;
};
/// Every product with k is exact but the last; a, and the pairs (b, b_tail) and (c, c_tail), are
/// exact.
template <class V>
[[nodiscard]] turn_argument<V> reduce_turns(V x) noexcept {
    V const turns = fma(x, V(two_over_pi), V(0x1.8p52));
    V const k = turns - V(0x1.8p52);
    V const a = fma(k, V(-half_pi_parts[0]), x);
    V const b = fma(k, V(-half_pi_parts[1]), a);
    V const b_tail = fma(k, V(-half_pi_parts[1]), a - b);
    V const c = fma(k, V(-half_pi_parts[2]), b);
    V const c_tail = fma(k, V(-half_pi_parts[2]), b - c);
    return {turns, c, fma(k, V(-half_pi_parts[3]), b_tail + c_tail)};
}

/// floor(x / (pi/2)) + 1.5 2^52. r is never zero for x != 0, and has the sign of the exact rest.
template <class V>
[[nodiscard, gnu::always_inline]] inline V quadrant(turn_argument<V> const& a) noexcept {
    return select(a.r < V(0.0), a.turns - V(1.0), a.turns);
}

/// For quadrant = j + 1.5 2^52: floor((j + more)/2) + 1.5 2^52, more in {1, 2}. Half an integer
/// less a quarter is never a tie.
template <class V>
[[nodiscard]] V half_turn(V quadrant, double more) noexcept {
    V const j = quadrant - V(0x1.8p52);
    return fma(j, V(0.5), V(0.5 * more - 0.25)) + V(0x1.8p52);
}

template <class V>
struct sine_pair {
    expansion<V> sin, cos;
};
/// sin and cos of r + rest.
template <class V>
[[nodiscard]] sine_pair<V> sine_kernel(turn_argument<V> const& a) noexcept {
    static constexpr auto signs = [](auto c) { // alternate
        for (std::size_t i = 0; i < c.size(); i += 2) c[i] = -c[i];
        return c;
    };
    static constexpr auto odd = signs(reciprocal_factorials<8>(3, 2));  // -1/3!, 1/5!, ...
    static constexpr auto even = signs(reciprocal_factorials<9>(2, 2)); // -1/2!, 1/4!, ...
    static constexpr auto from_fourth = [] {
        std::array<double, 8> c{};
        for (std::size_t i = 0; i < 8; ++i) c[i] = even[i + 1];
        return c;
    }();
    V const r = a.r, rest = a.rest, z = r * r, minus_half_z = z * V(-0.5);
    V const sin_tail = fma(r * z, horner(z, odd), fma(minus_half_z, rest, rest));
    exact_pair<V> const c = fast_two_sum(V(1.0), minus_half_z);
    V const cos_tail = fma(z * z, horner(z, from_fourth), c.tail - r * rest);
    return {{r, sin_tail}, {c.head, cos_tail}};
}

/// Bounds of sin(x + shift pi/2), shift 0 or 1, for the reduced x.
template <class V>
[[nodiscard, gnu::always_inline]] inline bounds<V> wave_bounds(turn_argument<V> const& a,
                                                               double shift) noexcept {
    using d = directed<V>;
    sine_pair<V> const y = sine_kernel(a);
    V const turns = a.turns + V(shift);
    auto const use_cos = bit_is_set<0>(turns), negative = bit_is_set<1>(turns);
    V const head = negate_where(negative, select(use_cos, y.cos.head, y.sin.head));
    V const tail = negate_where(negative, select(use_cos, y.cos.tail, y.sin.tail));
    V const margin = fma(V(kernel_error::sin_cos * unit_roundoff), abs(head), V(least_double));
    return {d::add_down(head, tail - margin), d::add_up(head, tail + margin)};
}

/// The same and the monotone piece of x: the sine rises on piece p, from (p - 1/2) pi to (p + 1/2)
/// pi, for even p, and falls for odd p. piece = p + 1.5 2^52.
template <class V>
struct wave_end {
    V lo, hi, piece;
};
template <class V>
[[nodiscard]] wave_end<V> wave_kernel(V x, double shift) noexcept {
    turn_argument<V> const a = reduce_turns(x);
    bounds<V> const y = wave_bounds(a, shift);
    return {y.lo, y.hi, half_turn(quadrant(a), 1.0 + shift)};
}

/// The range of sin(t + shift pi/2) over [lo, hi], both ends within the limit.
template <class V>
[[nodiscard]] bounds<V> wave(V lo, V hi, double shift) noexcept {
    wave_end<V> const a = wave_kernel(lo, shift), b = wave_kernel(hi, shift);
    V const one(1.0), extrema = b.piece - a.piece;
    auto const falling = bit_is_set<0>(a.piece);
    auto const many = extrema > one, any = extrema > V(0.0);
    auto const has_maximum = many | (any & !falling), has_minimum = many | (any & falling);
    return {select(has_minimum, -one, max(-one, min(a.lo, b.lo))),
            select(has_maximum, one, min(one, max(a.hi, b.hi)))};
}

template <class V>
[[nodiscard]] bounds<V> sin_within_limit(V lo, V hi) noexcept {
    bounds<V> const y = wave(lo, hi, 0.0);
    // t <= sin t for t in [-inf, 0], and sin t >= 0 on [0, 3]; likewise above.
    return {select((lo <= V(0.0)) & (hi <= V(3.0)), max(lo, y.lo), y.lo),
            select((hi >= V(0.0)) & (lo >= V(-3.0)), min(hi, y.hi), y.hi)};
}
template <class V>
[[nodiscard]] bounds<V> cos_within_limit(V lo, V hi) noexcept {
    bounds<V> const y = wave(lo, hi, 1.0);
    auto const zero = (lo == V(0.0)) & (hi == V(0.0));
    return {select(zero, V(1.0), y.lo), y.hi};
}

template <class V>
[[nodiscard]] expansion<V> tan_kernel(turn_argument<V> const& a) noexcept {
    sine_pair<V> const y = sine_kernel(a);
    V const turns = a.turns;
    auto const odd = bit_is_set<0>(turns); // -cos/sin
    expansion<V> const n{select(odd, -y.cos.head, y.sin.head),
                         select(odd, -y.cos.tail, y.sin.tail)};
    expansion<V> const d{select(odd, y.sin.head, y.cos.head), select(odd, y.sin.tail, y.cos.tail)};
    return quotient(normalized(n), normalized(d));
}

/// Rising between poles; everything if a pole lies between the ends. No other result has an
/// infinite bound.
template <class V>
[[nodiscard]] bounds<V> tan_within_limit(V lo, V hi) noexcept {
    constexpr double delta = kernel_error::tan * unit_roundoff;
    turn_argument<V> const a = reduce_turns(lo), b = reduce_turns(hi);
    auto const pole = half_turn(quadrant(a), 1.0) < half_turn(quadrant(b), 1.0);
    V const from = lower_bound_of_any(tan_kernel(a), delta);
    V const to = upper_bound_of_any(tan_kernel(b), delta);
    return {select(pole, V(-infinity), from), select(pole, V(infinity), to)};
}

} // namespace SIVID_PACK_TARGET
} // namespace sivid::simd

#endif
