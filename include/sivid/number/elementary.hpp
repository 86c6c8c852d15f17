// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_ELEMENTARY_HPP
#define SIVID_NUMBER_ELEMENTARY_HPP

/// @file
/// All elementary functions of the vocabulary type. Each has the meaning of IEEE 1788: the hull of
/// the values on the part of the argument where the function is defined. The forms with a last
/// argument `bool& cut` set it if some part was left out; a proof that needs the function
/// everywhere must look. "Max excess" counts the floats by which a bound may lie beyond the
/// tightest one.

#include <sivid/number/elementary/detail/functions_at.hpp>
#include <sivid/number/elementary/detail/integers.hpp>
#include <sivid/number/interval.hpp>
#include <sivid/number/rounding.hpp>

#include <concepts>
#include <cstdint>
#include <utility>

namespace sivid {

// ---- exp, expm1, log, log1p: increasing

namespace detail {

constexpr double at_least(double x, double bound) noexcept { return x < bound ? bound : x; }
constexpr double at_most(double x, double bound) noexcept { return x > bound ? bound : x; }
constexpr double clamp(double x, double lo, double hi) noexcept {
    return x < lo ? lo : x > hi ? hi : x;
}

/// An increasing function that is defined everywhere, from its bounds at the ends.
template <class Bounds>
[[nodiscard]] interval increasing(interval const& x) noexcept {
    return in_nearest_mode(
        [](interval const& t) {
            if (is_empty(t)) return t;
            bounds_at const y = at_ends<Bounds>(t.lower(), t.upper());
            return unchecked_interval(y.lower, y.upper);
        },
        x);
}
/// An increasing function that is defined beyond `from` alone, where it is minus infinite.
template <class Bounds>
[[nodiscard]] interval increasing_beyond(double from, interval const& x, bool& cut) noexcept {
    return in_nearest_mode_cut(
        cut,
        [from](interval const& t, bool& left) {
            if (is_empty(t)) return t;
            if (t.lower() <= from) left = true;
            if (t.upper() <= from) return empty_interval();
            bounds_at const y = at_ends<Bounds>(t.lower(), t.upper());
            return unchecked_interval(y.lower, y.upper);
        },
        x);
}

} // namespace detail

/// \f$ \{e^t : t \in x\} \f$.  Max excess: 3 floats a side; exp(0) = 1 exactly.
inline interval exp(interval const& x) noexcept { return detail::increasing<simd::exp_bounds>(x); }

/// \f$ \{e^t - 1 : t \in x\} \f$.  Max excess: 8 floats a side.
inline interval expm1(interval const& x) noexcept {
    return detail::increasing<simd::expm1_bounds>(x);
}

/// \f$ \{\ln t : t \in x, t > 0\} \f$; sets `cut` if x has elements <= 0.
/// Max excess: 4 floats a side; log(1) = 0 exactly.
inline interval log(interval const& x, bool& cut) noexcept {
    return detail::increasing_beyond<simd::log_bounds>(0.0, x, cut);
}

/// \f$ \{\ln(1+t) : t \in x, t > -1\} \f$; sets `cut` if x has elements <= -1.
/// Max excess: 4 floats a side.
inline interval log1p(interval const& x, bool& cut) noexcept {
    return detail::increasing_beyond<simd::log1p_bounds>(-1.0, x, cut);
}

// A cut of the domain is silent in the forms without the flag.
inline interval log(interval const& x) noexcept {
    bool cut = false;
    return log(x, cut);
}
inline interval log1p(interval const& x) noexcept {
    bool cut = false;
    return log1p(x, cut);
}

// ---- sin, cos, tan: which extrema or poles lie between the ends is decided in integers

namespace detail {

/// Fixed point with 64 fractional bits.
inline constexpr wide_integer fixed_one = wide_integer{1} << 64;

/// Error bound of `quarter_turns`: two truncations, scaled by at most 2^4, and one more truncation.
inline constexpr wide_integer turns_error = 64;

/// x 2/pi in fixed point, |result - exact| <= `turns_error`.
///   2/pi = 0.a2f9836e4e441529 fc2757d1f534ddc0 db... (hexadecimal); its first 128 fractional bits
///   are A + B 2^-64 in units of 2^-64. With x = m 2^e, m < 2^53: m A + floor(m B 2^-64) is below
///   2^117 and short by less than 2 (the truncated B and the dropped bits of 2/pi); then shifted by
///   e <= 4.
/// @given  |x| < 2^57
inline wide_integer quarter_turns(double x) noexcept {
    constexpr std::uint64_t a = 0xa2f9836e4e441529u, b = 0xfc2757d1f534ddc0u;
    std::uint64_t const raw = bits(x) & ~sign_bit;
    auto const exponent = static_cast<int>(raw >> 52);
    constexpr std::uint64_t hidden = std::uint64_t{1} << 52;
    wide_integer const m =
        static_cast<wide_integer>(exponent == 0 ? raw : (raw & (hidden - 1)) | hidden);
    wide_integer const turns = m * a + ((m * b) >> 64);
    int const e = (exponent == 0 ? 1 : exponent) - 1075;
    wide_integer const scaled = e >= 0 ? turns << e : e > -128 ? turns >> -e : 0;
    return (bits(x) & sign_bit) != 0 ? -scaled : scaled;
}

/// Whether [lo, hi] may contain k with k = phase modulo period (1, 2 or 4 quarter turns, as a power
/// of two); true also if the reduction cannot tell.
inline bool may_contain_turn(wide_integer lo, wide_integer hi, int phase,
                             int log2_period) noexcept {
    wide_integer const offset = phase * fixed_one;
    int const shift = 64 + log2_period;
    // Arithmetic shifts: floor(hi) and ceil(lo) in periods.
    wide_integer const last = (hi + turns_error - offset) >> shift;
    wide_integer const first = -((-(lo - turns_error - offset)) >> shift);
    return first <= last;
}

/// Where a bounded interval lies on the circle.
struct arc {
    wide_integer lo, hi;
    bool everything; ///< longer than a turn
};
inline arc arc_of(interval const& x) noexcept {
    // Beyond 2^57 neighbouring doubles are more than a turn apart.
    constexpr double limit = 0x1p57;
    if (!(x.lower() > -limit && x.upper() < limit)) return {0, 0, true};
    wide_integer const lo = quarter_turns(x.lower()), hi = quarter_turns(x.upper());
    return {lo, hi, hi - lo >= 4 * fixed_one};
}

/// sin(t + Shift pi/2) on x: bounds at both ends, extended to the extrema that may lie between.
/// @given  round-to-nearest is set
template <int Shift>
interval wave(interval const& x) noexcept {
    bool has_maximum = false, has_minimum = false;
    if (!is_point(x)) {
        arc const between = arc_of(x);
        if (between.everything) return unchecked_interval(-1.0, 1.0);
        has_maximum = may_contain_turn(between.lo, between.hi, 1 - Shift, 2);
        has_minimum = may_contain_turn(between.lo, between.hi, 3 - Shift, 2);
        if (has_maximum && has_minimum) return unchecked_interval(-1.0, 1.0);
    }
    bounds_at const y = waves_at<Shift>(x.lower(), x.upper());
    return unchecked_interval(has_minimum ? -1.0 : at_least(y.lower, -1.0),
                              has_maximum ? 1.0 : at_most(y.upper, 1.0));
}

} // namespace detail

/// \f$ \{\sin t : t \in x\} \f$.  Max excess: 3 floats a side; sin(0) = 0 exactly.
inline interval sin(interval const& x) noexcept {
    return detail::in_nearest_mode(
        [](interval const& t) {
            if (is_empty(t)) return t;
            interval const y = detail::wave<0>(t);
            // |sin t| <= |t|
            if (t.lower() >= 0.0 && t.upper() <= 1.5)
                return detail::unchecked_interval(detail::at_least(y.lower(), 0.0),
                                                  detail::at_most(y.upper(), t.upper()));
            if (t.upper() <= 0.0 && t.lower() >= -1.5)
                return detail::unchecked_interval(detail::at_least(y.lower(), t.lower()),
                                                  detail::at_most(y.upper(), 0.0));
            return y;
        },
        x);
}

/// \f$ \{\cos t : t \in x\} \f$.  Max excess: 3 floats a side; cos(0) = 1 exactly.
inline interval cos(interval const& x) noexcept {
    return detail::in_nearest_mode(
        [](interval const& t) {
            if (is_empty(t)) return t;
            if (t.lower() == 0.0 && t.upper() == 0.0) return detail::unchecked_interval(1.0, 1.0);
            return detail::wave<1>(t);
        },
        x);
}

/// \f$ \{\tan t : t \in x,\ t \ne (k + 1/2)\pi\} \f$; sets `cut` if a pole may lie in x (no double
/// is a pole).  Max excess: 4 floats a side; tan(0) = 0 exactly.
inline interval tan(interval const& x, bool& cut) noexcept {
    return detail::in_nearest_mode_cut(
        cut,
        [](interval const& t, bool& left) {
            if (is_empty(t)) return t;
            if (!is_point(t)) {
                detail::arc const between = detail::arc_of(t);
                if (between.everything || detail::may_contain_turn(between.lo, between.hi, 1, 1)) {
                    left = true;
                    return detail::entire_interval();
                }
            }
            // No pole between the ends: increasing.
            detail::bounds_at const y = detail::at_ends<detail::tan_bounds>(t.lower(), t.upper());
            return detail::unchecked_interval(y.lower, y.upper);
        },
        x);
}

/// A cut of the domain is silent.
inline interval tan(interval const& x) noexcept {
    bool cut = false;
    return tan(x, cut);
}

// ---- sqr, sqrt, pown, pow, hypot

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

/// t^n on x, n >= 1.
inline interval positive_pown(interval const& x, unsigned n) noexcept {
    constexpr direction down = direction::down, up = direction::up;
    if (n % 2 == 0) return unchecked_interval(pown_at<down>(mig(x), n), pown_at<up>(mag(x), n));
    double const lo = x.lower(), hi = x.upper();
    return unchecked_interval(lo < 0.0 ? -pown_at<up>(-lo, n) : pown_at<down>(lo, n),
                              hi < 0.0 ? -pown_at<down>(-hi, n) : pown_at<up>(hi, n));
}

/// t^-n on x, n >= 1, t != 0.
inline interval negative_pown(interval const& x, unsigned n) noexcept {
    constexpr direction down = direction::down, up = direction::up;
    double const lo = x.lower(), hi = x.upper();
    if (is_zero(lo) && is_zero(hi)) return empty_interval();
    if (n % 2 == 0)
        return unchecked_interval(reciprocal_pown_at<down>(mag(x), n),
                                  reciprocal_pown_at<up>(mig(x), n));
    if (lo < 0.0 && hi > 0.0) return entire_interval();
    if (lo >= 0.0)
        return unchecked_interval(reciprocal_pown_at<down>(hi, n), reciprocal_pown_at<up>(lo, n));
    return unchecked_interval(-reciprocal_pown_at<up>(-hi, n), -reciprocal_pown_at<down>(-lo, n));
}

/// The arithmetic of the traits: it does not look for FTZ and DAZ.
inline interval pown(interval const& x, int n, bool& cut) noexcept {
    if (is_empty(x)) return x;
    if (n == 0) return unchecked_interval(1.0, 1.0);
    if (n > 0) return positive_pown(x, static_cast<unsigned>(n));
    if (x.lower() <= 0.0 && x.upper() >= 0.0) cut = true;
    return negative_pown(x, 0u - static_cast<unsigned>(n));
}

} // namespace detail

