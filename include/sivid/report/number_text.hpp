// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_NUMBER_TEXT_HPP
#define SIVID_REPORT_NUMBER_TEXT_HPP

#include <sivid/compiled.hpp>
#include <sivid/number/decimal.hpp>
#include <sivid/number/interval.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

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

// Directed rounding of a double to a multiple of a power of ten, on its exact decimal expansion,
// digit by digit: independent of the rounding mode.

enum class rounding { down, nearest, up };

/// sign * digits * 10^exponent with an integer `digits`: a decimal number, exact.
struct scaled_decimal {
    bool negative = false;
    std::string digits = "0";
    int exponent = 0;
};

namespace detail {

inline constexpr std::string_view minus_sign = "\xE2\x88\x92";

/// Position of the leading digit: |x| = d.ddd * 10^result (0 for zero).
SIVID_DECL int leading_exponent(double x);

SIVID_DECL std::string superscript(int value);

} // namespace detail

/// " x 10^e" in typographic form.
[[nodiscard]] SIVID_DECL std::string power_text(int exponent);

/// Rounds a finite double to a multiple of 10^quantum in the given direction.
/// @guarantee  down: result <= x, up: result >= x, as real numbers; the error is below 10^quantum.
[[nodiscard]] SIVID_DECL scaled_decimal round_decimal(double x, int quantum, rounding way);

/// Writes a scaled decimal without an exponent, e.g. "-0.0120".
[[nodiscard]] SIVID_DECL std::string plain_text(scaled_decimal const& d);

/// Text made safe as XML or HTML content and inside a quoted attribute: markup characters become
/// entities, everything that is not valid text becomes U+FFFD.
/// @guarantee  the result has no '<', '>', '"', ''' and no '&' but that of an entity, and is valid
///             UTF-8 without control characters.
[[nodiscard]] SIVID_DECL std::string escape(std::string_view text);

/// A rough width of the text in a sans-serif font of the given size, for laying out labels.
[[nodiscard]] SIVID_DECL double approximate_text_width(std::string_view text, double size);

/// The text cut to a number of code points, with an ellipsis when something was cut.
[[nodiscard]] SIVID_DECL std::string shorten(std::string_view text, std::size_t longest);

// Numbers as a reader sees them. Proven bounds are rounded outward, so that the printed interval
// contains the binary one; intervals all of whose points have a proven property inward. Decimals
// read as the user gave them (`given_text`) are printed as given.

/// How an outward text is written: `significant` digits of the width (of the value for a single
/// bound), and a shift by powers of ten, exact, so that 2 prints percent.
struct number_format {
    int significant = 3;
    int shift = 0;
};

namespace detail {

inline bool needs_power(int lead) { return lead < -4 || lead > 6; }

} // namespace detail

/// A number rounded in the given direction to some significant digits.
[[nodiscard]] SIVID_DECL std::string rounded_text(double x, rounding way, number_format f = {});

/// How much wider one thing is than another, rounded up: "1.2 % wider", from twice on "2.4 times as
/// wide". @param share  0 where they are of one width
[[nodiscard]] SIVID_DECL std::string wider_text(double share);

namespace detail {

/// Ends of an interval that is not empty, each rounded its way.
SIVID_DECL std::string interval_text(range const& r, number_format f, rounding low, rounding high);

} // namespace detail

/// An interval rounded outward: "[0.21820, 0.22181]", "[2.0, 2.1] x 10^-4".
/// @guarantee  the printed interval contains [lo, hi].
[[nodiscard]] SIVID_DECL std::string outward_text(range const& r, number_format f = {});

/// An interval rounded inward: for what holds at all of its points.
/// @guarantee  [lo, hi] contains the printed interval.
/// @returns  nothing when the interval is too thin for sixteen digits
[[nodiscard]] SIVID_DECL std::optional<std::string> inward_text(range const& r,
                                                                number_format f = {});

/// The shortest decimal within two units in the last place: how a decimal that was read outward
/// was written by the user. For given data only, never for a proven bound.
[[nodiscard]] SIVID_DECL std::string given_text(double x);

[[nodiscard]] SIVID_DECL std::string given_text(range const& r);

/// The shortest decimal that reads back as the same double.
[[nodiscard]] SIVID_DECL std::string exact_text(double x);

/// A proven bound inside a given one, outward; an end that the proof did not move is printed as it
/// was given.
[[nodiscard]] SIVID_DECL std::string outward_text_within(range const& proven, range const& given,
                                                         number_format f = {});

/// A count with thin spaces between groups of three digits.
[[nodiscard]] SIVID_DECL std::string count_text(std::uint64_t n);

/// Seconds in a unit that reads well: "85 ms", "12.3 s", "4 min 5 s".
[[nodiscard]] SIVID_DECL std::string duration_text(double seconds);

/// A unit in typographic form: "kg m^2" gives "kg m" and a raised 2.
[[nodiscard]] SIVID_DECL std::string unit_text(std::string_view unit);

/// A unit to be put after a value, with a space that does not break; empty without a unit, and for
/// 1, which would read as a digit.
[[nodiscard]] SIVID_DECL std::string unit_suffix(std::string_view unit);

/// True for a positive finite number: that of a fit.
[[nodiscard]] SIVID_DECL bool is_fitted(double inflation);
/// True when a proved range of an inflation says anything.
[[nodiscard]] SIVID_DECL bool says_something(range const& inflation);

/// Proved bounds as a reader sees them: three digits, outward; "at least 3.1", "at most 0.98".
[[nodiscard]] SIVID_DECL std::string span_text(range const& r, int digits = 3);

/// Proved bounds of an inflation, with up to seven digits so that a gap is not rounded away, else
/// as "more than 1".
[[nodiscard]] SIVID_DECL std::string inflation_text(range const& r);

/// A number that is not proved, three digits.
[[nodiscard]] SIVID_DECL std::string estimate_text(double x);

/// A share in percent, rounded up or down; one that is known within bounds outward.
[[nodiscard]] SIVID_DECL std::string at_most_percent(double share);
[[nodiscard]] SIVID_DECL std::string at_least_percent(double share);
[[nodiscard]] SIVID_DECL std::string percent_interval(range const& share);

/// With a capital letter in front.
[[nodiscard]] SIVID_DECL std::string capitalised(std::string text);

/// Formula text for a reader: a raised dot for '*', at which lines do not break.
[[nodiscard]] SIVID_DECL std::string formula_text(std::string const& formula);

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/impl/number_text.ipp>
#endif

#endif
