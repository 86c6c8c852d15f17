// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_MP_FUNCTIONS_HPP
#define SIVID_NUMBER_MP_FUNCTIONS_HPP

/// @file
/// The proven path for the vocabulary type: elementary functions whose bounds rest on MPFR's
/// correct rounding instead of tested bounds of the C library, and which are therefore tight.
/// `proven::exp` and so on take and return `interval`; `proven_interval` brings them to code that
/// is written for any interval type. One to two hundred times slower. Needs mpfi, mpfr and gmp at
/// link time.

#include <sivid/number/interval.hpp>
#include <sivid/number/interval_traits.hpp>
#include <sivid/number/mp_interval.hpp>
#include <sivid/number/traits_by_bounds.hpp>

#include <cstddef>

namespace sivid {

/// Tight enclosures of the elementary functions over intervals of doubles. Values in 40 digits are
/// rounded outward and then outward to double, which is the same as once outward to double; only
/// negative powers take two roundings in 40 digits.
namespace proven {

namespace detail {
using mp = interval_traits<mp_interval>;
inline mp_interval in(interval const& x) { return mp::bounds(x.lower(), x.upper()); }
inline interval out(mp_interval const& y) {
    return mp::is_empty(y) ? sivid::detail::empty_interval() : mp::to_interval(y);
}
} // namespace detail

inline interval exp(interval const& x) { return detail::out(detail::mp::exp(detail::in(x))); }
inline interval expm1(interval const& x) { return detail::out(detail::mp::expm1(detail::in(x))); }
inline interval sin(interval const& x) { return detail::out(detail::mp::sin(detail::in(x))); }
inline interval cos(interval const& x) { return detail::out(detail::mp::cos(detail::in(x))); }
inline interval atan(interval const& x) { return detail::out(detail::mp::atan(detail::in(x))); }
inline interval sinh(interval const& x) { return detail::out(detail::mp::sinh(detail::in(x))); }
inline interval cosh(interval const& x) { return detail::out(detail::mp::cosh(detail::in(x))); }
inline interval tanh(interval const& x) { return detail::out(detail::mp::tanh(detail::in(x))); }
inline interval asinh(interval const& x) { return detail::out(detail::mp::asinh(detail::in(x))); }
inline interval hypot(interval const& x, interval const& y) {
    return detail::out(detail::mp::hypot(detail::in(x), detail::in(y)));
}

// With a domain that may be cut: `cut` is set, never cleared.
inline interval log(interval const& x, bool& cut) {
    return detail::out(detail::mp::log(detail::in(x), cut));
}
inline interval log1p(interval const& x, bool& cut) {
    return detail::out(detail::mp::log1p(detail::in(x), cut));
}
inline interval tan(interval const& x, bool& cut) {
    return detail::out(detail::mp::tan(detail::in(x), cut));
}
inline interval asin(interval const& x, bool& cut) {
    return detail::out(detail::mp::asin(detail::in(x), cut));
}
inline interval acos(interval const& x, bool& cut) {
    return detail::out(detail::mp::acos(detail::in(x), cut));
}
inline interval acosh(interval const& x, bool& cut) {
    return detail::out(detail::mp::acosh(detail::in(x), cut));
}
inline interval atanh(interval const& x, bool& cut) {
    return detail::out(detail::mp::atanh(detail::in(x), cut));
}
inline interval atan2(interval const& y, interval const& x, bool& cut) {
    return detail::out(detail::mp::atan2(detail::in(y), detail::in(x), cut));
}
inline interval pown(interval const& x, int n, bool& cut) {
    return detail::out(detail::mp::pown(detail::in(x), n, cut));
}
inline interval pow(interval const& x, interval const& y, bool& cut) {
    return detail::out(detail::mp::pow(detail::in(x), detail::in(y), cut));
}

// A cut is silent in the forms without the flag.
inline interval log(interval const& x) {
    bool cut = false;
    return proven::log(x, cut);
}
inline interval log1p(interval const& x) {
    bool cut = false;
    return proven::log1p(x, cut);
}
inline interval tan(interval const& x) {
    bool cut = false;
    return proven::tan(x, cut);
}
inline interval asin(interval const& x) {
    bool cut = false;
    return proven::asin(x, cut);
}
inline interval acos(interval const& x) {
    bool cut = false;
    return proven::acos(x, cut);
}
inline interval acosh(interval const& x) {
    bool cut = false;
    return proven::acosh(x, cut);
}
inline interval atanh(interval const& x) {
    bool cut = false;
    return proven::atanh(x, cut);
}
inline interval atan2(interval const& y, interval const& x) {
    bool cut = false;
    return proven::atan2(y, x, cut);
}
inline interval pown(interval const& x, int n) {
    bool cut = false;
    return proven::pown(x, n, cut);
}
inline interval pow(interval const& x, interval const& y) {
    bool cut = false;
    return proven::pow(x, y, cut);
}

} // namespace proven

/// An `interval` whose elementary functions are those of `proven`.
struct proven_interval {
    interval bounds{0.0};
};

/// Arithmetic is the vocabulary type's, which is proven already.
template <>
struct interval_traits<proven_interval> : traits_by_bounds<proven_interval> {
    using I = proven_interval;
    static I bounds(double lo, double hi) { return {sivid::detail::bounded(lo, hi)}; }
    static I empty() { return {sivid::detail::empty_interval()}; }
    static double lower(I const& a, std::size_t = 0) { return a.bounds.lower(); }
    static double upper(I const& a, std::size_t = 0) { return a.bounds.upper(); }
    static interval to_interval(I const& a) { return a.bounds; }

    static I exp(I const& a) { return {proven::exp(a.bounds)}; }
    static I expm1(I const& a) { return {proven::expm1(a.bounds)}; }
    static I log(I const& a, mask& cut) { return {proven::log(a.bounds, cut)}; }
    static I log1p(I const& a, mask& cut) { return {proven::log1p(a.bounds, cut)}; }
    static I sin(I const& a) { return {proven::sin(a.bounds)}; }
    static I cos(I const& a) { return {proven::cos(a.bounds)}; }
    static I tan(I const& a, mask& cut) { return {proven::tan(a.bounds, cut)}; }
    static I asin(I const& a, mask& cut) { return {proven::asin(a.bounds, cut)}; }
    static I acos(I const& a, mask& cut) { return {proven::acos(a.bounds, cut)}; }
    static I atan(I const& a) { return {proven::atan(a.bounds)}; }
    static I atan2(I const& y, I const& x, mask& cut) {
        return {proven::atan2(y.bounds, x.bounds, cut)};
    }
    static I sinh(I const& a) { return {proven::sinh(a.bounds)}; }
    static I cosh(I const& a) { return {proven::cosh(a.bounds)}; }
    static I tanh(I const& a) { return {proven::tanh(a.bounds)}; }
    static I asinh(I const& a) { return {proven::asinh(a.bounds)}; }
    static I acosh(I const& a, mask& cut) { return {proven::acosh(a.bounds, cut)}; }
    static I atanh(I const& a, mask& cut) { return {proven::atanh(a.bounds, cut)}; }
    static I hypot(I const& a, I const& b) { return {proven::hypot(a.bounds, b.bounds)}; }
    static I pown(I const& a, int n, mask& cut) { return {proven::pown(a.bounds, n, cut)}; }
    static I pow(I const& a, I const& b, mask& cut) {
        return {proven::pow(a.bounds, b.bounds, cut)};
    }
};

static_assert(interval_scalar<proven_interval>);

} // namespace sivid

#endif
