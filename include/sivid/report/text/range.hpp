// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_TEXT_RANGE_HPP
#define SIVID_REPORT_TEXT_RANGE_HPP

#include <sivid/number/interval.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace sivid::report {

/// Two end points as they are shown: [lo, hi]. Empty by default (lo > hi). The report only shows
/// numbers, it never computes with them, so a plain pair is enough; whoever fills it takes the
/// outward bounds of a proven interval.
struct range {
    double lo = std::numeric_limits<double>::infinity();
    double hi = -std::numeric_limits<double>::infinity();

    constexpr range() = default;
    constexpr range(double low, double high) : lo{low}, hi{high} {}
    /// The ends of an interval, as they are; of nothing an empty range.
    range(interval const& x) : lo{x.lower()}, hi{x.upper()} {}
    range(std::optional<interval> const& x) : range{x ? range{*x} : range{}} {}

    friend bool operator==(range const&, range const&) = default;
};

/// A point of a non-validated line.
struct point {
    double x = 0;
    double y = 0;
};

/// True for an empty range and for one with a NaN.
[[nodiscard]] inline bool is_empty(range const& r) { return !(r.lo <= r.hi); }

[[nodiscard]] inline bool is_finite(range const& r) {
    return !is_empty(r) && std::isfinite(r.lo) && std::isfinite(r.hi);
}

[[nodiscard]] inline bool is_finite(point const& p) {
    return std::isfinite(p.x) && std::isfinite(p.y);
}

/// hi - lo for drawing (rounded, not a bound); 0 when empty.
[[nodiscard]] inline double approximate_width(range const& r) {
    return is_empty(r) ? 0.0 : r.hi - r.lo;
}

[[nodiscard]] inline double approximate_middle(range const& r) { return r.lo / 2 + r.hi / 2; }

[[nodiscard]] inline range hull(range const& a, range const& b) {
    if (is_empty(a)) return b;
    if (is_empty(b)) return a;
    return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)};
}

/// The smallest range with a and the value; the value is ignored unless finite.
[[nodiscard]] inline range hull(range const& a, double value) {
    return std::isfinite(value) ? hull(a, range{value, value}) : a;
}

[[nodiscard]] inline range intersect(range const& a, range const& b) {
    return {std::max(a.lo, b.lo), std::min(a.hi, b.hi)};
}

/// The range widened by a share of its width on both sides (for drawing).
[[nodiscard]] inline range with_margin(range const& r, double share) {
    double const more = share * approximate_width(r);
    return {r.lo - more, r.hi + more};
}

} // namespace sivid::report

#endif
