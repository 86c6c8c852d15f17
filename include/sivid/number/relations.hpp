// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_RELATIONS_HPP
#define SIVID_NUMBER_RELATIONS_HPP

/// @file
/// Order relations of IEEE 1788 between intervals. They are statements about all or some elements,
/// not an order: `!less(a, b)` does not mean `less(b, a)`.

#include <sivid/number/interval.hpp>

namespace sivid {

namespace detail {
inline bool below_or_both_infinite(double a, double b) noexcept {
    return a < b || (a == b && is_infinite(a));
}
} // namespace detail

/// Every element of a has one of b that is >= it, and every element of b one of a that is <= it.
inline bool less(interval const& a, interval const& b) noexcept {
    if (is_empty(a) || is_empty(b)) return is_empty(a) && is_empty(b);
    return a.lower() <= b.lower() && a.upper() <= b.upper();
}
/// As `less` with < in place of <=.
inline bool strict_less(interval const& a, interval const& b) noexcept {
    if (is_empty(a) || is_empty(b)) return is_empty(a) && is_empty(b);
    return detail::below_or_both_infinite(a.lower(), b.lower()) &&
           detail::below_or_both_infinite(a.upper(), b.upper());
}
/// Every element of a is <= every element of b.
inline bool precedes(interval const& a, interval const& b) noexcept {
    return is_empty(a) || is_empty(b) || a.upper() <= b.lower();
}
/// Every element of a is < every element of b.
inline bool strict_precedes(interval const& a, interval const& b) noexcept {
    return is_empty(a) || is_empty(b) || a.upper() < b.lower();
}

} // namespace sivid

#endif
