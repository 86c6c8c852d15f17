// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_CANCELLATION_HPP
#define SIVID_NUMBER_CANCELLATION_HPP

/// @file
/// The inverse of interval addition, as IEEE 1788 has it: `cancel_minus(x + y, y)` is x again,
/// where
/// `(x + y) - y` is wider.

#include <sivid/number/arithmetic.hpp>
#include <sivid/number/interval.hpp>
#include <sivid/number/rounding.hpp>

namespace sivid {

namespace detail {

/// a - b as an unevaluated sum s + e, exact unless s overflows.
/// @given  round-to-nearest is set
struct exact_difference {
    double s, e;
    exact_difference(double a, double b) noexcept : s{pinned(pinned(a) - pinned(b))} {
        double const c = pinned(s - a);
        e = pinned(pinned(a - pinned(s - c)) - pinned(b + c));
    }
};

/// a - b <= c - d, exactly.
/// @given  finite arguments
inline bool difference_at_most(double a, double b, double c, double d) noexcept {
    nearest_mode const mode;
    exact_difference left{a, b}, right{c, d};
    if (is_infinite(left.s) || is_infinite(right.s)) {
        // Operands whose difference overflows are at least 2^970: their quarters are exact. What
        // the quarters of the other pair lose cannot lift them to the quarter of an overflow.
        left = {a / 4.0, b / 4.0};
        right = {c / 4.0, d / 4.0};
    }
    return left.s < right.s || (left.s == right.s && left.e <= right.e);
}

} // namespace detail

/// The tightest z with y + z containing x: \f$ [\underline x - \underline y, \overline x -
/// \overline y] \f$ if y is not wider than x, else the whole line, as for unbounded arguments.
inline interval cancel_minus(interval const& x, interval const& y) noexcept {
    if (is_empty(x) && (is_empty(y) || is_bounded(y))) return x;
    if (is_empty(x) || is_empty(y) || !is_bounded(x) || !is_bounded(y) ||
        !detail::difference_at_most(x.lower(), y.lower(), x.upper(), y.upper()))
        return detail::entire_interval();
    return detail::unchecked_interval(detail::add_down(x.lower(), -y.lower()),
                                      detail::add_up(x.upper(), -y.upper()));
}

/// `cancel_minus(x, -y)`.
inline interval cancel_plus(interval const& x, interval const& y) noexcept {
    return cancel_minus(x, detail::neg(y));
}

} // namespace sivid

#endif
