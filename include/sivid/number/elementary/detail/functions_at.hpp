// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_ELEMENTARY_DETAIL_FUNCTIONS_AT_HPP
#define SIVID_NUMBER_ELEMENTARY_DETAIL_FUNCTIONS_AT_HPP

/// @file
/// Proved bounds of elementary functions at the ends of an interval, without the C library: the
/// kernels of packs, both ends side by side, arguments of sin, cos and tan beyond their limit
/// reduced in integers, and what follows from these by directed arithmetic
/// (docs/theory/pack_functions.md, section 11). All are given round-to-nearest; what is known of a
/// function at particular numbers is the caller's part.

#include <sivid/number/elementary/detail/integers.hpp>
#include <sivid/number/pack/detail/pack_kernels.hpp>
#include <sivid/number/rounding.hpp>

#include <array>
#include <cstddef>
#include <limits>

namespace sivid::detail {
inline namespace SIVID_PACK_TARGET {

struct bounds_at {
    double lower, upper;
};

/// Lanes in which the ends of an interval are: both side by side, or one after the other.
inline constexpr std::size_t end_lanes = lanes_detail::per_vector == 1 ? 1 : 2;
using end_vector = simd::vector<end_lanes>;

template <class Bounds>
[[nodiscard]] double lower_at(double x) noexcept {
    return Bounds::template at<simd::downward>(simd::vector<1>(x))[0];
}
template <class Bounds>
[[nodiscard]] double upper_at(double x) noexcept {
    return Bounds::template at<simd::upward>(simd::vector<1>(x))[0];
}
/// The lower bound at a, the upper bound at b.
template <class Bounds, class V = end_vector>
[[nodiscard]] bounds_at at_ends(double a, double b) noexcept {
    if constexpr (V::lanes == 1) {
        return {lower_at<Bounds>(a), upper_at<Bounds>(b)};
    } else {
        auto const y = Bounds::template at<simd::outward>(V::of_ends(a, b));
        return {y[0], y[1]};
    }
}

/// As `turns_of`, where some lanes are `far`.
template <class V>
[[nodiscard, gnu::cold]] bool far_turns_of(V x, unsigned far, simd::turn_argument<V>& a) noexcept {
    std::array<double, V::lanes> from, turns, r, rest;
    x.store(from.data());
    a.turns.store(turns.data());
    a.r.store(r.data());
    a.rest.store(rest.data());
    for (std::size_t i = 0; i < V::lanes; ++i) {
        if ((far >> i & 1u) == 0) continue;
        if (is_infinite(from[i])) return false;
        integers::reduced_turns const t = integers::reduce_far(from[i]);
        if (is_zero(t.head)) return false;
        bool const negative = from[i] < 0.0; // -x = -k pi/2 - (head + tail)
        turns[i] = 0x1.8p52 + static_cast<double>(negative ? (4 - t.k) & 3u : t.k);
        r[i] = negative ? -t.head : t.head;
        rest[i] = negative ? -t.tail : t.tail;
    }
    a = {V::load(turns.data()), V::load(r.data()), V::load(rest.data())};
    return true;
}
/// What the kernels take, for any x; false where that is not known (no double is so near to a
/// multiple of pi/2), or x is infinite.
template <class V>
[[nodiscard, gnu::always_inline]] inline bool turns_of(V x, simd::turn_argument<V>& a) noexcept {
    a = simd::reduce_turns(x);
    unsigned const far = (abs(x) > V(simd::trigonometric_limit)).bits();
    if (far == 0) [[likely]]
        return true;
    simd::turn_argument<V> some = a;
    bool const known = far_turns_of(x, far, some);
    a = some;
    return known;
}
/// The hull of sin(a + Shift pi/2) and sin(b + Shift pi/2).
template <int Shift, class V = end_vector>
[[nodiscard]] bounds_at waves_at(double a, double b) noexcept {
    if constexpr (V::lanes == 1) {
        bounds_at hull{1.0, -1.0};
        for (double const end : {a, b}) {
            simd::turn_argument<V> t;
            if (!turns_of(V(end), t)) return {-1.0, 1.0};
            simd::bounds<V> const y = simd::wave_bounds(t, Shift);
            if (y.lo[0] < hull.lower) hull.lower = y.lo[0];
            if (y.hi[0] > hull.upper) hull.upper = y.hi[0];
        }
        return hull;
    } else {
        simd::turn_argument<V> t;
        if (!turns_of(V::of_ends(a, b), t)) return {-1.0, 1.0};
        simd::bounds<V> const y = simd::wave_bounds(t, Shift);
        return {y.lo[0] < y.lo[1] ? y.lo[0] : y.lo[1], y.hi[0] > y.hi[1] ? y.hi[0] : y.hi[1]};
    }
}
struct tan_bounds {
    template <class D, class V>
    [[nodiscard]] static V at(V x) noexcept {
        simd::turn_argument<V> a;
        if (!turns_of(x, a)) return D::of(V(-simd::infinity), V(simd::infinity));
        return simd::bound_of_any<D>(simd::tan_kernel(a),
                                     simd::kernel_error::tan * simd::unit_roundoff);
    }
};

// ln 2 between neighbours, as half_pi and pi below.
inline constexpr double ln2_down = 0x1.62e42fefa39efp-1, ln2_up = 0x1.62e42fefa39f0p-1;
/// From here on area functions are ln 2x, but for less than 2^-59.
inline constexpr double area_limit = 0x1p30;

/// ln(x + sqrt(x^2 + 1)) = ln(1 + a) with a = x + x^2/(1 + sqrt(1 + x^2)); odd. For large x less
/// than 1/(4 x^2) is added to ln 2x.
struct asinh_at {
    static double down(double x) noexcept { return x < 0.0 ? -positive_up(-x) : positive_down(x); }
    static double up(double x) noexcept { return x < 0.0 ? -positive_down(-x) : positive_up(x); }

private:
    static double positive_down(double x) noexcept {
        if (x >= area_limit) return add_down(lower_at<simd::log_bounds>(x), ln2_down);
        double const divisor = add_up(1.0, sqrt_up(add_up(1.0, mul_up(x, x))));
        return lower_at<simd::log1p_bounds>(add_down(x, div_down(mul_down(x, x), divisor)));
    }
    static double positive_up(double x) noexcept {
        if (x >= area_limit) return add_up(add_up(upper_at<simd::log_bounds>(x), ln2_up), 0x1p-59);
        double const divisor = add_down(1.0, sqrt_down(add_down(1.0, mul_down(x, x))));
        double const y = upper_at<simd::log1p_bounds>(add_up(x, div_up(mul_up(x, x), divisor)));
        return y > x ? x : y;
    }
};
/// ln(x + sqrt(x^2 - 1)) = ln(1 + a) with a = x - 1 + sqrt((x - 1)(x + 1)), for x >= 1. For large x
/// less than 1/x^2 is missing from ln 2x.
struct acosh_at {
    static double down(double x) noexcept {
        if (x >= area_limit)
            return add_down(add_down(lower_at<simd::log_bounds>(x), ln2_down), -0x1p-59);
        double const below = add_down(x, -1.0);
        return lower_at<simd::log1p_bounds>(
            add_down(below, sqrt_down(mul_down(below, add_down(x, 1.0)))));
    }
    static double up(double x) noexcept {
        if (x >= area_limit) return add_up(upper_at<simd::log_bounds>(x), ln2_up);
        double const below = add_up(x, -1.0);
        return upper_at<simd::log1p_bounds>(add_up(below, sqrt_up(mul_up(below, add_up(x, 1.0)))));
    }
};
/// ln((1 + x)/(1 - x))/2 = ln(1 + 2x/(1 - x))/2, for -1 < x < 1; odd.
struct atanh_at {
    static double down(double x) noexcept { return x < 0.0 ? -positive_up(-x) : positive_down(x); }
    static double up(double x) noexcept { return x < 0.0 ? -positive_down(-x) : positive_up(x); }

private:
    static double positive_down(double x) noexcept {
        double const y =
            mul_down(0.5, lower_at<simd::log1p_bounds>(div_down(2.0 * x, add_up(1.0, -x))));
        return y < x ? x : y;
    }
    static double positive_up(double x) noexcept {
        return mul_up(0.5, upper_at<simd::log1p_bounds>(div_up(2.0 * x, add_down(1.0, -x))));
    }
};

/// The angle of (x, y) for finite y > 0, x != 0: arctan(y/x), on the left pi less that of (-x, y).
struct atan2_at {
    static double down(double y, double x) noexcept {
        if (x > 0.0) return lower_at<simd::atan_bounds>(div_down(y, x));
        return add_down(0x1.921fb54442d18p+1, -upper_at<simd::atan_bounds>(div_up(y, -x)));
    }
    static double up(double y, double x) noexcept {
        if (x > 0.0) return upper_at<simd::atan_bounds>(div_up(y, x));
        return add_up(0x1.921fb54442d19p+1, -lower_at<simd::atan_bounds>(div_down(y, -x)));
    }
};

/// t^n rounded towards D, for t >= 0, n >= 1. The result for infinity is infinite.
template <direction D>
[[nodiscard]] double pown_at(double t, unsigned n) noexcept {
    if (n == 1 || is_zero(t) || is_infinite(t) || t == 1.0) return t;
    if (n == 2) return mul<D>(t, t);
    return n <= integers::most_whole ? integers::rounded_positive<D>(integers::whole_power<D>(t, n))
                                     : integers::power<D>(t, static_cast<double>(n));
}
/// t^-n rounded towards D, for t >= 0, n >= 1: full accuracy where t^n overflows, too.
template <direction D>
[[nodiscard]] double reciprocal_pown_at(double t, unsigned n) noexcept {
    constexpr bool up = D == direction::up;
    if (is_zero(t)) return std::numeric_limits<double>::infinity();
    if (is_infinite(t)) return 0.0;
    if (t == 1.0 || n == 1) return div<D>(1.0, t);
    if (n > integers::most_whole) return integers::power<D>(t, -static_cast<double>(n));
    constexpr direction other = up ? direction::down : direction::up;
    scaled_integer const p = integers::whole_power<other>(t, n);
    double const divisor = rounded<other>(false, {p.m, -63}); // in [1, 2]
    scaled_integer q = significand_of(div<D>(1.0, divisor));
    q.e -= p.e + 63;
    return integers::rounded_positive<D>(q);
}

/// x^y rounded towards D, for x > 0 other than 1, y != 0 finite.
template <direction D>
[[nodiscard]] double pow_at(double x, double y) noexcept {
    constexpr bool up = D == direction::up;
    if (!is_infinite(x)) return integers::power<D>(x, y);
    if (y < 0.0) return up ? std::numeric_limits<double>::denorm_min() : 0.0;
    return up ? x : std::numeric_limits<double>::max();
}

} // namespace SIVID_PACK_TARGET
} // namespace sivid::detail

#endif
