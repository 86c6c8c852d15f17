// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_TRAITS_BY_BOUNDS_HPP
#define SIVID_NUMBER_TRAITS_BY_BOUNDS_HPP

/// @file
/// A complete `interval_traits` for a type of one's own from four functions: every operation goes
/// through the vocabulary type. What the type does better, its specialisation replaces.

#include <sivid/number/interval.hpp>
#include <sivid/number/interval_traits.hpp>

#include <cstddef>

namespace sivid {

/// Base of `interval_traits<I>`. The derived specialisation gives
///     static I bounds(double lo, double hi);   // contains [lo, hi]; empty for NaN or lo > hi
///     static I empty();
///     static double lower(I const&, std::size_t lane = 0), upper(I const&, std::size_t lane = 0);
/// with lower and upper outward, and NaN for both when empty. A value stands for all of
/// [lower, upper]: what a test says of it, it says of every real between the two.
template <class I>
struct traits_by_bounds {
    using mask = bool;
    static constexpr std::size_t lanes = 1;

    static I point(double t) { return from(detail::bounded(t, t)); }
    static I entire() { return from(detail::entire_interval()); }

    static double mid(I const& a, std::size_t = 0) { return sivid::mid(to(a)); }
    static double rad(I const& a, std::size_t = 0) { return sivid::rad(to(a)); }
    static double width(I const& a, std::size_t = 0) { return sivid::width(to(a)); }
    static double mag(I const& a, std::size_t = 0) { return sivid::mag(to(a)); }
    static double mig(I const& a, std::size_t = 0) { return sivid::mig(to(a)); }
    static bool is_empty(I const& a) { return sivid::is_empty(to(a)); }
    static bool is_point(I const& a) { return sivid::is_point(to(a)); }
    static bool contains(I const& a, double t) { return sivid::contains(to(a), t); }
    static bool subset(I const& a, I const& b) { return sivid::subset(to(a), to(b)); }
    static bool interior(I const& a, I const& b) { return sivid::interior(to(a), to(b)); }
    static bool disjoint(I const& a, I const& b) { return sivid::disjoint(to(a), to(b)); }
    static I hull(I const& a, I const& b) { return from(sivid::hull(to(a), to(b))); }
    static I intersect(I const& a, I const& b) { return from(sivid::intersect(to(a), to(b))); }

    static I neg(I const& a) { return from(by::neg(to(a))); }
    static I add(I const& a, I const& b) { return from(by::add(to(a), to(b))); }
    static I sub(I const& a, I const& b) { return from(by::sub(to(a), to(b))); }
    static I mul(I const& a, I const& b) { return from(by::mul(to(a), to(b))); }
    static I div(I const& a, I const& b, mask& cut) { return from(by::div(to(a), to(b), cut)); }
    static I sqr(I const& a) { return from(by::sqr(to(a))); }
    static I abs(I const& a) { return from(by::abs(to(a))); }
    static I min(I const& a, I const& b) { return from(by::min(to(a), to(b))); }
    static I max(I const& a, I const& b) { return from(by::max(to(a), to(b))); }
    static I hypot(I const& a, I const& b) { return from(by::hypot(to(a), to(b))); }

    static I sqrt(I const& a, mask& cut) { return from(by::sqrt(to(a), cut)); }
    static I pown(I const& a, int n, mask& cut) { return from(by::pown(to(a), n, cut)); }
    static I pow(I const& a, I const& b, mask& cut) { return from(by::pow(to(a), to(b), cut)); }
    static I exp(I const& a) { return from(by::exp(to(a))); }
    static I expm1(I const& a) { return from(by::expm1(to(a))); }
    static I log(I const& a, mask& cut) { return from(by::log(to(a), cut)); }
    static I log1p(I const& a, mask& cut) { return from(by::log1p(to(a), cut)); }
    static I sin(I const& a) { return from(by::sin(to(a))); }
    static I cos(I const& a) { return from(by::cos(to(a))); }
    static I tan(I const& a, mask& cut) { return from(by::tan(to(a), cut)); }
    static I asin(I const& a, mask& cut) { return from(by::asin(to(a), cut)); }
    static I acos(I const& a, mask& cut) { return from(by::acos(to(a), cut)); }
    static I atan(I const& a) { return from(by::atan(to(a))); }
    static I atan2(I const& y, I const& x, mask& cut) { return from(by::atan2(to(y), to(x), cut)); }
    static I sinh(I const& a) { return from(by::sinh(to(a))); }
    static I cosh(I const& a) { return from(by::cosh(to(a))); }
    static I tanh(I const& a) { return from(by::tanh(to(a))); }
    static I asinh(I const& a) { return from(by::asinh(to(a))); }
    static I acosh(I const& a, mask& cut) { return from(by::acosh(to(a), cut)); }
    static I atanh(I const& a, mask& cut) { return from(by::atanh(to(a), cut)); }

    static I sign(I const& a) { return from(by::sign(to(a))); }
    static I saturate(I const& a, I const& lo, I const& hi) {
        return from(by::saturate(to(a), to(lo), to(hi)));
    }
    static I deadband(I const& a, I const& half_width) {
        return from(by::deadband(to(a), to(half_width)));
    }

protected:
    using by = interval_traits<interval>;

    static interval to(I const& a) {
        return detail::bounded(interval_traits<I>::lower(a, 0), interval_traits<I>::upper(a, 0));
    }
    static I from(interval const& x) {
        return sivid::is_empty(x) ? interval_traits<I>::empty()
                                  : interval_traits<I>::bounds(x.lower(), x.upper());
    }
};

} // namespace sivid

#endif