/// \f$ \{t^n : t \in x\} \f$ for an integer n, with \f$ t^0 = 1 \f$; sets `cut` if n < 0 and 0 is
/// in x. Max excess: 0 for n = 0, 1, 2, -1, else 3 floats a side.
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
    return {pow_at<direction::down>(s, t), pow_at<direction::up>(s, t)};
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
            if (is_point(y)) break;
        }
        if (is_point(x)) break;
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
/// the domain the limits are taken. Max excess: 3 floats a side.
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

// ---- asin, acos, atan, atan2

namespace detail {

// Neighbouring doubles around pi/2 and pi: pi = 3.243f6a8885a308d313...p0 (hexadecimal).
inline constexpr double half_pi_down = 0x1.921fb54442d18p+0, half_pi_up = 0x1.921fb54442d19p+0;
inline constexpr double pi_down = 0x1.921fb54442d18p+1, pi_up = 0x1.921fb54442d19p+1;

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

/// The part in [-1, 1]; sets `left` if there is more.
inline interval within_one(interval const& t, bool& left) noexcept {
    if (is_empty(t)) return t;
    if (t.lower() < -1.0 || t.upper() > 1.0) left = true;
    if (t.upper() < -1.0 || t.lower() > 1.0) return empty_interval();
    return unchecked_interval(at_least(t.lower(), -1.0), at_most(t.upper(), 1.0));
}

} // namespace detail

