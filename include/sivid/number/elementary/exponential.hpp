// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_ELEMENTARY_EXPONENTIAL_HPP
#define SIVID_NUMBER_ELEMENTARY_EXPONENTIAL_HPP

/// @file
/// exp, expm1, log, log1p of an interval. All are increasing: the bounds come from the ends.

#include <sivid/number/elementary/detail/functions_at.hpp>
#include <sivid/number/interval.hpp>

namespace sivid {

namespace detail {

constexpr double at_least(double x, double bound) noexcept { return x < bound ? bound : x; }
constexpr double at_most(double x, double bound) noexcept { return x > bound ? bound : x; }

inline double exp_down(double x) noexcept {
    if (x == 0.0) return 1.0;
    double const y = exp_at::down(x);
    return at_least(y, x > 0.0 ? 1.0 : 0.0);
}
inline double exp_up(double x) noexcept {
    if (x == 0.0) return 1.0;
    double const y = exp_at::up(x);
    return x < 0.0 ? at_most(y, 1.0) : y;
}
// expm1(x) >= x everywhere; expm1(x) > -1.
inline double expm1_down(double x) noexcept {
    if (x == 0.0) return 0.0;
    return at_least(at_least(expm1_at::down(x), -1.0), x);
}
inline double expm1_up(double x) noexcept {
    if (x == 0.0) return 0.0;
    double const y = expm1_at::up(x);
    return x < 0.0 ? at_most(y, 0.0) : y;
}
inline double log_down(double x) noexcept {
    if (x <= 0.0) return -infinity;
    if (x == 1.0) return 0.0;
    double const y = log_at::down(x);
    return x > 1.0 ? at_least(y, 0.0) : y;
}
inline double log_up(double x) noexcept {
    if (x == infinity) return infinity;
    if (x == 1.0) return 0.0;
    double const y = log_at::up(x);
    return x < 1.0 ? at_most(y, 0.0) : y;
}
inline double log1p_down(double x) noexcept {
    if (x <= -1.0) return -infinity;
    if (x == 0.0) return 0.0;
    double const y = log1p_at::down(x);
    return x > 0.0 ? at_least(y, 0.0) : y;
}
// log1p(x) <= x everywhere.
inline double log1p_up(double x) noexcept {
    if (x == infinity) return infinity;
    if (x == 0.0) return 0.0;
    return at_most(log1p_at::up(x), x);
}

} // namespace detail

/// \f$ \{e^t : t \in x\} \f$.  Max excess: `excess::exp` floats a side; exp(0) = 1 exactly.
inline interval exp(interval const& x) noexcept {
    return detail::in_nearest_mode(
        [](interval const& t) {
            if (is_empty(t)) return t;
            return detail::unchecked_interval(detail::exp_down(t.lower()),
                                              detail::exp_up(t.upper()));
        },
        x);
}

/// \f$ \{e^t - 1 : t \in x\} \f$.  Max excess: `excess::expm1` floats a side.
inline interval expm1(interval const& x) noexcept {
    return detail::in_nearest_mode(
        [](interval const& t) {
            if (is_empty(t)) return t;
            return detail::unchecked_interval(detail::expm1_down(t.lower()),
                                              detail::expm1_up(t.upper()));
        },
        x);
}

/// \f$ \{\ln t : t \in x, t > 0\} \f$; sets `cut` if x has elements <= 0.
/// Max excess: `excess::log` floats a side; log(1) = 0 exactly.
inline interval log(interval const& x, bool& cut) noexcept {
    return detail::in_nearest_mode_cut(
        cut,
        [](interval const& t, bool& left) {
            if (is_empty(t)) return t;
            if (t.lower() <= 0.0) left = true;
            if (t.upper() <= 0.0) return detail::empty_interval();
            return detail::unchecked_interval(detail::log_down(t.lower()),
                                              detail::log_up(t.upper()));
        },
        x);
}

/// \f$ \{\ln(1+t) : t \in x, t > -1\} \f$; sets `cut` if x has elements <= -1.
/// Max excess: `excess::log1p` floats a side.
inline interval log1p(interval const& x, bool& cut) noexcept {
    return detail::in_nearest_mode_cut(
        cut,
        [](interval const& t, bool& left) {
            if (is_empty(t)) return t;
            if (t.lower() <= -1.0) left = true;
            if (t.upper() <= -1.0) return detail::empty_interval();
            return detail::unchecked_interval(detail::log1p_down(t.lower()),
                                              detail::log1p_up(t.upper()));
        },
        x);
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

} // namespace sivid

#endif
