// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_ELEMENTARY_DETAIL_HYPERBOLIC_HPP
#define SIVID_NUMBER_ELEMENTARY_DETAIL_HYPERBOLIC_HPP

/// @file
/// sinh, cosh, tanh and their inverses on intervals.

#include <sivid/number/elementary/detail/functions_at.hpp>
#include <sivid/number/elementary/exponential.hpp>
#include <sivid/number/interval.hpp>

namespace sivid {

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

/// \f$ \{\sinh t : t \in x\} \f$.  Max excess: `excess::sinh` floats a side.
inline interval sinh(interval const& x) noexcept {
    return detail::in_nearest_mode(
        [](interval const& t) {
            if (is_empty(t)) return t;
            interval const y = detail::increasing_odd<detail::sinh_at>(t);
            // |sinh t| >= |t|
            double const lo = t.lower() > 0.0 ? detail::at_least(y.lower(), t.lower()) : y.lower();
            double const hi = t.upper() < 0.0 ? detail::at_most(y.upper(), t.upper()) : y.upper();
            return detail::bounded(lo, hi);
        },
        x);
}

/// \f$ \{\cosh t : t \in x\} \f$.  Max excess: `excess::cosh` floats a side; cosh(0) = 1 exactly.
inline interval cosh(interval const& x) noexcept {
    return detail::in_nearest_mode(
        [](interval const& t) {
            if (is_empty(t)) return t;
            double const a = mig(t), b = mag(t);
            double const lo = detail::cosh_at::down(a);
            double const hi = detail::cosh_at::up(b);
            return detail::bounded(detail::at_least(lo, 1.0), b == 0.0 ? 1.0 : hi);
        },
        x);
}

/// \f$ \{\tanh t : t \in x\} \f$.  Max excess: `excess::tanh` floats a side; tanh(0) = 0 exactly.
inline interval tanh(interval const& x) noexcept {
    return detail::in_nearest_mode(
        [](interval const& t) {
            if (is_empty(t)) return t;
            interval const y = detail::increasing_odd<detail::tanh_at>(t);
            return detail::unchecked_interval(detail::at_least(y.lower(), -1.0),
                                              detail::at_most(y.upper(), 1.0));
        },
        x);
}

/// \f$ \{\mathrm{arsinh}\, t : t \in x\} \f$.  Max excess: `excess::asinh` floats a side.
inline interval asinh(interval const& x) noexcept {
    return detail::in_nearest_mode(
        [](interval const& t) {
            if (is_empty(t)) return t;
            return detail::increasing_odd<detail::asinh_at>(t);
        },
        x);
}

/// \f$ \{\mathrm{arcosh}\, t : t \in x, t \ge 1\} \f$; sets `cut` if x has elements < 1.
/// Max excess: `excess::acosh` floats a side.
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
/// Max excess: `excess::atanh` floats a side.
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

} // namespace sivid

#endif
