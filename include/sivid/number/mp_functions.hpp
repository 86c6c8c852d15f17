// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_MP_FUNCTIONS_HPP
#define SIVID_NUMBER_MP_FUNCTIONS_HPP

/// @file
/// Elementary functions for the vocabulary type whose bounds rest on MPFR's correct rounding instead
/// of sivid's own kernels, and which are therefore tight.
/// `proven_interval` brings them to code that is written for any interval type. One to two hundred
/// times slower. Needs mpfi, mpfr and gmp at link time.

#include <sivid/number/interval.hpp>
#include <sivid/number/interval_traits.hpp>
#include <sivid/number/mp_interval.hpp>
#include <sivid/number/traits_by_bounds.hpp>

#include <cstddef>

namespace sivid {

/// An `interval` whose elementary functions are tight.
struct proven_interval {
    interval bounds{0.0};
};

/// Arithmetic is the vocabulary type's, which is proven already. Elementary functions are those of
/// `mp_interval`: values in 40 digits are rounded outward and then outward to double, which is the
/// same as once outward to double; only negative powers take two roundings in 40 digits.
template <>
struct interval_traits<proven_interval> : traits_by_bounds<proven_interval> {
    using I = proven_interval;
    static I bounds(double lo, double hi) { return {sivid::detail::bounded(lo, hi)}; }
    static I empty() { return {sivid::detail::empty_interval()}; }
    static double lower(I const& a, std::size_t = 0) { return a.bounds.lower(); }
    static double upper(I const& a, std::size_t = 0) { return a.bounds.upper(); }
    static interval to_interval(I const& a) { return a.bounds; }

    static I exp(I const& a) { return out(mp::exp(in(a))); }
    static I expm1(I const& a) { return out(mp::expm1(in(a))); }
    static I log(I const& a, mask& cut) { return out(mp::log(in(a), cut)); }
    static I log1p(I const& a, mask& cut) { return out(mp::log1p(in(a), cut)); }
    static I sin(I const& a) { return out(mp::sin(in(a))); }
    static I cos(I const& a) { return out(mp::cos(in(a))); }
    static I tan(I const& a, mask& cut) { return out(mp::tan(in(a), cut)); }
    static I asin(I const& a, mask& cut) { return out(mp::asin(in(a), cut)); }
    static I acos(I const& a, mask& cut) { return out(mp::acos(in(a), cut)); }
    static I atan(I const& a) { return out(mp::atan(in(a))); }
    static I atan2(I const& y, I const& x, mask& cut) { return out(mp::atan2(in(y), in(x), cut)); }
    static I sinh(I const& a) { return out(mp::sinh(in(a))); }
    static I cosh(I const& a) { return out(mp::cosh(in(a))); }
    static I tanh(I const& a) { return out(mp::tanh(in(a))); }
    static I asinh(I const& a) { return out(mp::asinh(in(a))); }
    static I acosh(I const& a, mask& cut) { return out(mp::acosh(in(a), cut)); }
    static I atanh(I const& a, mask& cut) { return out(mp::atanh(in(a), cut)); }
    static I hypot(I const& a, I const& b) { return out(mp::hypot(in(a), in(b))); }
    static I pown(I const& a, int n, mask& cut) { return out(mp::pown(in(a), n, cut)); }
    static I pow(I const& a, I const& b, mask& cut) { return out(mp::pow(in(a), in(b), cut)); }

private:
    using mp = interval_traits<mp_interval>;
    static mp_interval in(I const& a) { return mp::bounds(a.bounds.lower(), a.bounds.upper()); }
    static I out(mp_interval const& y) { return bounds(mp::lower(y), mp::upper(y)); }
};

static_assert(interval_scalar<proven_interval>);

} // namespace sivid

#endif
