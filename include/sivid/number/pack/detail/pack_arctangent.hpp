// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_PACK_DETAIL_PACK_ARCTANGENT_HPP
#define SIVID_NUMBER_PACK_DETAIL_PACK_ARCTANGENT_HPP

/// @file
/// Kernels of atan, asin, acos (docs/pack_functions.md, section 7).

#include <sivid/number/pack/detail/pack_kernel.hpp>

#include <array>
#include <cstddef>

namespace sivid::simd {
inline namespace SIVID_PACK_TARGET {

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
template <class V>
[[nodiscard]] V atan_lower(V x) noexcept {
    return lower_if_within(x,
                           lower_bound_of_any(atan_kernel(x), kernel_error::atan * unit_roundoff));
}
template <class V>
[[nodiscard]] V atan_upper(V x) noexcept {
    return upper_if_within(x,
                           upper_bound_of_any(atan_kernel(x), kernel_error::atan * unit_roundoff));
}

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
template <class V>
[[nodiscard]] V asin_lower(V x) noexcept {
    return lower_if_beyond(x,
                           lower_bound_of_any(asin_kernel(x), kernel_error::asin * unit_roundoff));
}
template <class V>
[[nodiscard]] V asin_upper(V x) noexcept {
    return upper_if_beyond(x,
                           upper_bound_of_any(asin_kernel(x), kernel_error::asin * unit_roundoff));
}

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
template <class V>
[[nodiscard]] V acos_lower(V x) noexcept {
    return lower_bound_of_any(acos_kernel(x), kernel_error::acos * unit_roundoff);
}
template <class V>
[[nodiscard]] V acos_upper(V x) noexcept {
    return upper_bound_of_any(acos_kernel(x), kernel_error::acos * unit_roundoff);
}

} // namespace SIVID_PACK_TARGET
} // namespace sivid::simd

#endif
