// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_ELEMENTARY_DETAIL_TRIGONOMETRIC_HPP
#define SIVID_NUMBER_ELEMENTARY_DETAIL_TRIGONOMETRIC_HPP

/// @file
/// sin, cos, tan of an interval. Which extrema or poles lie between the ends is decided in
/// integers.

#include <sivid/number/elementary/detail/functions_at.hpp>
#include <sivid/number/elementary/detail/wide_integer.hpp>
#include <sivid/number/elementary/exponential.hpp>
#include <sivid/number/interval.hpp>
#include <sivid/number/rounding.hpp>

#include <cstdint>

namespace sivid {

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

/// Bounds at both ends, extended to the extrema that may lie between.
/// `phase`: quarter turns of the maximum; the minimum is half a turn away.
/// @given  round-to-nearest is set
template <class Function>
interval wave(interval const& x, int phase) noexcept {
    bool has_maximum = false, has_minimum = false;
    if (!is_point(x)) {
        arc const between = arc_of(x);
        if (between.everything) return unchecked_interval(-1.0, 1.0);
        has_maximum = may_contain_turn(between.lo, between.hi, phase, 2);
        has_minimum = may_contain_turn(between.lo, between.hi, phase + 2, 2);
        if (has_maximum && has_minimum) return unchecked_interval(-1.0, 1.0);
    }
    bounds_at const first = Function::both(x.lower());
    bounds_at const second = is_point(x) ? first : Function::both(x.upper());
    double const lo = first.lower < second.lower ? first.lower : second.lower;
    double const hi = first.upper < second.upper ? second.upper : first.upper;
    return unchecked_interval(has_minimum ? -1.0 : at_least(lo, -1.0),
                              has_maximum ? 1.0 : at_most(hi, 1.0));
}

} // namespace detail

/// \f$ \{\sin t : t \in x\} \f$.  Max excess: `excess::sin` floats a side; sin(0) = 0 exactly.
inline interval sin(interval const& x) noexcept {
    return detail::in_nearest_mode(
        [](interval const& t) {
            if (is_empty(t)) return t;
            interval const y = detail::wave<detail::sin_at>(t, 1);
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

/// \f$ \{\cos t : t \in x\} \f$.  Max excess: `excess::cos` floats a side; cos(0) = 1 exactly.
inline interval cos(interval const& x) noexcept {
    return detail::in_nearest_mode(
        [](interval const& t) {
            if (is_empty(t)) return t;
            if (t.lower() == 0.0 && t.upper() == 0.0) return detail::unchecked_interval(1.0, 1.0);
            return detail::wave<detail::cos_at>(t, 0);
        },
        x);
}

/// \f$ \{\tan t : t \in x,\ t \ne (k + 1/2)\pi\} \f$; sets `cut` if a pole may lie in x (no double
/// is a pole).  Max excess: `excess::tan` floats a side; tan(0) = 0 exactly.
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
            double const lo = detail::tan_at::down(t.lower()), hi = detail::tan_at::up(t.upper());
            return detail::unchecked_interval(t.lower() == 0.0 ? 0.0 : lo,
                                              t.upper() == 0.0 ? 0.0 : hi);
        },
        x);
}

/// A cut of the domain is silent.
inline interval tan(interval const& x) noexcept {
    bool cut = false;
    return tan(x, cut);
}

} // namespace sivid

#endif
