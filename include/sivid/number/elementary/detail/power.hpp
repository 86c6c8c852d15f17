// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_ELEMENTARY_DETAIL_POWER_HPP
#define SIVID_NUMBER_ELEMENTARY_DETAIL_POWER_HPP

/// @file
/// sqr, sqrt, pown, pow, hypot of intervals.

#include <sivid/number/arithmetic.hpp>
#include <sivid/number/elementary/detail/functions_at.hpp>
#include <sivid/number/interval.hpp>
#include <sivid/number/rounding.hpp>

#include <concepts>
#include <utility>

namespace sivid {

namespace detail {

/// The arithmetic of the traits: it does not look for FTZ and DAZ.
inline interval sqrt(interval const& x, bool& cut) noexcept {
    if (is_empty(x)) return x;
    if (x.lower() < 0.0) cut = true;
    if (x.upper() < 0.0) return empty_interval();
    return unchecked_interval(x.lower() <= 0.0 ? 0.0 : sqrt_down(x.lower()), sqrt_up(x.upper()));
}

} // namespace detail

/// \f$ \{t^2 : t \in x\} \f$, tight.
inline interval sqr(interval const& x) noexcept {
    return detail::in_nearest_mode([](interval const& t) { return detail::sqr(t); }, x);
}

/// \f$ \{\sqrt t : t \in x, t \ge 0\} \f$, tight; sets `cut` if x has elements < 0.
inline interval sqrt(interval const& x, bool& cut) noexcept {
    return detail::in_nearest_mode_cut(
        cut, [](interval const& t, bool& left) { return detail::sqrt(t, left); }, x);
}

namespace detail {

/// Bounds of t^n on t >= 0, n >= 1. Up to n = 4 by rounded products (exact when they are), else
/// as real powers. The result for infinity is infinite.
inline double pown_down(double t, unsigned n) noexcept {
    if (n == 1 || is_zero(t) || is_infinite(t) || t == 1.0) return t;
    double const square = n <= 4 ? mul_down(t, t) : 0.0;
    if (n == 2) return square;
    if (n == 3) return mul_down(square, t);
    if (n == 4) return mul_down(square, square);
    nearest_mode const mode;
    double const y = pow_at::down(t, static_cast<double>(n));
    double const least = t > 1.0 ? 1.0 : 0.0;
    return y < least ? least : y;
}
inline double pown_up(double t, unsigned n) noexcept {
    if (n == 1 || is_zero(t) || is_infinite(t) || t == 1.0) return t;
    double const square = n <= 4 ? mul_up(t, t) : 0.0;
    if (n == 2) return square;
    if (n == 3) return mul_up(square, t);
    if (n == 4) return mul_up(square, square);
    nearest_mode const mode;
    double const y = pow_at::up(t, static_cast<double>(n));
    return t < 1.0 && y > 1.0 ? 1.0 : y;
}

/// t^n on x, n >= 1.
inline interval positive_pown(interval const& x, unsigned n) noexcept {
    if (n % 2 == 0) return unchecked_interval(pown_down(mig(x), n), pown_up(mag(x), n));
    double const lo = x.lower(), hi = x.upper();
    return unchecked_interval(lo < 0.0 ? -pown_up(-lo, n) : pown_down(lo, n),
                              hi < 0.0 ? -pown_down(-hi, n) : pown_up(hi, n));
}

/// Reciprocal powers for n >= 1: a real power t^-n keeps full accuracy where t^n overflows.
inline double negative_pown_down(double t, unsigned n) noexcept {
    if (t == 1.0) return 1.0;
    if (is_zero(t)) return infinity;
    if (n == 1) return div_down(1.0, t);
    nearest_mode const mode;
    double const y = pow_at::down(t, -static_cast<double>(n));
    double const least = t < 1.0 ? 1.0 : 0.0;
    return y < least ? least : y;
}
inline double negative_pown_up(double t, unsigned n) noexcept {
    if (t == 1.0) return 1.0;
    if (is_zero(t)) return infinity;
    if (is_infinite(t)) return 0.0;
    if (n == 1) return div_up(1.0, t);
    nearest_mode const mode;
    double const y = pow_at::up(t, -static_cast<double>(n));
    return t > 1.0 && y > 1.0 ? 1.0 : y;
}

/// t^-n on x, n >= 1, t != 0.
inline interval negative_pown(interval const& x, unsigned n) noexcept {
    double const lo = x.lower(), hi = x.upper();
    if (is_zero(lo) && is_zero(hi)) return empty_interval();
    if (n % 2 == 0)
        return unchecked_interval(negative_pown_down(mag(x), n), negative_pown_up(mig(x), n));
    if (lo < 0.0 && hi > 0.0) return entire_interval();
    if (lo >= 0.0) return unchecked_interval(negative_pown_down(hi, n), negative_pown_up(lo, n));
    return unchecked_interval(-negative_pown_up(-hi, n), -negative_pown_down(-lo, n));
}

/// The arithmetic of the traits: up to the fourth power it does not look for FTZ and DAZ.
inline interval pown(interval const& x, int n, bool& cut) noexcept {
    if (is_empty(x)) return x;
    if (n == 0) return unchecked_interval(1.0, 1.0);
    if (n > 0) return positive_pown(x, static_cast<unsigned>(n));
    if (x.lower() <= 0.0 && x.upper() >= 0.0) cut = true;
    return negative_pown(x, 0u - static_cast<unsigned>(n));
}

} // namespace detail

/// \f$ \{t^n : t \in x\} \f$ for an integer n, with \f$ t^0 = 1 \f$; sets `cut` if n < 0 and 0 is
/// in x. Max excess: 0 for n = 0, 1, 2, -1, two roundings for n = 3, 4, else `excess::pow` floats a
/// side.
inline interval pown(interval const& x, int n, bool& cut) noexcept {
    return detail::in_nearest_mode_cut(
        cut, [n](interval const& t, bool& left) { return detail::pown(t, n, left); }, x);
}

namespace detail {

/// s^t for s >= 0, exact where its limit is 0, 1 or infinite.
inline bounds_at power_at(double s, double t) noexcept {
    if (s == 1.0 || t == 0.0) return {1.0, 1.0};
    if (is_zero(s) || is_infinite(t)) [[unlikely]] {
        bool const grows = is_zero(s) ? t < 0.0 : (s > 1.0) == (t > 0.0);
        double const limit = grows ? infinity : 0.0;
        return {limit, limit};
    }
    return pow_at::both(s, t);
}

/// pow as below.
inline interval nearest_pow(interval const& x, interval const& y, bool& cut) noexcept {
    if (is_empty(x) || is_empty(y)) return empty_interval();
    if (x.lower() < 0.0 || (x.lower() <= 0.0 && y.lower() <= 0.0)) cut = true;
    if (x.upper() < 0.0 || (x.upper() <= 0.0 && y.upper() <= 0.0)) return empty_interval();
    if (x.upper() <= 0.0) return unchecked_interval(0.0, 0.0);
    double const xl = x.lower() <= 0.0 ? 0.0 : x.lower();
    double lo = infinity, hi = 0.0;
    for (double const s : {xl, x.upper()}) {
        for (double const t : {y.lower(), y.upper()}) {
            bounds_at const p = power_at(s, t);
            lo = p.lower < lo ? p.lower : lo;
            hi = p.upper > hi ? p.upper : hi;
        }
    }
    if (lo < 0.0) lo = 0.0;
    // Powers that cannot cross 1.
    bool const above_one =
        (xl >= 1.0 && y.lower() >= 0.0) || (x.upper() <= 1.0 && y.upper() <= 0.0);
    bool const below_one =
        (xl >= 1.0 && y.upper() <= 0.0) || (x.upper() <= 1.0 && y.lower() >= 0.0);
    if (above_one && lo < 1.0) lo = 1.0;
    if (below_one && hi > 1.0) hi = 1.0;
    return bounded(lo, hi);
}

} // namespace detail

/// \f$ \{s^t : s \in x, t \in y, s > 0 \text{ or } (s = 0, t > 0)\} \f$; sets `cut` if pairs are
/// left out. ln(s^t) = t ln s is bilinear, so the extremes are at the corners; at corners out of
/// the domain the limits are taken. Max excess: `excess::pow` floats a side.
inline interval pow(interval const& x, interval const& y, bool& cut) noexcept {
    return detail::in_nearest_mode_cut(cut, detail::nearest_pow, x, y);
}

namespace detail {

/// sqrt(a^2 + b^2) for a, b >= 0 rounded towards D; scaled by a power of two where squares would
/// overflow or lose digits (scaling is rounded towards D as well).
template <direction D>
double hypot_bound(double a, double b) noexcept {
    if (is_infinite(a) || is_infinite(b)) return infinity;
    if (is_zero(a)) return b;
    if (is_zero(b)) return a;
    double const big = a > b ? a : b;
    double const down = big > 0x1p500 ? 0x1p-600 : big < 0x1p-400 ? 0x1p600 : 1.0;
    double const u = mul<D>(a, down), v = mul<D>(b, down);
    double const root = sqrt<D>(add<D>(mul<D>(u, u), mul<D>(v, v)));
    return down == 1.0 ? root : div<D>(root, down);
}

} // namespace detail

/// \f$ \{\sqrt{s^2 + t^2} : s \in x, t \in y\} \f$.  Max excess: 2 floats a side.
inline interval hypot(interval const& x, interval const& y) noexcept {
    return detail::in_nearest_mode(
        [](interval const& s, interval const& t) {
            if (is_empty(s) || is_empty(t)) return detail::empty_interval();
            double const lo = detail::hypot_bound<detail::direction::down>(mig(s), mig(t));
            double const hi = detail::hypot_bound<detail::direction::up>(mag(s), mag(t));
            return detail::bounded(lo, hi);
        },
        x, y);
}

// A cut of the domain is silent in the forms without the flag.
inline interval sqrt(interval const& x) noexcept {
    bool cut = false;
    return sqrt(x, cut);
}
inline interval pown(interval const& x, int n) noexcept {
    bool cut = false;
    return pown(x, n, cut);
}
inline interval pow(interval const& x, interval const& y) noexcept {
    bool cut = false;
    return pow(x, y, cut);
}
/// Whole exponents mean integer powers, on negative numbers too. Beyond the range of int: what is
/// known from the parity alone.
/// @see pown
inline interval pow(interval const& x, int n) noexcept { return pown(x, n); }
template <std::integral N>
    requires(!std::same_as<N, int>)
interval pow(interval const& x, N n)
noexcept {
    if (std::in_range<int>(n)) return pown(x, static_cast<int>(n));
    if (is_empty(x)) return x;
    return n % 2 == 0 ? detail::unchecked_interval(0.0, detail::infinity)
                      : detail::entire_interval();
}
/// A real power; without this form a fraction would be cut off to an integer.
template <std::floating_point T>
interval pow(interval const& x, T y) noexcept {
    return pow(x, interval{static_cast<double>(y)});
}
// pow(x, 0.5) is meant.
template <std::floating_point T>
interval pown(interval const&, T) = delete;
template <std::floating_point T>
interval pown(interval const&, T, bool&) = delete;

} // namespace sivid

#endif
