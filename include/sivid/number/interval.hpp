// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_INTERVAL_HPP
#define SIVID_NUMBER_INTERVAL_HPP

/// @file
/// The vocabulary type: Boost.Interval over double with a rounding policy that optimisers cannot
/// break, and the functions that read it.
///
/// A plain double stands for its exact value. The empty set has NaN bounds; an infinite bound means
/// unbounded, infinity itself is never a member.

#include <sivid/number/rounding.hpp>
#include <sivid/number/rounding/detail/opaque_rounding.hpp>
#include <sivid/number/rounding/detail/refused_flags.hpp>

#include <boost/numeric/interval/arith.hpp>
#include <boost/numeric/interval/checking.hpp>
#include <boost/numeric/interval/compare.hpp>
#include <boost/numeric/interval/interval.hpp>
#include <boost/numeric/interval/policies.hpp>
#include <boost/numeric/interval/rounding.hpp>
#include <boost/numeric/interval/utility.hpp>

#include <concepts>
#include <cstdint>
#include <limits>

namespace sivid {

/// The interval type that users see. `+ - * /` of Boost are sound on it; `interval_traits` is
/// tighter (division), faster, and the way by which the library computes.
using interval =
    boost::numeric::interval<double, boost::numeric::interval_lib::policies<
                                         boost::numeric::interval_lib::save_state<opaque_rounding>,
                                         boost::numeric::interval_lib::checking_base<double>>>;

namespace detail {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double greatest = std::numeric_limits<double>::max();
inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// [lo, hi] as given, unchecked.
[[gnu::always_inline]] inline interval unchecked_interval(double lo, double hi) noexcept {
    return interval{lo, hi, true};
}
[[gnu::always_inline]] inline interval empty_interval() noexcept {
    return unchecked_interval(not_a_number, not_a_number);
}
[[gnu::always_inline]] inline interval entire_interval() noexcept {
    return unchecked_interval(-infinity, infinity);
}
/// [lo, hi] of bounds that were computed outward. A bound that overflowed to the wrong infinity
/// stands for finite numbers beyond the greatest double.
inline interval bounded(double lo, double hi) noexcept {
    if (!(lo <= hi)) return empty_interval();
    if (lo == infinity) lo = greatest;
    if (hi == -infinity) hi = -greatest;
    return unchecked_interval(lo, hi);
}

/// The same interval, computed where this stands between changes of the control register.
[[gnu::always_inline]] inline interval pinned(interval const& x) noexcept {
    return unchecked_interval(pinned(x.lower()), pinned(x.upper()));
}

/// The rest of a computation in round-to-nearest, whatever the caller's mode; restored at the end.
using nearest_mode = with_rounding<direction::nearest>;

/// f(x...) in round-to-nearest, without FTZ and DAZ, whatever the caller's state. Comparisons
/// belong into f, too: under DAZ a subnormal number equals zero.
template <class F, class... X>
[[gnu::always_inline]] inline interval in_nearest_mode(F const& f, X const&... x) noexcept {
    nearest_mode const mode;
    return pinned(f(pinned(x)...));
}
/// The same for a function that says by its last argument whether its domain was cut.
template <class F, class... X>
[[gnu::always_inline]] inline interval in_nearest_mode_cut(bool& cut, F const& f,
                                                           X const&... x) noexcept {
    nearest_mode const mode;
    bool left = false;
    interval const y = pinned(f(pinned(x)..., left));
    if (pinned(std::uint64_t{left}) != 0) cut = true;
    return y;
}

} // namespace detail

// Reading. Bounds are exact; derived numbers are rounded to the safe side.
inline double lower(interval const& x) noexcept { return x.lower(); }
inline double upper(interval const& x) noexcept { return x.upper(); }
inline bool is_empty(interval const& x) noexcept { return !(x.lower() <= x.upper()); }
inline bool is_point(interval const& x) noexcept { return x.lower() == x.upper(); }
inline bool is_entire(interval const& x) noexcept {
    return x.lower() == -detail::infinity && x.upper() == detail::infinity;
}
/// Non-empty and bounded.
inline bool is_bounded(interval const& x) noexcept {
    return x.lower() > -detail::infinity && x.upper() < detail::infinity;
}

/// A finite number inside x: the nearest to the middle (0 for the whole line, the greatest finite
/// number for a half-line); NaN if x is empty.
inline double mid(interval const& x) noexcept {
    double const lo = x.lower(), hi = x.upper();
    if (is_empty(x)) return detail::not_a_number;
    if (lo == -detail::infinity) return hi == detail::infinity ? 0.0 : -detail::greatest;
    if (hi == detail::infinity) return detail::greatest;
    double const sum = detail::opaque(detail::opaque(lo) + detail::opaque(hi));
    double m = detail::is_infinite(sum) ? 0.5 * lo + 0.5 * hi : 0.5 * sum;
    m = m < lo ? lo : m;
    return m > hi ? hi : m;
}
/// The least double r with x inside [mid(x) - r, mid(x) + r].
inline double rad(interval const& x) noexcept {
    if (is_empty(x)) return detail::not_a_number;
    double const m = mid(x);
    double const below = detail::add_up(m, -x.lower()), above = detail::add_up(x.upper(), -m);
    return below > above ? below : above;
}
/// upper - lower, rounded up.
inline double width(interval const& x) noexcept {
    return is_empty(x) ? detail::not_a_number : detail::add_up(x.upper(), -x.lower());
}
/// The greatest |t| in x.
inline double mag(interval const& x) noexcept {
    double const a = x.lower() < 0.0 ? -x.lower() : x.lower();
    double const b = x.upper() < 0.0 ? -x.upper() : x.upper();
    return a > b ? a : b;
}
/// The least |t| in x.
inline double mig(interval const& x) noexcept {
    if (is_empty(x)) return detail::not_a_number;
    if (x.lower() > 0.0) return x.lower();
    return x.upper() < 0.0 ? -x.upper() : 0.0;
}

// Sets.
inline bool contains(interval const& x, double t) noexcept {
    return x.lower() <= t && t <= x.upper() && !detail::is_infinite(t);
}
/// Every element of a is in b; the empty set is in every set.
inline bool subset(interval const& a, interval const& b) noexcept {
    return is_empty(a) || (b.lower() <= a.lower() && a.upper() <= b.upper());
}
/// a lies in the topological interior of b.
inline bool interior(interval const& a, interval const& b) noexcept {
    if (is_empty(a)) return true;
    bool const below = b.lower() < a.lower() || b.lower() == -detail::infinity;
    bool const above = a.upper() < b.upper() || b.upper() == detail::infinity;
    return below && above && !is_empty(b);
}
inline bool disjoint(interval const& a, interval const& b) noexcept {
    return !(a.lower() <= b.upper() && b.lower() <= a.upper()) || is_empty(a) || is_empty(b);
}
/// The same set.
inline bool equal(interval const& a, interval const& b) noexcept {
    return (is_empty(a) && is_empty(b)) || (a.lower() == b.lower() && a.upper() == b.upper());
}
/// The least interval that contains both.
inline interval hull(interval const& a, interval const& b) noexcept {
    if (is_empty(a)) return b;
    if (is_empty(b)) return a;
    return detail::unchecked_interval(b.lower() < a.lower() ? b.lower() : a.lower(),
                                      b.upper() > a.upper() ? b.upper() : a.upper());
}
/// The common elements.
inline interval intersect(interval const& a, interval const& b) noexcept {
    if (disjoint(a, b)) return detail::empty_interval();
    return detail::unchecked_interval(b.lower() > a.lower() ? b.lower() : a.lower(),
                                      b.upper() < a.upper() ? b.upper() : a.upper());
}
// Comparisons are about all elements: true if certain, false if not (Boost's own throw where
// intervals overlap). `!(a < b)` does not mean `a >= b`; `a != b` means "not certainly equal". Sets
// are compared by `equal` and `subset`.
inline bool operator<(interval const& a, interval const& b) noexcept {
    return a.upper() < b.lower();
}
inline bool operator<=(interval const& a, interval const& b) noexcept {
    return a.upper() <= b.lower();
}
inline bool operator>(interval const& a, interval const& b) noexcept { return b < a; }
inline bool operator>=(interval const& a, interval const& b) noexcept { return b <= a; }
inline bool operator==(interval const& a, interval const& b) noexcept {
    return is_point(a) && a.lower() == b.lower() && a.lower() == b.upper();
}
inline bool operator!=(interval const& a, interval const& b) noexcept { return !(a == b); }

/// A rounded decimal such as 0.10 is not the decimal: write hull(0.10_dec, 0.12_dec), or
/// `interval_traits<interval>::bounds` for two exact doubles.
template <std::floating_point A, std::floating_point B>
interval hull(A, B) = delete;

// Boost's division asks whether the divisor contains zero before it sets the mode; under DAZ a
// subnormal divisor would be zero. The other operators of Boost do not depend on such questions.
// Templates on the policies: deduced, so that nothing is converted to an interval for them.
template <class P>
    requires std::same_as<boost::numeric::interval<double, P>, interval>
        boost::numeric::interval<double, P>
operator/(boost::numeric::interval<double, P> const& x,
          boost::numeric::interval<double, P> const& y) noexcept {
    return detail::in_nearest_mode(
        [](interval const& a, interval const& b) { return boost::numeric::operator/(a, b); }, x, y);
}
template <class P>
    requires std::same_as<boost::numeric::interval<double, P>, interval>
        boost::numeric::interval<double, P>
operator/(boost::numeric::interval<double, P> const& x, double y) noexcept {
    return x / interval{y};
}
template <class P>
    requires std::same_as<boost::numeric::interval<double, P>, interval>
        boost::numeric::interval<double, P>
operator/(double x, boost::numeric::interval<double, P> const& y) noexcept {
    return interval{x} / y;
}

namespace detail {
/// Whether a T stands for one exact number, which `interval{n, n}` or `enclose(n)` encloses.
template <class T>
inline constexpr bool is_exact = std::integral<T>;

/// The tightest interval that contains n, or the interval n.
template <class T>
interval exactly(T const& n) {
    if constexpr (std::integral<T>)
        return {n, n};
    else if constexpr (std::same_as<T, interval>)
        return n;
    else
        return enclose(n);
}
} // namespace detail

/// What has an exact meaning beside an interval: whole numbers, and decimals (decimal.hpp).
template <class T>
concept exact_operand = detail::is_exact<T>;

// Whole numbers beside intervals are exact (or enclosed above 2^53); Boost offers doubles only.
// Templates on the interval, since Boost's implicit constructor would let any type convert to it.
template <std::same_as<interval> I, exact_operand T>
I operator+(I const& x, T n) {
    return x + detail::exactly(n);
}
template <exact_operand T, std::same_as<interval> I>
I operator+(T n, I const& x) {
    return detail::exactly(n) + x;
}
template <std::same_as<interval> I, exact_operand T>
I operator-(I const& x, T n) {
    return x - detail::exactly(n);
}
template <exact_operand T, std::same_as<interval> I>
I operator-(T n, I const& x) {
    return detail::exactly(n) - x;
}
template <std::same_as<interval> I, exact_operand T>
I operator*(I const& x, T n) {
    return x * detail::exactly(n);
}
template <exact_operand T, std::same_as<interval> I>
I operator*(T n, I const& x) {
    return detail::exactly(n) * x;
}
template <std::same_as<interval> I, exact_operand T>
I operator/(I const& x, T n) {
    return x / detail::exactly(n);
}
template <exact_operand T, std::same_as<interval> I>
I operator/(T n, I const& x) {
    return detail::exactly(n) / x;
}

} // namespace sivid

/// An interval has no smallest or greatest value and no precision: algorithms that use such numbers
/// as thresholds for neglecting something get 0.
template <>
class std::numeric_limits<sivid::interval> {
public:
    static constexpr bool is_specialized = false, is_integer = false, is_signed = true,
                          is_exact = false;
    static constexpr bool is_iec559 = false, is_bounded = false, has_infinity = false;
    static constexpr bool has_quiet_NaN = false, has_signaling_NaN = false, is_modulo = false;
    static constexpr int digits = 53, digits10 = 15, max_digits10 = 17, radix = 2;
    static constexpr std::float_round_style round_style = std::round_indeterminate;
    static sivid::interval(min)() noexcept { return {}; }
    static sivid::interval(max)() noexcept { return {}; }
    static sivid::interval lowest() noexcept { return {}; }
    static sivid::interval epsilon() noexcept { return {}; }
    static sivid::interval round_error() noexcept { return {}; }
    static sivid::interval denorm_min() noexcept { return {}; }
    static sivid::interval infinity() noexcept { return {}; }
    // NOLINTNEXTLINE(readability-identifier-naming): the standard's name
    static sivid::interval quiet_NaN() noexcept { return {}; }
};

#endif