/// \f$ \{\arcsin t : t \in x \cap [-1, 1]\} \f$; sets `cut` if x leaves [-1, 1].
/// Max excess: 3 floats a side.
inline interval asin(interval const& x, bool& cut) noexcept {
    return detail::in_nearest_mode_cut(
        cut,
        [](interval const& t, bool& left) {
            interval const part = detail::within_one(t, left);
            if (is_empty(part)) return part;
            detail::bounds_at const y =
                detail::at_ends<simd::asin_bounds>(part.lower(), part.upper());
            constexpr double bound = detail::half_pi_up;
            return detail::unchecked_interval(detail::clamp(y.lower, -bound, bound),
                                              detail::clamp(y.upper, -bound, bound));
        },
        x);
}

/// \f$ \{\arccos t : t \in x \cap [-1, 1]\} \f$; sets `cut` if x leaves [-1, 1].
/// Max excess: 3 floats a side.
inline interval acos(interval const& x, bool& cut) noexcept {
    return detail::in_nearest_mode_cut(
        cut,
        [](interval const& t, bool& left) {
            interval const part = detail::within_one(t, left);
            if (is_empty(part)) return part;
            detail::bounds_at const y =
                detail::at_ends<simd::acos_bounds>(part.upper(), part.lower());
            return detail::unchecked_interval(detail::clamp(y.lower, 0.0, detail::pi_up),
                                              detail::clamp(y.upper, 0.0, detail::pi_up));
        },
        x);
}

