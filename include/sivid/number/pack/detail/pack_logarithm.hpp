// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_PACK_DETAIL_PACK_LOGARITHM_HPP
#define SIVID_NUMBER_PACK_DETAIL_PACK_LOGARITHM_HPP

/// @file
/// Kernels of log and log1p (docs/pack_functions.md, section 5).

#include <sivid/number/pack/detail/pack_exponential.hpp>

#include <array>
#include <cstddef>

namespace sivid::simd {
inline namespace SIVID_PACK_TARGET {

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
    V const e = a.e, f = a.f; // copies: see pack_directed.hpp
    exact_pair<V> const sum = fast_two_sum(e * V(ln2_high), f);
    return {sum.head, sum.tail + fma(e, V(ln2_low), log_tail(f) + more)};
}

template <class V>
[[nodiscard]] V log_special(V x, V y) noexcept {
    y = select(x == V(infinity), V(infinity), y);
    return select(x <= V(0.0), V(-infinity), select(unordered(x, x), x, y));
}
template <class V>
[[nodiscard]] V log_lower(V x) noexcept {
    auto const y = log_kernel(reduce_log(x), V(0.0));
    return log_special(x, lower_bound(y, kernel_error::log * unit_roundoff));
}
template <class V>
[[nodiscard]] V log_upper(V x) noexcept {
    auto const y = log_kernel(reduce_log(x), V(0.0));
    return log_special(x, upper_bound(y, kernel_error::log * unit_roundoff));
}

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
template <class V>
[[nodiscard]] V log1p_lower(V x) noexcept {
    V const y = lower_bound_of_any(log1p_kernel(x), kernel_error::log1p * unit_roundoff);
    return select(x == V(infinity), x, select(x <= V(-1.0), V(-infinity), y));
}
template <class V>
[[nodiscard]] V log1p_upper(V x) noexcept {
    V const y = upper_bound_of_any(log1p_kernel(x), kernel_error::log1p * unit_roundoff);
    // ln(1 + x) <= x
    return select(x == V(infinity), x, select(x <= V(-1.0), V(-infinity), min(x, y)));
}

} // namespace SIVID_PACK_TARGET
} // namespace sivid::simd

#endif
