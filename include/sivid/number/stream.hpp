// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_STREAM_HPP
#define SIVID_NUMBER_STREAM_HPP

/// @file
/// Intervals and decimals to streams.

#include <sivid/number/decimal_output.hpp>
#include <sivid/number/interval.hpp>

#include <concepts>
#include <ostream>

namespace sivid {

/// Writes "[lo, hi]" outward with the shortest bounds; the width of the stream applies to the whole
/// text, its precision does not apply (see `to_string(x, digits)`).
///   A template, because anything converts to Boost's interval: nothing else is written as one.
template <std::same_as<interval> Interval>
std::ostream& operator<<(std::ostream& out, Interval const& x) {
    return out << to_string(x);
}

/// Writes the decimal as it was written.
inline std::ostream& operator<<(std::ostream& out, decimal d) {
    return out << (d.negative ? "-" : "") << d.view();
}

} // namespace sivid

#endif
