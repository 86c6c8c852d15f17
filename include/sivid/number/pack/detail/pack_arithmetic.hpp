// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_PACK_DETAIL_PACK_ARITHMETIC_HPP
#define SIVID_NUMBER_PACK_DETAIL_PACK_ARITHMETIC_HPP

/// @file
/// Interval operations on vectors of lower and upper bounds, without branches on data. Meanings as
/// in IEEE 1788: bounds NaN = empty, 0 * inf = 0, quotients over the non-zero part of the divisor.
/// All tight. Masks are set where the function is not defined on the whole argument.

#include <sivid/number/pack/detail/pack_directed.hpp>

#include <limits>

namespace sivid::simd {
inline namespace SIVID_PACK_TARGET {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
inline constexpr double least_double = std::numeric_limits<double>::denorm_min();

/// One interval in each lane. Handed over by reference throughout: g++ 12 at -O1 takes the copy of
/// a by-value argument on the stack for unchanged after a call in between (it found
/// cosh_upper(mag(t)) to be cosh_upper(mig(t))).
template <class V>
struct bounds {
    V lo, hi;
};

template <class V>
using mask_of = typename V::mask;

template <class V>
[[nodiscard, gnu::always_inline]] inline bounds<V> select(mask_of<V> m, bounds<V> const& yes,
                                                          bounds<V> const& no) noexcept {
    return {select(m, yes.lo, no.lo), select(m, yes.hi, no.hi)};
}
template <class V>
[[nodiscard, gnu::always_inline]] inline bounds<V> constant(double lo, double hi) noexcept {
    return {V(lo), V(hi)};
}
template <class V>
[[nodiscard, gnu::always_inline]] inline bounds<V> empty_where(mask_of<V> m,
                                                               bounds<V> const& x) noexcept {
    return select(m, constant<V>(not_a_number, not_a_number), x);
}

template <class V>
[[nodiscard, gnu::always_inline]] inline mask_of<V> is_empty(bounds<V> const& a) noexcept {
    return unordered(a.lo, a.lo);
}
template <class V>
[[nodiscard, gnu::always_inline]] inline mask_of<V> either_empty(bounds<V> const& a,
                                                                 bounds<V> const& b) noexcept {
    return unordered(a.lo, b.lo);
}
template <class V>
[[nodiscard, gnu::always_inline]] inline mask_of<V> contains_zero(bounds<V> const& a) noexcept {
    return (a.lo <= V(0.0)) & (a.hi >= V(0.0));
}

template <class V>
[[nodiscard, gnu::always_inline]] inline bounds<V> neg(bounds<V> const& a) noexcept {
    return {-a.hi, -a.lo};
}
template <class V>
[[nodiscard, gnu::always_inline]] inline bounds<V> add(bounds<V> const& a,
                                                       bounds<V> const& b) noexcept {
    using d = directed<V>;
    return {d::add_down(a.lo, b.lo), d::add_up(a.hi, b.hi)};
}
template <class V>
[[nodiscard, gnu::always_inline]] inline bounds<V> sub(bounds<V> const& a,
                                                       bounds<V> const& b) noexcept {
    using d = directed<V>;
    return {d::sub_down(a.lo, b.hi), d::sub_up(a.hi, b.lo)};
}

/// Extremes of the four products of the ends. 0 * inf is NaN and left out: another product then
/// yields the 0, except for zero times everything, where all four are NaN.
template <class V>
[[nodiscard, gnu::always_inline]] inline bounds<V> mul(bounds<V> const& a,
                                                       bounds<V> const& b) noexcept {
    using d = directed<V>;
    V l0, l1, l2, l3, u0, u1, u2, u3;
    V const p = a.lo, q = a.hi, r = b.lo, s = b.hi; // copies: see pack_directed.hpp
    d::mul_both(p, r, l0, u0);
    d::mul_both(p, s, l1, u1);
    d::mul_both(q, r, l2, u2);
    d::mul_both(q, s, l3, u3);
    V const lo = min_number(min_number(l0, l1), min_number(l2, l3));
    V const hi = max_number(max_number(u0, u1), max_number(u2, u3));
    auto const zero = unordered(lo, lo) & !either_empty(a, b);
    return {select(zero, V(0.0), lo), select(zero, V(0.0), hi)};
}

/// Two divisions: a divisor below zero is turned, together with the dividend, to one above; then
/// the signs of the dividend's ends choose the divisor's end. A divisor's end 0 counts as +0, so
/// that overflow to infinity has the right sign.
template <class V>
[[nodiscard, gnu::always_inline]] inline bounds<V> div(bounds<V> const& a, bounds<V> const& b,
                                                       mask_of<V>& undefined) noexcept {
    using d = directed<V>;
    V const zero(0.0);
    auto const turned = b.hi <= zero;
    bounds<V> const n = select(turned, neg(a), a);
    bounds<V> const y = select(turned, neg(b), b);
    V const least = abs(y.lo); // where y.lo < 0 the result is replaced below
    bounds<V> q{d::div_down(n.lo, select(n.lo >= zero, y.hi, least)),
                d::div_up(n.hi, select(n.hi > zero, least, y.hi))};

    auto const none = either_empty(a, b);
    auto const dividend_zero = (a.lo == zero) & (a.hi == zero);
    auto const zero_inside = y.lo < zero;
    q = select(zero_inside, constant<V>(-infinity, infinity), q);
    q = select(zero_inside & dividend_zero, constant<V>(0.0, 0.0), q);
    undefined = undefined | (contains_zero(b) & !none);
    return empty_where(none | (y.hi == zero), q);
}

template <class V>
[[nodiscard, gnu::always_inline]] inline V mig(bounds<V> const& a) noexcept {
    return select(contains_zero(a), V(0.0), min(abs(a.lo), abs(a.hi)));
}
template <class V>
[[nodiscard, gnu::always_inline]] inline V mag(bounds<V> const& a) noexcept {
    return max(abs(a.lo), abs(a.hi));
}
template <class V>
[[nodiscard, gnu::always_inline]] inline bounds<V> abs(bounds<V> const& a) noexcept {
    return {mig(a), mag(a)};
}
template <class V>
[[nodiscard]] bounds<V> sqr(bounds<V> const& a) noexcept {
    using d = directed<V>;
    V const low = mig(a), high = mag(a);
    return {d::mul_down(low, low), d::mul_up(high, high)};
}
template <class V>
[[nodiscard]] bounds<V> sqrt(bounds<V> const& a, mask_of<V>& undefined) noexcept {
    using d = directed<V>;
    V const zero(0.0);
    auto const below = a.hi < zero;
    undefined = undefined | (a.lo < zero);
    bounds<V> const x{max(zero, a.lo), select(below, zero, a.hi)};
    return empty_where(below, bounds<V>{d::sqrt_down(x.lo), d::sqrt_up(x.hi)});
}

template <class V>
[[nodiscard, gnu::always_inline]] inline bounds<V> min(bounds<V> const& a,
                                                       bounds<V> const& b) noexcept {
    return empty_where(either_empty(a, b), bounds<V>{min(a.lo, b.lo), min(a.hi, b.hi)});
}
template <class V>
[[nodiscard, gnu::always_inline]] inline bounds<V> max(bounds<V> const& a,
                                                       bounds<V> const& b) noexcept {
    return empty_where(either_empty(a, b), bounds<V>{max(a.lo, b.lo), max(a.hi, b.hi)});
}
template <class V>
[[nodiscard, gnu::always_inline]] inline bounds<V> hull(bounds<V> const& a,
                                                        bounds<V> const& b) noexcept {
    return {min_number(a.lo, b.lo), max_number(a.hi, b.hi)};
}
template <class V>
[[nodiscard, gnu::always_inline]] inline bounds<V> intersect(bounds<V> const& a,
                                                             bounds<V> const& b) noexcept {
    V const lo = max(a.lo, b.lo), hi = min(a.hi, b.hi);
    return empty_where(either_empty(a, b) | (hi < lo), bounds<V>{lo, hi});
}

/// \f$ \{\mathrm{sign}\, t\} \f$ with sign 0 = 0.
template <class V>
[[nodiscard]] bounds<V> sign(bounds<V> const& a) noexcept {
    V const zero(0.0), one(1.0);
    auto const of = [&](V t) {
        return select(t > zero, one, select(t < zero, -one, select(unordered(t, t), t, zero)));
    };
    V const lo = a.lo, hi = a.hi;
    return {of(lo), of(hi)};
}

/// \f$ \{t^n\} \f$, by squaring; at most 2 log2(n) roundings a side.
template <class V>
[[nodiscard]] bounds<V> pown(bounds<V> const& a, int n, mask_of<V>& undefined) noexcept {
    using d = directed<V>;
    V const one(1.0), zero(0.0);
    if (n == 0) return empty_where(is_empty(a), bounds<V>{one, one});
    auto const magnitude = n < 0 ? 0u - static_cast<unsigned>(n) : static_cast<unsigned>(n);
    // Bounds of |t|^(n or n-1) for each end, an even power.
    auto const even_power = [](V t, unsigned m) {
        bounds<V> power{V(1.0), V(1.0)}, factor{t, t};
        for (; m != 0; m /= 2) {
            if (m % 2 != 0)
                power = {d::mul_down(power.lo, factor.lo), d::mul_up(power.hi, factor.hi)};
            if (m > 1)
                factor = {d::mul_down(factor.lo, factor.lo), d::mul_up(factor.hi, factor.hi)};
        }
        return power;
    };
    bounds<V> y;
    if (n == 1) {
        y = a;
    } else if (magnitude % 2 == 0) {
        y = {even_power(mig(a), magnitude).lo, even_power(mag(a), magnitude).hi};
    } else {
        bounds<V> const p = even_power(abs(a.lo), magnitude - 1),
                        q = even_power(abs(a.hi), magnitude - 1);
        y = {d::mul_down(a.lo, select(a.lo < zero, p.hi, p.lo)),
             d::mul_up(a.hi, select(a.hi < zero, q.lo, q.hi))};
    }
    if (n > 0) return y;
    auto const has_zero = contains_zero(a);
    undefined = undefined | has_zero;
    auto ignored = has_zero; // a power that underflows to zero is not one
    return div(bounds<V>{one, one}, y, ignored);
}

} // namespace SIVID_PACK_TARGET
} // namespace sivid::simd

#endif
