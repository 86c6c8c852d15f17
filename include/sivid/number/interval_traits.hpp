// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_INTERVAL_TRAITS_HPP
#define SIVID_NUMBER_INTERVAL_TRAITS_HPP

/// @file
/// The one customisation point of interval types, its concept, and the vocabulary type's model of
/// it.
///
/// A type plugs in by specialising `interval_traits`. Everything is static. A type with bounds that
/// are doubles, or can be given as such, derives its specialisation from `traits_by_bounds` and
/// replaces what it does better.

#include <sivid/number/elementary.hpp>
#include <sivid/number/interval.hpp>

#include <concepts>
#include <cstddef>

namespace sivid {

template <class I>
struct interval_traits;

/// I has a complete `interval_traits`: what models are made of. Every operation encloses; those
/// with a mask set it (|=) where the function is not defined on the whole argument, and never clear
/// it.
/// (`interval` and types that derive from `traits_by_bounds` have all functions of IEEE 1788.)
template <class I>
concept interval_scalar = std::copyable<I> &&
    std::default_initializable<typename interval_traits<I>::mask> &&
    requires(I const& a, I const& b, double t, int n, typename interval_traits<I>::mask& cut) {
    { interval_traits<I>::lanes } -> std::convertible_to<std::size_t>;
    { interval_traits<I>::point(t) } -> std::same_as<I>;
    { interval_traits<I>::bounds(t, t) } -> std::same_as<I>;
    { interval_traits<I>::empty() } -> std::same_as<I>;
    { interval_traits<I>::entire() } -> std::same_as<I>;
    { interval_traits<I>::lower(a, std::size_t{}) } -> std::same_as<double>;
    { interval_traits<I>::upper(a, std::size_t{}) } -> std::same_as<double>;
    { interval_traits<I>::hull(a, b) } -> std::same_as<I>;
    { interval_traits<I>::intersect(a, b) } -> std::same_as<I>;
    { interval_traits<I>::neg(a) } -> std::same_as<I>;
    { interval_traits<I>::add(a, b) } -> std::same_as<I>;
    { interval_traits<I>::sub(a, b) } -> std::same_as<I>;
    { interval_traits<I>::mul(a, b) } -> std::same_as<I>;
    { interval_traits<I>::div(a, b, cut) } -> std::same_as<I>;
    { interval_traits<I>::sqr(a) } -> std::same_as<I>;
    { interval_traits<I>::abs(a) } -> std::same_as<I>;
    { interval_traits<I>::min(a, b) } -> std::same_as<I>;
    { interval_traits<I>::max(a, b) } -> std::same_as<I>;
    { interval_traits<I>::sqrt(a, cut) } -> std::same_as<I>;
    { interval_traits<I>::pown(a, n, cut) } -> std::same_as<I>;
    { interval_traits<I>::exp(a) } -> std::same_as<I>;
    { interval_traits<I>::log(a, cut) } -> std::same_as<I>;
    { interval_traits<I>::sin(a) } -> std::same_as<I>;
    { interval_traits<I>::cos(a) } -> std::same_as<I>;
    { interval_traits<I>::tan(a, cut) } -> std::same_as<I>;
    { interval_traits<I>::atan(a) } -> std::same_as<I>;
    { interval_traits<I>::tanh(a) } -> std::same_as<I>;
    { interval_traits<I>::sign(a) } -> std::same_as<I>;
};

/// The vocabulary type: tight for + - * / sqr sqrt min max hull intersect; elementary functions are
/// proved, and a few floats wide. Independent of the caller's rounding mode.
template <>
struct interval_traits<interval> {
    using mask = bool;
    static constexpr std::size_t lanes = 1;

    // Making.
    static interval point(double t) noexcept { return detail::bounded(t, t); }
    /// NaN or lo > hi gives the empty set.
    static interval bounds(double lo, double hi) noexcept { return detail::bounded(lo, hi); }
    static interval empty() noexcept { return detail::empty_interval(); }
    static interval entire() noexcept { return detail::entire_interval(); }

    // Reading.
    static double lower(interval const& a, std::size_t = 0) noexcept { return a.lower(); }
    static double upper(interval const& a, std::size_t = 0) noexcept { return a.upper(); }
    static double mid(interval const& a, std::size_t = 0) noexcept { return sivid::mid(a); }
    static double rad(interval const& a, std::size_t = 0) noexcept { return sivid::rad(a); }
    static double width(interval const& a, std::size_t = 0) noexcept { return sivid::width(a); }
    static double mag(interval const& a, std::size_t = 0) noexcept { return sivid::mag(a); }
    static double mig(interval const& a, std::size_t = 0) noexcept { return sivid::mig(a); }
    static bool is_empty(interval const& a) noexcept { return sivid::is_empty(a); }
    static bool is_point(interval const& a) noexcept { return sivid::is_point(a); }
    static bool contains(interval const& a, double t) noexcept { return sivid::contains(a, t); }