/// \f$ \{\arctan t : t \in x\} \f$.  Max excess: 3 floats a side; atan(0) = 0 exactly.
inline interval atan(interval const& x) noexcept {
    return detail::in_nearest_mode(
        [](interval const& t) {
            if (is_empty(t)) return t;
            detail::bounds_at const y = detail::at_ends<simd::atan_bounds>(t.lower(), t.upper());
            constexpr double bound = detail::half_pi_up;
            return detail::unchecked_interval(detail::clamp(y.lower, -bound, bound),
                                              detail::clamp(y.upper, -bound, bound));
        },
        x);
}

/// \f$ \{\mathrm{atan2}(s, t) : s \in y, t \in x, (s, t) \ne (0, 0)\} \f$ in \f$ (-\pi, \pi] \f$;
/// sets `cut` if the origin is in the box. Across the negative half of the x axis the function
/// jumps: the result is then the hull [-pi, pi].  Max excess: 6 floats a side.
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

// ---- sinh, cosh, tanh and their inverses

namespace detail {

/// An increasing odd function: the sign of the argument is kept, 0 is exact.
/// @given  round-to-nearest is set
template <class Function>
interval increasing_odd(interval const& x) noexcept {
    double const a = x.lower(), b = x.upper();
    double lo = a == 0.0 ? 0.0 : Function::down(a);
    double hi = b == 0.0 ? 0.0 : Function::up(b);
    if (a >= 0.0) lo = at_least(lo, 0.0);
    if (b <= 0.0) hi = at_most(hi, 0.0);
    return unchecked_interval(lo, hi);
}

} // namespace detail

/// \f$ \{\sinh t : t \in x\} \f$.  Max excess: 5 floats a side.
inline interval sinh(interval const& x) noexcept {
    return detail::increasing<simd::sinh_bounds>(x);
}

/// \f$ \{\cosh t : t \in x\} \f$.  Max excess: 3 floats a side; cosh(0) = 1 exactly.
inline interval cosh(interval const& x) noexcept {
    return detail::in_nearest_mode(
        [](interval const& t) {
            if (is_empty(t)) return t;
            detail::bounds_at const y = detail::at_ends<simd::cosh_bounds>(mig(t), mag(t));
            return detail::unchecked_interval(y.lower, y.upper);
        },
        x);
}

/// \f$ \{\tanh t : t \in x\} \f$.  Max excess: 5 floats a side; tanh(0) = 0 exactly.
inline interval tanh(interval const& x) noexcept {
    return detail::increasing<simd::tanh_bounds>(x);
}

/// \f$ \{\mathrm{arsinh}\, t : t \in x\} \f$.  Max excess: 8 floats a side.
inline interval asinh(interval const& x) noexcept {
    return detail::in_nearest_mode(
        [](interval const& t) {
            if (is_empty(t)) return t;
            return detail::increasing_odd<detail::asinh_at>(t);
        },
        x);
}

/// \f$ \{\mathrm{arcosh}\, t : t \in x, t \ge 1\} \f$; sets `cut` if x has elements < 1.
/// Max excess: 8 floats a side.
inline interval acosh(interval const& x, bool& cut) noexcept {
    return detail::in_nearest_mode_cut(
        cut,
        [](interval const& t, bool& left) {
            if (is_empty(t)) return t;
            if (t.lower() < 1.0) left = true;
            if (t.upper() < 1.0) return detail::empty_interval();
            double const a = t.lower() < 1.0 ? 1.0 : t.lower(), b = t.upper();
            double const lo = detail::acosh_at::down(a);
            double const hi = detail::acosh_at::up(b);
            return detail::unchecked_interval(detail::at_least(lo, 0.0), b == 1.0 ? 0.0 : hi);
        },
        x);
}

