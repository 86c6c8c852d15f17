// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_ELEMENTARY_DETAIL_INVERSE_TRIGONOMETRIC_HPP
#define SIVID_NUMBER_ELEMENTARY_DETAIL_INVERSE_TRIGONOMETRIC_HPP

/// @file
/// asin, acos, atan, atan2 of intervals.

#include <sivid/number/arithmetic.hpp>
#include <sivid/number/elementary/detail/functions_at.hpp>
#include <sivid/number/elementary/exponential.hpp>
#include <sivid/number/interval.hpp>
#include <sivid/number/rounding.hpp>

namespace sivid {

namespace detail {

// Neighbouring doubles around pi/2 and pi: pi = 3.243f6a8885a308d313...p0 (hexadecimal).
inline constexpr double half_pi_down = 0x1.921fb54442d18p+0, half_pi_up = 0x1.921fb54442d19p+0;
inline constexpr double pi_down = 0x1.921fb54442d18p+1, pi_up = 0x1.921fb54442d19p+1;

constexpr double clamp(double x, double lo, double hi) noexcept {
    return x < lo ? lo : x > hi ? hi : x;
}

/// Angle of (x, y), y >= 0, (x, y) not the origin, at most one of them infinite; rounded towards D.
/// @given  round-to-nearest is set
template <direction D>
double upper_half_angle(double y, double x) noexcept {
    constexpr bool up = D == direction::up;
    if (is_zero(y)) return x > 0.0 ? 0.0 : up ? pi_up : pi_down;
    if (is_zero(x) || is_infinite(y)) return up ? half_pi_up : half_pi_down;
    if (is_infinite(x)) return x > 0.0 ? 0.0 : up ? pi_up : pi_down;
    double const angle = up ? atan2_at::up(y, x) : atan2_at::down(y, x);
    return x > 0.0 ? clamp(angle, 0.0, half_pi_up) : clamp(angle, half_pi_down, pi_up);
}

/// atan2 on y >= 0 without the origin, y not inside {0} when x is {0}.
inline interval upper_half_atan2(interval const& y, interval const& x) noexcept {
    double const xl = x.lower(), xu = x.upper(), yl = y.lower(), yu = y.upper();
    if (is_zero(yu)) { // a piece of the axis
        return unchecked_interval(xu > 0.0 ? 0.0 : pi_down, xl < 0.0 ? pi_up : 0.0);
    }
    // The angle decreases with x; it grows with y on the right, and falls with y on the left.
    double lo, hi;
    if (xu > 0.0) {
        lo = upper_half_angle<direction::down>(yl, xu);
    } else {
        lo = upper_half_angle<direction::down>(yu, xu);
    }
    if (xl < 0.0) {
        hi = upper_half_angle<direction::up>(yl, xl);
    } else {
        hi = upper_half_angle<direction::up>(yu, xl);
    }
    return unchecked_interval(lo, hi);
}

/// atan2 as below.
/// @given  round-to-nearest is set
inline interval nearest_atan2(interval const& y, interval const& x, bool& cut) noexcept {
    if (is_empty(x) || is_empty(y)) return empty_interval();
    double const xl = x.lower(), xu = x.upper(), yl = y.lower(), yu = y.upper();
    bool const x_has_zero = xl <= 0.0 && xu >= 0.0;
    if (x_has_zero && yl <= 0.0 && yu >= 0.0) cut = true;
    if (xl == 0.0 && xu == 0.0 && yl == 0.0 && yu == 0.0) return empty_interval();
    if (yl >= 0.0) return upper_half_atan2(y, x);
    if (xl < 0.0 && yu >= 0.0) return unchecked_interval(-pi_up, pi_up);
    if (yu <= 0.0) return neg(upper_half_atan2(neg(y), x));
    // The right half-plane, both sides of the axis.
    double const lo = -upper_half_angle<direction::up>(-yl, xl);
    double const hi = upper_half_angle<direction::up>(yu, xl);
    return unchecked_interval(lo, hi);
}

} // namespace detail

/// \f$ \{\arcsin t : t \in x \cap [-1, 1]\} \f$; sets `cut` if x leaves [-1, 1].
/// Max excess: `excess::asin` floats a side.
inline interval asin(interval const& x, bool& cut) noexcept {
    return detail::in_nearest_mode_cut(
        cut,
        [](interval const& t, bool& left) {
            if (is_empty(t)) return t;
            if (t.lower() < -1.0 || t.upper() > 1.0) left = true;
            if (t.upper() < -1.0 || t.lower() > 1.0) return detail::empty_interval();
            double const a = detail::at_least(t.lower(), -1.0), b = detail::at_most(t.upper(), 1.0);
            double const lo = detail::asin_at::down(a);
            double const hi = detail::asin_at::up(b);
            constexpr double bound = detail::half_pi_up;
            return detail::unchecked_interval(a == 0.0 ? 0.0 : detail::clamp(lo, -bound, bound),
                                              b == 0.0 ? 0.0 : detail::clamp(hi, -bound, bound));
        },
        x);
}

/// \f$ \{\arccos t : t \in x \cap [-1, 1]\} \f$; sets `cut` if x leaves [-1, 1].
/// Max excess: `excess::acos` floats a side.
inline interval acos(interval const& x, bool& cut) noexcept {
    return detail::in_nearest_mode_cut(
        cut,
        [](interval const& t, bool& left) {
            if (is_empty(t)) return t;
            if (t.lower() < -1.0 || t.upper() > 1.0) left = true;
            if (t.upper() < -1.0 || t.lower() > 1.0) return detail::empty_interval();
            double const a = detail::at_least(t.lower(), -1.0), b = detail::at_most(t.upper(), 1.0);
            double const lo = detail::acos_at::down(b);
            double const hi = detail::acos_at::up(a);
            return detail::unchecked_interval(
                b == 1.0 ? 0.0 : detail::clamp(lo, 0.0, detail::pi_up),
                a == 1.0 ? 0.0 : detail::clamp(hi, 0.0, detail::pi_up));
        },
        x);
}

/// \f$ \{\arctan t : t \in x\} \f$.  Max excess: `excess::atan` floats a side; atan(0) = 0 exactly.
inline interval atan(interval const& x) noexcept {
    return detail::in_nearest_mode(
        [](interval const& t) {
            if (is_empty(t)) return t;
            double const a = t.lower(), b = t.upper();
            double const lo = detail::atan_at::down(a);
            double const hi = detail::atan_at::up(b);
            constexpr double bound = detail::half_pi_up;
            return detail::unchecked_interval(a == 0.0 ? 0.0 : detail::clamp(lo, -bound, bound),
                                              b == 0.0 ? 0.0 : detail::clamp(hi, -bound, bound));
        },
        x);
}

/// \f$ \{\mathrm{atan2}(s, t) : s \in y, t \in x, (s, t) \ne (0, 0)\} \f$ in \f$ (-\pi, \pi] \f$;
/// sets `cut` if the origin is in the box. Across the negative half of the x axis the function
/// jumps: the result is then the hull [-pi, pi].  Max excess: `excess::atan2` floats a side.
inline interval atan2(interval const& y, interval const& x, bool& cut) noexcept {
    return detail::in_nearest_mode_cut(cut, detail::nearest_atan2, y, x);
}

// A cut of the domain is silent in the forms without the flag.
inline interval asin(interval const& x) noexcept {
    bool cut = false;
    return asin(x, cut);
}
inline interval acos(interval const& x) noexcept {
    bool cut = false;
    return acos(x, cut);
}
inline interval atan2(interval const& y, interval const& x) noexcept {
    bool cut = false;
    return atan2(y, x, cut);
}

} // namespace sivid

#endif
