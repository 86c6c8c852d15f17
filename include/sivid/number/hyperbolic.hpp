// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_HYPERBOLIC_HPP
#define SIVID_NUMBER_HYPERBOLIC_HPP

/// @file
/// sinh, cosh, tanh and their inverses on intervals.

#include <sivid/number/excess.hpp>
#include <sivid/number/exponential.hpp>
#include <sivid/number/interval.hpp>
#include <sivid/number/rounding.hpp>

#include <cmath>

namespace sivid {

namespace detail {

inline constexpr auto library_sinh = [](double x) { return std::sinh(x); };
inline constexpr auto library_cosh = [](double x) { return std::cosh(x); };
inline constexpr auto library_tanh = [](double x) { return std::tanh(x); };
inline constexpr auto library_asinh = [](double x) { return std::asinh(x); };
inline constexpr auto library_acosh = [](double x) { return std::acosh(x); };
inline constexpr auto library_atanh = [](double x) { return std::atanh(x); };

/// An increasing odd function: the sign of the argument is kept, 0 is exact.
/// @given  round-to-nearest is set
template <class Function>
interval increasing_odd(Function const& f, int excess_floats, interval const& x) noexcept {
    double const a = x.lower(), b = x.upper();
    double lo = a == 0.0 ? 0.0 : step(library(f, a), -excess_floats);
    double hi = b == 0.0 ? 0.0 : step(library(f, b), excess_floats);
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
            interval const y = detail::increasing_odd(detail::library_sinh, excess::sinh, t);
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
            double const lo = detail::step(detail::library(detail::library_cosh, a), -excess::cosh);
            double const hi = detail::step(detail::library(detail::library_cosh, b), excess::cosh);
            return detail::bounded(detail::at_least(lo, 1.0), b == 0.0 ? 1.0 : hi);
        },
        x);
}

/// \f$ \{\tanh t : t \in x\} \f$.  Max excess: `excess::tanh` floats a side; tanh(0) = 0 exactly.
inline interval tanh(interval const& x) noexcept {
    return detail::in_nearest_mode(
        [](interval const& t) {
            if (is_empty(t)) return t;
            interval const y = detail::increasing_odd(detail::library_tanh, excess::tanh, t);
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
            return detail::increasing_odd(detail::library_asinh, excess::asinh, t);
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
            double const lo =
                detail::step(detail::library(detail::library_acosh, a), -excess::acosh);
            double const hi =
                detail::step(detail::library(detail::library_acosh, b), excess::acosh);
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
            interval const y = detail::increasing_odd(detail::library_atanh, excess::atanh, inside);
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
