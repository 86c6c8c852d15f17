// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_PACK_DETAIL_PACK_KERNEL_HPP
#define SIVID_NUMBER_PACK_DETAIL_PACK_KERNEL_HPP

/// @file
/// What the kernels of elementary functions share. A kernel computes, in round-to-nearest, an
/// unevaluated sum head + tail with
///   \f$ |head + tail - f(x)| \le \delta\,|head| \f$
/// and the bounds are directed sums head + (tail -+ delta |head|): one rounding each. The constants
/// delta, in units of 2^-53, are derived in docs/pack_functions.md, for fused and for separate
/// multiply-add, with the rounding of tail -+ delta |head| included.

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

/// Bounds of head + tail for results that are zero or at least 2^-900.
template <class V>
[[nodiscard, gnu::always_inline]] inline V lower_bound(expansion<V> const& y,
                                                       double delta) noexcept {
    return directed<V>::add_down(y.head, y.tail - V(delta) * abs(y.head));
}
template <class V>
[[nodiscard, gnu::always_inline]] inline V upper_bound(expansion<V> const& y,
                                                       double delta) noexcept {
    return directed<V>::add_up(y.head, y.tail + V(delta) * abs(y.head));
}

/// The margin for results of any size. Where delta |head| is below the least double, the tail is
/// zero and |f(x) - head| < 2^-1074; a head of zero is exact.
template <class V>
[[nodiscard]] V margin(V head, double delta) noexcept {
    return select(head == V(0.0), V(0.0), fma(V(delta), abs(head), V(least_double)));
}
template <class V>
[[nodiscard, gnu::always_inline]] inline V lower_bound_of_any(expansion<V> const& y,
                                                              double delta) noexcept {
    return directed<V>::add_down(y.head, y.tail - margin(y.head, delta));
}
template <class V>
[[nodiscard, gnu::always_inline]] inline V upper_bound_of_any(expansion<V> const& y,
                                                              double delta) noexcept {
    return directed<V>::add_up(y.head, y.tail + margin(y.head, delta));
}

/// y with the known bound |f(x)| >= |x|, or <= |x|, of a function with the sign of x.
template <class V>
[[nodiscard]] V lower_if_beyond(V x, V y) noexcept {
    return select(x >= V(0.0), max(x, y), y);
}
template <class V>
[[nodiscard]] V upper_if_beyond(V x, V y) noexcept {
    return select(x <= V(0.0), min(x, y), y);
}
template <class V>
[[nodiscard]] V lower_if_within(V x, V y) noexcept {
    return select(x <= V(0.0), max(x, y), y);
}
template <class V>
[[nodiscard]] V upper_if_within(V x, V y) noexcept {
    return select(x >= V(0.0), min(x, y), y);
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
    V const a = n.head, b = d.head; // copies: see pack_directed.hpp
    V const q = a / b;
    exact_pair<V> const p = two_product(q, b);
    V const rest = (a - p.head) - p.tail;
    return {q, (rest + (n.tail - q * d.tail)) / b};
}

} // namespace SIVID_PACK_TARGET
} // namespace sivid::simd

#endif
