// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_NUMBER_TEXT_HPP
#define SIVID_REPORT_NUMBER_TEXT_HPP

#include <sivid/compiled.hpp>
#include <sivid/number/decimal.hpp>
#include <sivid/report/text/detail/rounded_decimal.hpp>
#include <sivid/report/text/range.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

/// Numbers as a reader sees them. Proven bounds are rounded outward, so that the printed interval
/// contains the binary one; intervals all of whose points have a proven property inward. Decimals
/// read as the user gave them (`given_text`) are printed as given.
namespace sivid::report {

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

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/impl/number_text.ipp>
#endif

#endif
