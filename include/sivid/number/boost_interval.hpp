// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_BOOST_INTERVAL_HPP
#define SIVID_NUMBER_BOOST_INTERVAL_HPP

/// @file
/// `interval_traits` of Boost.Interval over double with policies of the user's own, and the refusal
/// of policies with which its operators prove nothing.
///
/// The traits compute by the vocabulary type, as tight as there, and use no operator of Boost. Code
/// of the user's own does: a set test that says `x * x` proves what the policies round. So a policy
/// that is not known to round outward does not compile.

#include <sivid/number/interval.hpp>
#include <sivid/number/traits_by_bounds.hpp>

#include <boost/numeric/interval/hw_rounding.hpp>

#include <cstddef>
#include <type_traits>

namespace sivid {

/// Whether the operators of Boost round outward with this policy in every expression that a
/// compiler may make of them. True for `save_state<opaque_rounding>`; for Boost's own policies
/// (`rounded_math<double>`, `save_state` of `rounded_arith_std` or `rounded_arith_opp`) only where
/// the compiler says by `__ROUNDING_MATH__` that it respects rounding modes: without
/// -frounding-math, g++ 12 -O3 makes 1/3 a point of them. Specialise it as true for a policy that
/// you vouch for.
template <class Rounding>
inline constexpr bool rounds_outward = false;

template <>
inline constexpr bool rounds_outward<boost::numeric::interval_lib::save_state<opaque_rounding>> =
    true;

#ifdef __ROUNDING_MATH__
template <>
inline constexpr bool rounds_outward<boost::numeric::interval_lib::rounded_math<double>> = true;
template <>
inline constexpr bool rounds_outward<boost::numeric::interval_lib::save_state<
    boost::numeric::interval_lib::rounded_arith_std<double>>> = true;
template <>
inline constexpr bool rounds_outward<boost::numeric::interval_lib::save_state<
    boost::numeric::interval_lib::rounded_arith_opp<double>>> = true;
#endif

namespace detail {

template <class Checking, class Own>
std::true_type
without_empty(boost::numeric::interval_lib::checking_no_empty<double, Checking, Own> const*);
std::false_type without_empty(void const*);

/// Whether a checking policy says that there is no empty set.
template <class Checking>
inline constexpr bool knows_no_empty =
    decltype(without_empty(static_cast<Checking const*>(nullptr)))::value;

} // namespace detail

/// Boost's interval over double. Empty is what has no member: NaN, or the lower bound above the
/// upper one, however the type came to it.
template <class Policies>
struct interval_traits<boost::numeric::interval<double, Policies>>
    : traits_by_bounds<boost::numeric::interval<double, Policies>> {
    using I = boost::numeric::interval<double, Policies>;

    static_assert(
        rounds_outward<typename Policies::rounding>,
        "sivid: the operators of this boost::numeric::interval are not known to round outward. Use "
        "the rounding policy boost::numeric::interval_lib::save_state<sivid::opaque_rounding> "
        "(change_rounding does that), or compile with g++ -frounding-math if it is Boost's own; "
        "vouch for one of your own by specialising sivid::rounds_outward");
    static_assert(
        !detail::knows_no_empty<typename Policies::checking>,
        "sivid: this boost::numeric::interval cannot be empty, but intersections are. Use the "
        "checking policy boost::numeric::interval_lib::checking_base<double> (change_checking "
        "does that)");

    static I bounds(double lo, double hi) {
        interval const x = sivid::detail::bounded(lo, hi);
        return I(x.lower(), x.upper(), true);
    }
    static I empty() { return I(detail::not_a_number, detail::not_a_number, true); }
    static double lower(I const& a, std::size_t = 0) {
        return sivid::detail::bounded(a.lower(), a.upper()).lower();
    }
    static double upper(I const& a, std::size_t = 0) {
        return sivid::detail::bounded(a.lower(), a.upper()).upper();
    }
};

} // namespace sivid

#endif