/// \f$ \{\mathrm{artanh}\, t : t \in x, |t| < 1\} \f$; sets `cut` if x leaves (-1, 1).
/// Max excess: 8 floats a side.
inline interval atanh(interval const& x, bool& cut) noexcept {
    return detail::in_nearest_mode_cut(
        cut,
        [](interval const& t, bool& left) {
            if (is_empty(t)) return t;
            double const a = t.lower(), b = t.upper();
            if (a <= -1.0 || b >= 1.0) left = true;
            if (b <= -1.0 || a >= 1.0) return detail::empty_interval();
            interval const inside =
                detail::unchecked_interval(a <= -1.0 ? 0.0 : a, b >= 1.0 ? 0.0 : b);
            interval const y = detail::increasing_odd<detail::atanh_at>(inside);
            return detail::unchecked_interval(a <= -1.0 ? -detail::infinity : y.lower(),
                                              b >= 1.0 ? detail::infinity : y.upper());
        },
        x);
}

// A cut of the domain is silent in the forms without the flag.
inline interval acosh(interval const& x) noexcept {
    bool cut = false;
    return acosh(x, cut);
}
inline interval atanh(interval const& x) noexcept {
    bool cut = false;
    return atanh(x, cut);
}

// ---- Functions made of pieces: abs, min, max, sign, saturate, deadband. All tight.

/// \f$ \{|t| : t \in x\} \f$
inline interval abs(interval const& x) noexcept {
    return detail::unchecked_interval(mig(x), mag(x));
}

/// \f$ \{\min(s, t) : s \in x, t \in y\} \f$
inline interval min(interval const& x, interval const& y) noexcept {
    if (is_empty(x) || is_empty(y)) return detail::empty_interval();
    return detail::unchecked_interval(y.lower() < x.lower() ? y.lower() : x.lower(),
                                      y.upper() < x.upper() ? y.upper() : x.upper());
}

/// \f$ \{\max(s, t) : s \in x, t \in y\} \f$
inline interval max(interval const& x, interval const& y) noexcept {
    if (is_empty(x) || is_empty(y)) return detail::empty_interval();
    return detail::unchecked_interval(y.lower() > x.lower() ? y.lower() : x.lower(),
                                      y.upper() > x.upper() ? y.upper() : x.upper());
}

/// \f$ \{\mathrm{sign}\, t : t \in x\} \f$ with sign 0 = 0.
inline interval sign(interval const& x) noexcept {
    if (is_empty(x)) return x;
    auto const of = [](double t) { return t > 0.0 ? 1.0 : t < 0.0 ? -1.0 : 0.0; };
    return detail::unchecked_interval(of(x.lower()), of(x.upper()));
}

/// \f$ \{\min(\max(t, l), h) : t \in x, l \in lo, h \in hi\} \f$: x limited to [lo, hi].
inline interval saturate(interval const& x, interval const& lo, interval const& hi) noexcept {
    return min(max(x, lo), hi);
}

/// \f$ \{\max(t - w, 0) + \min(t + w, 0) : t \in x, w \in W, w \ge 0\} \f$: x with a dead band of
/// half width w around zero. Negative widths do not exist; empty if W has no other.
inline interval deadband(interval const& x, interval const& half_width) noexcept {
    if (is_empty(x) || !(half_width.upper() >= 0.0)) return detail::empty_interval();
    double const least = half_width.lower() > 0.0 ? half_width.lower() : 0.0;
    double const most = half_width.upper();
    // Increasing in t; a wider band brings the result nearer to zero.
    auto const bound = [](double t, double w_positive, double w_negative, auto add) {
        if (t > 0.0) {
            if (w_positive == detail::infinity) return 0.0;
            double const y = add(t, -w_positive);
            return y > 0.0 ? y : 0.0;
        }
        if (w_negative == detail::infinity) return 0.0;
        double const y = add(t, w_negative);
        return y < 0.0 ? y : 0.0;
    };
    return detail::unchecked_interval(
        bound(x.lower(), most, least, [](double a, double b) { return detail::add_down(a, b); }),
        bound(x.upper(), least, most, [](double a, double b) { return detail::add_up(a, b); }));
}

} // namespace sivid

#endif
