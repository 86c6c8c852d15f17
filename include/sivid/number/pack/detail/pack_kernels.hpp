// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_PACK_DETAIL_PACK_KERNELS_HPP
#define SIVID_NUMBER_PACK_DETAIL_PACK_KERNELS_HPP

/// @file
/// Elementary functions at the ends of intervals, for packs and for `interval`. A kernel computes,
/// in round-to-nearest, an unevaluated sum head + tail with
///   \f$ |head + tail - f(x)| \le \delta\,|head| \f$
/// and the bounds are directed sums head + (tail -+ delta |head|): one rounding each. The constants
/// delta, in units of 2^-53, are derived in docs/theory/pack_functions.md, for fused and for
/// separate multiply-add, with the rounding of tail -+ delta |head| included. `f_bounds::at<D>(x)`
/// is the bound of f(x) on side D, with what is known of f.

#include <sivid/number/pack/detail/pack_arithmetic.hpp>

#include <array>
#include <cstddef>
#include <utility>

namespace sivid::simd {
inline namespace SIVID_PACK_TARGET {

/// Half an ulp of 1: the relative error of one operation.
inline constexpr double unit_roundoff = 0x1p-53;

template <class V>
struct expansion {
    V head, tail;
};

/// c[0] + c[1] x + c[2] x^2 + ... by Horner's rule.
template <class V, std::size_t N>
[[nodiscard]] V horner(V x, std::array<double, N> const& c) noexcept {
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
        V y(c[N - 1]);
        ((y = fma(y, x, V(c[N - 2 - I]))), ...);
        return y;
    }
    (std::make_index_sequence<N - 1>{});
}

/// The nearest integer (|v| < 2^51).
template <class V>
[[nodiscard]] V nearest_integer(V v) noexcept {
    return (v + V(0x1.8p52)) - V(0x1.8p52);
}

/// With the signs of head and tail turned where `sign` is negative.
template <class V>
[[nodiscard, gnu::always_inline]] inline expansion<V> with_sign(expansion<V> const& y,
                                                                V sign) noexcept {
    auto const negative = sign < V(0.0);
    return {negate_where(negative, y.head), negate_where(negative, y.tail)};
}

/// Which bounds a vector holds: lower ones, upper ones, or, where the ends of one interval lie side
/// by side, lower ones in even lanes and upper ones in odd lanes. A sum head + tail -+ margin has
/// one rounding; `scaled` is y 2^k; `of` takes what is said of lower and of upper bounds.
struct downward {
    template <class V>
    [[nodiscard, gnu::always_inline]] static V sum(V head, V tail, V margin) noexcept {
        return directed<V>::add_down(head, tail - margin);
    }
    template <class V>
    [[nodiscard, gnu::always_inline]] static V scaled(V y, V k) noexcept {
        return directed<V>::scale_down(y, k);
    }
    template <class V>
    [[nodiscard, gnu::always_inline]] static V of(V lower, V) noexcept {
        return lower;
    }
};
struct upward {
    template <class V>
    [[nodiscard, gnu::always_inline]] static V sum(V head, V tail, V margin) noexcept {
        return directed<V>::add_up(head, tail + margin);
    }
    template <class V>
    [[nodiscard, gnu::always_inline]] static V scaled(V y, V k) noexcept {
        return directed<V>::scale_up(y, k);
    }
    template <class V>
    [[nodiscard, gnu::always_inline]] static V of(V, V upper) noexcept {
        return upper;
    }
};
/// A lower bound of y is minus an upper bound of -y.
struct outward {
    template <class V>
    [[nodiscard, gnu::always_inline]] static V sum(V head, V tail, V margin) noexcept {
        return turned(directed<V>::add_up(turned(head), turned(tail) + margin));
    }
    template <class V>
    [[nodiscard, gnu::always_inline]] static V scaled(V y, V k) noexcept {
        return turned(directed<V>::scale_up(turned(y), k));
    }
    template <class V>
    [[nodiscard, gnu::always_inline]] static V of(V lower, V upper) noexcept {
        return select(V::even_lanes(), lower, upper);
    }

private:
    template <class V>
    [[nodiscard, gnu::always_inline]] static V turned(V y) noexcept {
        return negate_where(V::even_lanes(), y);
    }
};

/// The bound of head + tail on side D, for results that are zero or at least 2^-900.
template <class D, class V>
[[nodiscard, gnu::always_inline]] inline V bound(expansion<V> const& y, double delta) noexcept {
    return D::sum(y.head, y.tail, V(delta) * abs(y.head));
}

/// The margin for results of any size. Where delta |head| is below the least double, the tail is
/// zero and |f(x) - head| < 2^-1074; a head of zero is exact. (A fused operation with a subnormal
/// operand would take a hundred cycles more.)
template <class V>
[[nodiscard]] V margin(V head, double delta) noexcept {
    return select(head == V(0.0), V(0.0), V(delta) * abs(head) + V(least_double));
}
template <class D, class V>
[[nodiscard, gnu::always_inline]] inline V bound_of_any(expansion<V> const& y,
                                                        double delta) noexcept {
    return D::sum(y.head, y.tail, margin(y.head, delta));
}

/// y with the known bound |f(x)| >= |x|, or <= |x|, of a function with the sign of x.
template <class D, class V>
[[nodiscard]] V if_beyond(V x, V y) noexcept {
    return D::of(select(x >= V(0.0), max(x, y), y), select(x <= V(0.0), min(x, y), y));
}
template <class D, class V>
[[nodiscard]] V if_within(V x, V y) noexcept {
    return D::of(select(x <= V(0.0), max(x, y), y), select(x >= V(0.0), min(x, y), y));
}

/// The same sum with |tail| <= 2^-53 |head|, given |tail| <= |head|.
template <class V>
[[nodiscard, gnu::always_inline]] inline expansion<V> normalized(expansion<V> const& y) noexcept {
    exact_pair<V> const s = fast_two_sum(y.head, y.tail);
    return {s.head, s.tail};
}

/// The quotient of two expansions, given |d.tail| <= 2^-50 |d.head|. The absolute error is below
/// 2^-98 |n.head/d.head| + 2^-50 |n.tail/d.head|, apart from the relative errors of n and d.
template <class V>
[[nodiscard]] expansion<V> quotient(expansion<V> const& n, expansion<V> const& d) noexcept {
    V const a = n.head, b = d.head; // copies: see pack_arithmetic.hpp
    V const q = a / b;
    exact_pair<V> const p = two_product(q, b);
    V const rest = (a - p.head) - p.tail;
    return {q, (rest + (n.tail - q * d.tail)) / b};
}

// ---- exp, expm1, sinh, cosh, tanh (docs/theory/pack_functions.md, section 4)

/// Error bounds in units of 2^-53 of the head.
namespace kernel_error {
inline constexpr double exp = 1.0, expm1 = 5.25, sinh = 3.0, cosh = 1.0, tanh = 3.0;
}

/// 1/first!, 1/(first + step)!, ...; each correctly rounded, n! being a double up to n = 22.
template <std::size_t N>
[[nodiscard]] constexpr std::array<double, N> reciprocal_factorials(int first, int step) noexcept {
    std::array<double, N> c{};
    for (std::size_t i = 0; i < N; ++i) {
        double factorial = 1.0;
        for (int n = 2; n <= first + step * static_cast<int>(i); ++n) factorial *= n;
        c[i] = 1.0 / factorial;
    }
    return c;
}

inline constexpr double log2_e = 0x1.71547652b82fep+0;
/// ln 2 = high + low + 2^-102.0...; high is a multiple of 2^-41, so that k high is exact for |k| <
/// 2^12.
inline constexpr double ln2_high = 0x1.62e42fefa3000p-1, ln2_low = 0x1.3de6af278ece6p-42;

/// x = k ln 2 + r + rest, |r| <= 0.34658, for |x| <= 1100.
template <class V>
struct exp_argument {
    V k, r, rest;
};
template <class V>
[[nodiscard]] exp_argument<V> reduce_exp(V x) noexcept {
    V const k = nearest_integer(x * V(log2_e));
    V const head = fma(-k, V(ln2_high), x); // exact
    V const low = k * V(ln2_low);
    V const r = head - low;
    return {k, r, (head - r) - low};
}

/// e^r - 1 - r for the reduced argument.
template <class V>
[[nodiscard]] V exp_tail(V r, V rest) noexcept {
    static constexpr auto c = reciprocal_factorials<12>(2, 1);
    return fma(r * r, horner(r, c), fma(rest, r, rest));
}

template <class V>
[[nodiscard]] expansion<V> exp_kernel(V r, V rest) noexcept {
    exact_pair<V> const one_plus_r = fast_two_sum(V(1.0), r);
    return {one_plus_r.head, one_plus_r.tail + exp_tail(r, rest)};
}

struct exp_bounds {
    template <class D, class V>
    [[nodiscard]] static V at(V x) noexcept {
        auto const a = reduce_exp(min(V(710.0), max(V(-746.0), x)));
        V const y = bound<D>(exp_kernel(a.r, a.rest), kernel_error::exp * unit_roundoff);
        V const e = D::scaled(y, a.k), one(1.0), zero(0.0);
        return D::of(select(x >= zero, max(one, e), e), select(x <= zero, min(one, e), e));
    }
};

/// e^x - 1 = 2^k (head + tail).
template <class V>
[[nodiscard]] expansion<V> expm1_kernel(exp_argument<V> const& a) noexcept {
    V const k = a.k, r = a.r, rest = a.rest; // copies: see pack_arithmetic.hpp
    V const tail = exp_tail(r, rest);
    exact_pair<V> const one_plus_r = fast_two_sum(V(1.0), r);
    V const one = power_of_two(-min(V(1000.0), k)); // 2^-k; above k = 1000 without effect
    exact_pair<V> const d = two_sum(one_plus_r.head, -one);
    auto const small = k == V(0.0);
    return {select(small, r, d.head), select(small, tail, d.tail + (one_plus_r.tail + tail))};
}
struct expm1_bounds {
    template <class D, class V>
    [[nodiscard]] static V at(V x) noexcept {
        auto const a = reduce_exp(min(V(710.0), max(V(-42.0), x)));
        V const y = bound_of_any<D>(expm1_kernel(a), kernel_error::expm1 * unit_roundoff);
        V const e = D::scaled(y, a.k);
        return D::of(max(max(V(-1.0), x), e), e); // e^x - 1 >= x
    }
};

/// sinh x = 2^(k-1) sinh, cosh x = 2^(k-1) cosh, for x >= 0: e^r and e^-r from the even and the odd
/// part of one series; sinh from the odd part alone where k = 0.
template <class V>
struct hyperbolic_pair {
    V k;
    expansion<V> sinh, cosh;
};
template <class V>
[[nodiscard]] hyperbolic_pair<V> hyperbolic_kernel(V x) noexcept {
    static constexpr auto even = reciprocal_factorials<6>(4, 2);
    static constexpr auto odd = reciprocal_factorials<7>(3, 2);
    auto const a = reduce_exp(x);
    V const r = a.r, z = r * r;
    V const e = fma(z * z, horner(z, even), z * V(0.5)); // cosh r - 1
    V const o = (r * z) * horner(z, odd);                // sinh r - r
    exact_pair<V> const plus = fast_two_sum(V(1.0), r), minus = fast_two_sum(V(1.0), -r);
    V const plus_tail = plus.tail + ((e + o) + fma(a.rest, r, a.rest));
    V const minus_tail = minus.tail + ((e - o) + fma(a.rest, r, -a.rest));
    V const m = power_of_two(V(-2.0) * min(V(500.0), a.k)); // 2^-2k
    V const minus_head = minus.head * m;                    // exact
    exact_pair<V> const s = two_sum(plus.head, -minus_head), c = two_sum(plus.head, minus_head);
    V const m_tail = minus_tail * m;
    auto const small = a.k == V(0.0);
    return {a.k,
            {select(small, r + r, s.head), select(small, o + o, s.tail + (plus_tail - m_tail))},
            {c.head, c.tail + (plus_tail + m_tail)}};
}

struct sinh_bounds {
    template <class D, class V>
    [[nodiscard]] static V at(V x) noexcept {
        auto const y = hyperbolic_kernel(min(V(712.0), abs(x)));
        V const s = bound_of_any<D>(with_sign(y.sinh, x), kernel_error::sinh * unit_roundoff);
        return if_beyond<D>(x, D::scaled(s, y.k - V(1.0)));
    }
};
/// For x >= 0.
struct cosh_bounds {
    template <class D, class V>
    [[nodiscard]] static V at(V x) noexcept {
        auto const y = hyperbolic_kernel(min(V(712.0), x));
        V const c = bound<D>(y.cosh, kernel_error::cosh * unit_roundoff);
        V const u = D::scaled(c, y.k - V(1.0)), one(1.0);
        return D::of(max(one, u), select(x == V(0.0), one, u));
    }
};
struct tanh_bounds {
    template <class D, class V>
    [[nodiscard]] static V at(V x) noexcept {
        auto const y = hyperbolic_kernel(min(V(22.0), abs(x)));
        expansion<V> const t = with_sign(quotient(normalized(y.sinh), normalized(y.cosh)), x);
        V const b = bound_of_any<D>(t, kernel_error::tanh * unit_roundoff);
        return if_within<D>(x, D::of(max(V(-1.0), b), min(V(1.0), b)));
    }
};

// ---- log and log1p (docs/theory/pack_functions.md, section 5)

namespace kernel_error {
inline constexpr double log = 2.0, log1p = 2.0;
}

/// 2/3, 2/5, 2/7, ...
template <std::size_t N>
[[nodiscard]] constexpr std::array<double, N> area_tangent_series() noexcept {
    std::array<double, N> c{};
    for (std::size_t i = 0; i < N; ++i) c[i] = 2.0 / static_cast<double>(2 * i + 3);
    return c;
}

/// ln(1 + f) - f for sqrt(1/2) - 1 <= f <= sqrt(2) - 1, to the precision of that difference:
///   with s = f/(2+f):  ln(1+f) = 2 artanh s = f - (f^2/2 - s (f^2/2 + R)),  R = 2 s^2/3 + 2 s^4/5
///   + ...
template <class V>
[[nodiscard]] V log_tail(V f) noexcept {
    static constexpr auto c = area_tangent_series<11>();
    V const s = f / (V(2.0) + f);
    V const z = s * s;
    V const half_square = (f * f) * V(0.5);
    return fma(s, fma(z, horner(z, c), half_square), -half_square);
}

/// x = 2^e (1 + f), f as above, for finite x > 0.
template <class V>
struct log_argument {
    V e, f;
};
template <class V>
[[nodiscard]] log_argument<V> reduce_log(V x) noexcept {
    V e(0.0);
    if constexpr (!V::reads_subnormals) {
        auto const tiny = x < V(0x1p-1022);
        e = select(tiny, V(-54.0), e);
        x = select(tiny, x * V(0x1p54), x);
    }
    V const m = mantissa(x);
    auto const upper_half = m > V(0x1.6a09e667f3bcdp+0); // sqrt 2
    return {e + (exponent(x) + select(upper_half, V(1.0), V(0.0))),
            select(upper_half, m * V(0.5), m) - V(1.0)};
}

/// e ln 2 + ln(1 + f) + more.
template <class V>
[[nodiscard]] expansion<V> log_kernel(log_argument<V> const& a, V more) noexcept {
    V const e = a.e, f = a.f; // copies: see pack_arithmetic.hpp
    exact_pair<V> const sum = fast_two_sum(e * V(ln2_high), f);
    return {sum.head, sum.tail + fma(e, V(ln2_low), log_tail(f) + more)};
}

template <class V>
[[nodiscard]] V log_special(V x, V y) noexcept {
    y = select(x == V(infinity), V(infinity), y);
    return select(x <= V(0.0), V(-infinity), select(unordered(x, x), x, y));
}
struct log_bounds {
    template <class D, class V>
    [[nodiscard]] static V at(V x) noexcept {
        auto const y = log_kernel(reduce_log(x), V(0.0));
        return log_special(x, bound<D>(y, kernel_error::log * unit_roundoff));
    }
};

/// ln(1 + x): of the rounded 1 + x, with its rounding error c as the term c/(1 + x); where 1 + x
/// lies between sqrt(1/2) and sqrt 2 the argument f is x itself.
template <class V>
[[nodiscard]] expansion<V> log1p_kernel(V x) noexcept {
    exact_pair<V> const w = two_sum(V(1.0), x);
    log_argument<V> a = reduce_log(w.head);
    auto const near_one = a.e == V(0.0);
    a.f = select(near_one, x, a.f);
    return log_kernel(a, select(near_one, V(0.0), w.tail / w.head));
}
struct log1p_bounds {
    template <class D, class V>
    [[nodiscard]] static V at(V x) noexcept {
        V const y = bound_of_any<D>(log1p_kernel(x), kernel_error::log1p * unit_roundoff);
        return select(x == V(infinity), x,
                      select(x <= V(-1.0), V(-infinity), D::of(y, min(x, y)))); // ln(1 + x) <= x
    }
};

// ---- sin, cos, tan on |x| <= `trigonometric_limit` (section 6)

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
[[nodiscard, gnu::always_inline]] inline sine_pair<V>
sine_kernel(turn_argument<V> const& a) noexcept {
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
    V const margin = V(kernel_error::sin_cos * unit_roundoff) * abs(head) + V(least_double);
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
    V const from = bound_of_any<downward>(tan_kernel(a), delta);
    V const to = bound_of_any<upward>(tan_kernel(b), delta);
    return {select(pole, V(-infinity), from), select(pole, V(infinity), to)};
}

// ---- atan, asin, acos (section 7)

namespace kernel_error {
inline constexpr double atan = 0.5, asin = 0.5, acos = 0.5;
}

/// From the slope `from` on: arctan = head + tail + arctan(distance to the slope `centre`).
struct slope_band {
    double from, centre, head, tail;
};
inline constexpr std::array<slope_band, 7> slope_bands{{
    {0x1p-3, 0.25, 0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
    {0x1.7acd6p-2, 0.5, 0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
    {0x1.3c6fp-1, 0.75, 0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
    {0x1.bc0e2p-1, 1.0, 0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55},
    {0x1.3845200000000p+0, 1.5, 0x1.f730bd281f69bp-1, 0x1.007887af0cbbdp-56},
    {0x1.b9224p+0, 2.0, 0x1.1b6e192ebbe44p+0, 0x1.b1b466a88828ep-54},
    {0x1.5a046p+1, 4.0, 0x1.5368c951e9cfdp+0, -0x1.96f47948a99f1p-54},
}};
/// The last band, from slope 8 on: pi/2 - arctan(1/slope). pi/2 = head + tail, error below 2^-108.
inline constexpr double steep = 8.0;
inline constexpr double half_pi_head = 0x1.921fb54442d18p+0, half_pi_tail = 0x1.1a62633145c07p-54;

/// -1/3, 1/5, -1/7, ...
template <std::size_t N>
[[nodiscard]] constexpr std::array<double, N> tangent_series() noexcept {
    std::array<double, N> c{};
    for (std::size_t i = 0; i < N; ++i)
        c[i] = (i % 2 == 0 ? -1.0 : 1.0) / static_cast<double>(2 * i + 3);
    return c;
}

/// arctan(y/x) for expansions y, x >= 0, not both zero, of moderate size:
///   arctan(y/x) = arctan c + arctan t,  t = (y - c x)/(x + c y), |t| <= 1/8.
template <class V>
[[nodiscard]] expansion<V> angle_kernel(expansion<V> const& y, expansion<V> const& x) noexcept {
    static constexpr auto series = tangent_series<10>();
    V c(0.0), head(0.0), tail(0.0);
    for (slope_band const& band : slope_bands) {
        auto const inside = y.head >= x.head * V(band.from);
        c = select(inside, V(band.centre), c);
        head = select(inside, V(band.head), head);
        tail = select(inside, V(band.tail), tail);
    }
    auto const is_steep = y.head >= x.head * V(steep);
    c = select(is_steep, V(0.0), c);
    head = select(is_steep, V(half_pi_head), head);
    tail = select(is_steep, V(half_pi_tail), tail);

    exact_pair<V> const cx = two_product(c, x.head), cy = two_product(c, y.head);
    exact_pair<V> const sum = two_sum(x.head, cy.head);
    expansion<V> n{y.head - cx.head, // exact: cx is near y, or zero
                   y.tail - (cx.tail + c * x.tail)};
    expansion<V> d{sum.head, sum.tail + (cy.tail + (x.tail + c * y.tail))};
    n = {select(is_steep, -x.head, n.head), select(is_steep, -x.tail, n.tail)};
    d = {select(is_steep, y.head, d.head), select(is_steep, y.tail, d.tail)};

    expansion<V> const t = quotient(n, d);
    V const z = t.head * t.head;
    V const curve = fma(t.head * z, horner(z, series), t.tail);
    exact_pair<V> const s = fast_two_sum(head, t.head);
    return {s.head, s.tail + (tail + curve)};
}

template <class V>
[[nodiscard]] expansion<V> atan_kernel(V x) noexcept {
    // Beyond 2^900 the angle differs from pi/2 by less than 2^-900, far below the margin.
    V const y = min(V(0x1p900), abs(x));
    return with_sign(angle_kernel(expansion<V>{y, V(0.0)}, expansion<V>{V(1.0), V(0.0)}), x);
}
struct atan_bounds {
    template <class D, class V>
    [[nodiscard]] static V at(V x) noexcept {
        return if_within<D>(x, bound_of_any<D>(atan_kernel(x), kernel_error::atan * unit_roundoff));
    }
};

/// sqrt(1 - a^2) for 0 <= a <= 1, relative error below 2^-98.
template <class V>
[[nodiscard]] expansion<V> complement(V a) noexcept {
    exact_pair<V> const p = fast_two_sum(V(1.0), -a), q = fast_two_sum(V(1.0), a);
    exact_pair<V> const w = two_product(p.head, q.head);
    V const w_tail = w.tail + fma(p.head, q.tail, p.tail * q.head);
    V const s = sqrt(w.head);
    exact_pair<V> const square = two_product(s, s);
    V const rest = ((w.head - square.head) - square.tail) + w_tail;
    return {s, select(s == V(0.0), V(0.0), rest / (s + s))};
}

template <class V>
[[nodiscard]] expansion<V> asin_kernel(V x) noexcept {
    V const a = abs(x);
    return with_sign(angle_kernel(expansion<V>{a, V(0.0)}, complement(a)), x);
}
/// For -1 <= x <= 1.
struct asin_bounds {
    template <class D, class V>
    [[nodiscard]] static V at(V x) noexcept {
        return if_beyond<D>(x, bound_of_any<D>(asin_kernel(x), kernel_error::asin * unit_roundoff));
    }
};

/// arccos x, for x < 0 as pi - arccos |x|.
template <class V>
[[nodiscard]] expansion<V> acos_kernel(V x) noexcept {
    V const a = abs(x);
    expansion<V> const y = angle_kernel(complement(a), expansion<V>{a, V(0.0)});
    exact_pair<V> const s = fast_two_sum(V(2 * half_pi_head), -y.head);
    auto const negative = x < V(0.0);
    return {select(negative, s.head, y.head),
            select(negative, s.tail + (V(2 * half_pi_tail) - y.tail), y.tail)};
}
struct acos_bounds {
    template <class D, class V>
    [[nodiscard]] static V at(V x) noexcept {
        return bound_of_any<D>(acos_kernel(x), kernel_error::acos * unit_roundoff);
    }
};

} // namespace SIVID_PACK_TARGET
} // namespace sivid::simd

#endif
