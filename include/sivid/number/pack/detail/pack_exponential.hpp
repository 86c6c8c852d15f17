// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_PACK_DETAIL_PACK_EXPONENTIAL_HPP
#define SIVID_NUMBER_PACK_DETAIL_PACK_EXPONENTIAL_HPP

/// @file
/// Kernels of exp, expm1, sinh, cosh, tanh (docs/pack_functions.md, section 4).

#include <sivid/number/pack/detail/pack_kernel.hpp>

#include <array>
#include <cstddef>

namespace sivid::simd {
inline namespace SIVID_PACK_TARGET {

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

template <class V>
[[nodiscard]] V exp_lower(V x) noexcept {
    auto const a = reduce_exp(min(V(710.0), max(V(-746.0), x)));
    V const y = lower_bound(exp_kernel(a.r, a.rest), kernel_error::exp * unit_roundoff);
    V const e = directed<V>::scale_down(y, a.k);
    return select(x >= V(0.0), max(V(1.0), e), e);
}
template <class V>
[[nodiscard]] V exp_upper(V x) noexcept {
    auto const a = reduce_exp(min(V(710.0), max(V(-746.0), x)));
    V const y = upper_bound(exp_kernel(a.r, a.rest), kernel_error::exp * unit_roundoff);
    V const e = directed<V>::scale_up(y, a.k);
    return select(x <= V(0.0), min(V(1.0), e), e);
}

/// e^x - 1 = 2^k (head + tail).
template <class V>
[[nodiscard]] expansion<V> expm1_kernel(exp_argument<V> const& a) noexcept {
    V const k = a.k, r = a.r, rest = a.rest; // copies: see pack_directed.hpp
    V const tail = exp_tail(r, rest);
    exact_pair<V> const one_plus_r = fast_two_sum(V(1.0), r);
    V const one = power_of_two(-min(V(1000.0), k)); // 2^-k; above k = 1000 without effect
    exact_pair<V> const d = two_sum(one_plus_r.head, -one);
    auto const small = k == V(0.0);
    return {select(small, r, d.head), select(small, tail, d.tail + (one_plus_r.tail + tail))};
}
template <class V>
[[nodiscard]] V expm1_lower(V x) noexcept {
    auto const a = reduce_exp(min(V(710.0), max(V(-42.0), x)));
    V const y = lower_bound_of_any(expm1_kernel(a), kernel_error::expm1 * unit_roundoff);
    return max(max(V(-1.0), x), directed<V>::scale_down(y, a.k)); // e^x - 1 >= x
}
template <class V>
[[nodiscard]] V expm1_upper(V x) noexcept {
    auto const a = reduce_exp(min(V(710.0), max(V(-42.0), x)));
    V const y = upper_bound_of_any(expm1_kernel(a), kernel_error::expm1 * unit_roundoff);
    return directed<V>::scale_up(y, a.k);
}

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

template <class V>
[[nodiscard]] V sinh_lower(V x) noexcept {
    auto const y = hyperbolic_kernel(min(V(712.0), abs(x)));
    V const s = lower_bound_of_any(with_sign(y.sinh, x), kernel_error::sinh * unit_roundoff);
    return lower_if_beyond(x, directed<V>::scale_down(s, y.k - V(1.0)));
}
template <class V>
[[nodiscard]] V sinh_upper(V x) noexcept {
    auto const y = hyperbolic_kernel(min(V(712.0), abs(x)));
    V const s = upper_bound_of_any(with_sign(y.sinh, x), kernel_error::sinh * unit_roundoff);
    return upper_if_beyond(x, directed<V>::scale_up(s, y.k - V(1.0)));
}
/// For x >= 0.
template <class V>
[[nodiscard]] V cosh_lower(V x) noexcept {
    auto const y = hyperbolic_kernel(min(V(712.0), x));
    V const c = lower_bound(y.cosh, kernel_error::cosh * unit_roundoff);
    return max(V(1.0), directed<V>::scale_down(c, y.k - V(1.0)));
}
template <class V>
[[nodiscard]] V cosh_upper(V x) noexcept {
    auto const y = hyperbolic_kernel(min(V(712.0), x));
    V const c = upper_bound(y.cosh, kernel_error::cosh * unit_roundoff);
    V const u = directed<V>::scale_up(c, y.k - V(1.0));
    return select(x == V(0.0), V(1.0), u);
}

template <class V>
[[nodiscard]] V tanh_lower(V x) noexcept {
    auto const y = hyperbolic_kernel(min(V(22.0), abs(x)));
    expansion<V> const t = with_sign(quotient(normalized(y.sinh), normalized(y.cosh)), x);
    V const b = lower_bound_of_any(t, kernel_error::tanh * unit_roundoff);
    return lower_if_within(x, max(V(-1.0), b));
}
template <class V>
[[nodiscard]] V tanh_upper(V x) noexcept {
    auto const y = hyperbolic_kernel(min(V(22.0), abs(x)));
    expansion<V> const t = with_sign(quotient(normalized(y.sinh), normalized(y.cosh)), x);
    V const b = upper_bound_of_any(t, kernel_error::tanh * unit_roundoff);
    return upper_if_within(x, min(V(1.0), b));
}

} // namespace SIVID_PACK_TARGET
} // namespace sivid::simd

#endif
