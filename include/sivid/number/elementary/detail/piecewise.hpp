// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_ELEMENTARY_DETAIL_PIECEWISE_HPP
#define SIVID_NUMBER_ELEMENTARY_DETAIL_PIECEWISE_HPP

/// @file
/// Functions made of pieces: abs, min, max, sign, saturate, deadband. All tight.

#include <sivid/number/interval.hpp>
#include <sivid/number/rounding.hpp>

namespace sivid {

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