    // Sets.
    static bool subset(interval const& a, interval const& b) noexcept {
        return sivid::subset(a, b);
    }
    static bool interior(interval const& a, interval const& b) noexcept {
        return sivid::interior(a, b);
    }
    static bool disjoint(interval const& a, interval const& b) noexcept {
        return sivid::disjoint(a, b);
    }
    static interval hull(interval const& a, interval const& b) noexcept {
        return sivid::hull(a, b);
    }
    static interval intersect(interval const& a, interval const& b) noexcept {
        return sivid::intersect(a, b);
    }

    // Arithmetic.
    static interval neg(interval const& a) noexcept { return detail::neg(a); }
    static interval add(interval const& a, interval const& b) noexcept { return detail::add(a, b); }
    static interval sub(interval const& a, interval const& b) noexcept { return detail::sub(a, b); }
    static interval mul(interval const& a, interval const& b) noexcept { return detail::mul(a, b); }
    static interval div(interval const& a, interval const& b, mask& undefined) noexcept {
        return detail::div(a, b, undefined);
    }
    static interval sqr(interval const& a) noexcept { return detail::sqr(a); }
    static interval abs(interval const& a) noexcept { return sivid::abs(a); }
    static interval min(interval const& a, interval const& b) noexcept { return sivid::min(a, b); }
    static interval max(interval const& a, interval const& b) noexcept { return sivid::max(a, b); }
    static interval hypot(interval const& a, interval const& b) noexcept {
        return sivid::hypot(a, b);
    }

    // Elementary functions.
    static interval sqrt(interval const& a, mask& undefined) noexcept {
        return detail::sqrt(a, undefined);
    }
    static interval pown(interval const& a, int n, mask& undefined) noexcept {
        return detail::pown(a, n, undefined);
    }
    static interval pow(interval const& a, interval const& b, mask& undefined) noexcept {
        return sivid::pow(a, b, undefined);
    }
    static interval exp(interval const& a) noexcept { return sivid::exp(a); }
    static interval expm1(interval const& a) noexcept { return sivid::expm1(a); }
    static interval log(interval const& a, mask& undefined) noexcept {
        return sivid::log(a, undefined);
    }
    static interval log1p(interval const& a, mask& undefined) noexcept {
        return sivid::log1p(a, undefined);
    }
    static interval sin(interval const& a) noexcept { return sivid::sin(a); }
    static interval cos(interval const& a) noexcept { return sivid::cos(a); }
    static interval tan(interval const& a, mask& undefined) noexcept {
        return sivid::tan(a, undefined);
    }
    static interval asin(interval const& a, mask& undefined) noexcept {
        return sivid::asin(a, undefined);
    }
    static interval acos(interval const& a, mask& undefined) noexcept {
        return sivid::acos(a, undefined);
    }
    static interval atan(interval const& a) noexcept { return sivid::atan(a); }
    static interval atan2(interval const& y, interval const& x, mask& undefined) noexcept {
        return sivid::atan2(y, x, undefined);
    }
    static interval sinh(interval const& a) noexcept { return sivid::sinh(a); }
    static interval cosh(interval const& a) noexcept { return sivid::cosh(a); }
    static interval tanh(interval const& a) noexcept { return sivid::tanh(a); }
    static interval asinh(interval const& a) noexcept { return sivid::asinh(a); }
    static interval acosh(interval const& a, mask& undefined) noexcept {
        return sivid::acosh(a, undefined);
    }
    static interval atanh(interval const& a, mask& undefined) noexcept {
        return sivid::atanh(a, undefined);
    }

    // Functions made of pieces.
    static interval sign(interval const& a) noexcept { return sivid::sign(a); }
    static interval saturate(interval const& a, interval const& lo, interval const& hi) noexcept {
        return sivid::saturate(a, lo, hi);
    }
    static interval deadband(interval const& a, interval const& half_width) noexcept {
        return sivid::deadband(a, half_width);
    }
};

static_assert(interval_scalar<interval>);

} // namespace sivid

namespace sivid::number_detail {

/// \f$ \{1 - \tanh^2 t : t \in x\} \f$. The difference is sharp over wide ranges, but far from 0,
/// where tanh is 1 up to a rounding, all that is left of it is that rounding. There
/// \f$ 4 e^{-2|t|} / (1 + e^{-2|t|})^2 \f$ keeps its digits: coefficients of series are slopes
/// times powers of the argument's own rate, and those may be large.
template <interval_scalar I>
[[nodiscard]] I tanh_slope(I const& x) {
    using traits = interval_traits<I>;
    typename traits::mask never{}; // the divisor is at least 1
    I const one = traits::point(1.0);
    I const e = traits::exp(traits::mul(traits::point(-2.0), traits::abs(x)));
    I const far =
        traits::div(traits::mul(traits::point(4.0), e), traits::sqr(traits::add(one, e)), never);
    return traits::intersect(traits::sub(one, traits::sqr(traits::tanh(x))), far);
}

} // namespace sivid::number_detail

#endif
