// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_NUMBER_TEXT_HPP
#define SIVID_REPORT_NUMBER_TEXT_HPP

#include <sivid/io/text/printable_text.hpp>
#include <sivid/number/decimal.hpp>
#include <sivid/number/decimal_output.hpp>
#include <sivid/number/interval.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
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

inline constexpr std::string_view minus_sign = "\xE2\x88\x92";

/// Position of the leading digit: |x| = d.ddd * 10^result (0 for zero).
inline int leading_exponent(double x) {
    return x == 0 ? 0 : sivid::detail::exact_digits(std::fabs(x)).point - 1;
}

inline std::string superscript(int value) {
    static constexpr std::string_view glyph[10] = {
        "\xE2\x81\xB0", "\xC2\xB9",     "\xC2\xB2",     "\xC2\xB3",     "\xE2\x81\xB4",
        "\xE2\x81\xB5", "\xE2\x81\xB6", "\xE2\x81\xB7", "\xE2\x81\xB8", "\xE2\x81\xB9"};
    std::string out = value < 0 ? "\xE2\x81\xBB" : "";
    for (char const c : std::to_string(std::abs(value))) out += glyph[c - '0'];
    return out;
}

} // namespace detail

/// " x 10^e" in typographic form.
[[nodiscard]] inline std::string power_text(int exponent) {
    return " \xC3\x97 10" + detail::superscript(exponent);
}

/// Rounds a finite double to a multiple of 10^quantum in the given direction.
/// @guarantee  down: result <= x, up: result >= x, as real numbers; the error is below 10^quantum.
[[nodiscard]] inline scaled_decimal round_decimal(double x, int quantum, rounding way) {
    auto const [exact, point] = sivid::detail::exact_digits(std::fabs(x));
    int const kept = point - quantum;
    scaled_decimal out{.negative = std::signbit(x) && x != 0, .digits = "0", .exponent = quantum};
    std::string dropped = exact;
    if (kept > 0) {
        auto const n = static_cast<std::size_t>(kept);
        out.digits += exact.substr(0, n); // behind a 0, to which a carry may go
        out.digits.resize(n + 1, '0');
        dropped.erase(0, n);
    }
    bool const lost = dropped.find_first_not_of('0') != std::string::npos;
    bool const away = way == rounding::nearest
                          ? kept >= 0 && !dropped.empty() && dropped.front() >= '5'
                          : lost && ((way == rounding::up) != out.negative);
    if (away) {
        auto place = out.digits.size() - 1;
        while (out.digits[place] == '9') out.digits[place--] = '0';
        ++out.digits[place];
    }
    return out;
}

/// Writes a scaled decimal without an exponent, e.g. "-0.0120".
[[nodiscard]] inline std::string plain_text(scaled_decimal const& d) {
    std::string digits = d.digits;
    if (d.exponent > 0 && digits != "0") digits.append(static_cast<std::size_t>(d.exponent), '0');
    if (d.exponent < 0) {
        auto const decimals = static_cast<std::size_t>(-d.exponent);
        if (digits.size() <= decimals) digits.insert(0, decimals + 1 - digits.size(), '0');
        digits.insert(digits.size() - decimals, 1, '.');
    }
    bool const zero = digits.find_first_not_of("0.") == std::string::npos;
    auto const first = std::min(digits.find_first_not_of('0'), digits.size() - 1);
    digits.erase(0, digits[first] == '.' ? first - 1 : first);
    return (d.negative && !zero ? std::string{detail::minus_sign} : std::string{}) + digits;
}

/// The code point at the front of a non-empty text; one bad byte of what UTF-8 or XML 1.0 forbids
/// (controls, non-characters), and of direction overrides: they could make a name read as another
/// one.
inline io_detail::code_point shown_code_point(std::string_view text) {
    auto const c = io_detail::first_code_point(text);
    auto const within = [&](std::uint32_t from, std::uint32_t to) {
        return from <= c.value && c.value <= to;
    };
    bool const control =
        (c.value < 0x20 && c.value != '\t' && c.value != '\n') || within(0x7F, 0x9F);
    bool const non_character = (c.value & 0xFFFEu) == 0xFFFEu;
    bool const reordering = within(0x202A, 0x202E) || within(0x2066, 0x2069);
    return control || non_character || reordering ? io_detail::code_point{} : c;
}

/// Text made safe as XML or HTML content and inside a quoted attribute: markup characters become
/// entities, everything that is not valid text becomes U+FFFD.
/// @guarantee  the result has no '<', '>', '"', ''' and no '&' but that of an entity, and is valid
///             UTF-8 without control characters.
[[nodiscard]] inline std::string escape(std::string_view text) {
    std::string out;
    out.reserve(text.size() + text.size() / 8);
    while (!text.empty()) {
        auto const c = shown_code_point(text);
        if (c.value == io_detail::code_point::bad) {
            out += "\xEF\xBF\xBD";
        } else if (c.value == '&') {
            out += "&amp;";
        } else if (c.value == '<') {
            out += "&lt;";
        } else if (c.value == '>') {
            out += "&gt;";
        } else if (c.value == '"') {
            out += "&quot;";
        } else if (c.value == '\'') {
            out += "&#39;";
        } else {
            out += text.substr(0, c.size);
        }
        text.remove_prefix(c.size);
    }
    return out;
}

/// A rough width of the text in a sans-serif font of the given size, for laying out labels.
[[nodiscard]] inline double approximate_text_width(std::string_view text, double size) {
    double em = 0;
    while (!text.empty()) {
        auto const c = shown_code_point(text);
        bool const narrow =
            std::string_view{"iljtfrI.,:;|!'()[]/ "}.find(
                c.value < 0x80 ? static_cast<char>(c.value) : 'x') != std::string_view::npos;
        bool const wide = c.value < 0x80 && ((c.value >= 'A' && c.value <= 'Z' && c.value != 'I') ||
                                             c.value == 'm' || c.value == 'w' || c.value == '%');
        em += c.value >= 0x2E80 ? 1.0 : narrow ? 0.32 : wide ? 0.78 : 0.62;
        text.remove_prefix(c.size);
    }
    return em * size;
}

/// The text cut to a number of code points, with an ellipsis when something was cut.
[[nodiscard]] inline std::string shorten(std::string_view text, std::size_t longest) {
    std::size_t end = 0;
    std::size_t count = 0;
    std::size_t end_before_ellipsis = 0;
    while (end < text.size()) {
        if (count + 1 == longest) end_before_ellipsis = end;
        if (count == longest) {
            return std::string{text.substr(0, end_before_ellipsis)} + "\xE2\x80\xA6";
        }
        end += shown_code_point(text.substr(end)).size;
        ++count;
    }
    return std::string{text};
}

namespace detail {

inline bool needs_power(int lead) { return lead < -4 || lead > 6; }

inline std::string special_text(double x) {
    return std::isnan(x) ? "?" : x > 0 ? "\xE2\x88\x9E" : std::string{minus_sign} + "\xE2\x88\x9E";
}

/// One number, rounded at 10^quantum and written relative to 10^power.
inline std::string bound_text(double x, int quantum, int shift, int power, rounding way) {
    if (!std::isfinite(x)) return special_text(x);
    scaled_decimal d = round_decimal(x, quantum, way);
    d.exponent += shift - power;
    return plain_text(d);
}

/// Ends of an interval that is not empty, each rounded its way.
inline std::string interval_text(range const& r, number_format f, rounding low, rounding high) {
    double const largest = std::max(std::isfinite(r.lo) ? std::fabs(r.lo) : 0.0,
                                    std::isfinite(r.hi) ? std::fabs(r.hi) : 0.0);
    if (largest == 0 && is_finite(r)) return "[0, 0]";
    int const lead = leading_exponent(largest);
    double const width = r.hi - r.lo;
    int const finest = lead - 15;
    int const quantum = width > 0 && std::isfinite(width)
                            ? std::max(leading_exponent(width) - f.significant + 1, finest)
                            : (width == 0 ? finest : lead - f.significant + 1);
    int const power = needs_power(lead + f.shift) ? lead + f.shift : 0;
    std::string const text = "[" + bound_text(r.lo, quantum, f.shift, power, low) + ", " +
                             bound_text(r.hi, quantum, f.shift, power, high) + "]";
    return power == 0 ? text : text + power_text(power);
}

} // namespace detail

/// A number rounded in the given direction to some significant digits.
[[nodiscard]] inline std::string rounded_text(double x, rounding way, number_format f = {}) {
    if (!std::isfinite(x) || x == 0) return x == 0 ? "0" : detail::special_text(x);
    int const lead = detail::leading_exponent(x);
    int const power = detail::needs_power(lead + f.shift) ? lead + f.shift : 0;
    std::string const text = detail::bound_text(x, lead - f.significant + 1, f.shift, power, way);
    return power == 0 ? text : text + power_text(power);
}

namespace detail {

/// The shortest decimal that reads back within so much of x.
inline std::string text_within(double x, double slack) {
    if (!std::isfinite(x) || x == 0) return x == 0 ? "0" : special_text(x);
    int digits = 0;
    double back = x;
    do {
        char text[40];
        auto const end =
            std::to_chars(text, text + sizeof text, x, std::chars_format::scientific, digits++).ptr;
        back =
            parse_nearest(std::string_view(text, static_cast<std::size_t>(end - text))).value_or(x);
    } while (!(std::fabs(back - x) <= slack) && digits < 17);
    return rounded_text(back, rounding::nearest, {.significant = digits, .shift = 0});
}

} // namespace detail

/// How much wider one thing is than another, rounded up: "1.2 % wider", from twice on "2.4 times as
/// wide". @param share  0 where they are of one width
[[nodiscard]] inline std::string wider_text(double share) {
    if (share < 1)
        return rounded_text(std::max(0.0, share), rounding::up, {.significant = 2, .shift = 2}) +
               " % wider";
    return rounded_text(std::nextafter(1 + share, HUGE_VAL), rounding::up, {.significant = 2}) +
           " times as wide";
}

/// An interval rounded outward: "[0.21820, 0.22181]", "[2.0, 2.1] x 10^-4".
/// @guarantee  the printed interval contains [lo, hi].
[[nodiscard]] inline std::string outward_text(range const& r, number_format f = {}) {
    if (is_empty(r)) return "empty";
    return detail::interval_text(r, f, rounding::down, rounding::up);
}

/// An interval rounded inward: for what holds at all of its points.
/// @guarantee  [lo, hi] contains the printed interval.
/// @returns  nothing when the interval is too thin for sixteen digits
[[nodiscard]] inline std::optional<std::string> inward_text(range const& r, number_format f = {}) {
    // Three units of the last digit that 16 digits leave: the ends cannot pass each other.
    double const size = std::max(std::fabs(r.lo), std::fabs(r.hi));
    if (is_empty(r) || !is_finite(r) || !(r.hi - r.lo > 3e-15 * size)) return std::nullopt;
    return detail::interval_text(r, f, rounding::up, rounding::down);
}

/// The shortest decimal within two units in the last place: how a decimal that was read outward
/// was written by the user. For given data only, never for a proven bound.
[[nodiscard]] inline std::string given_text(double x) {
    return detail::text_within(x, 2 * (std::nextafter(std::fabs(x), INFINITY) - std::fabs(x)));
}

[[nodiscard]] inline std::string given_text(range const& r) {
    return is_empty(r) ? "empty" : "[" + given_text(r.lo) + ", " + given_text(r.hi) + "]";
}

/// The shortest decimal that reads back as the same double.
[[nodiscard]] inline std::string exact_text(double x) { return detail::text_within(x, 0); }

/// A proven bound inside a given one, outward; an end that the proof did not move is printed as it
/// was given.
[[nodiscard]] inline std::string outward_text_within(range const& proven, range const& given,
                                                     number_format f = {}) {
    std::string text = outward_text(proven, f);
    auto const comma = text.find(", ");
    if (!is_finite(proven) || comma == std::string::npos || text.back() != ']') return text;
    std::string const low =
        proven.lo == given.lo ? given_text(given.lo) : text.substr(1, comma - 1);
    std::string const high = proven.hi == given.hi
                                 ? given_text(given.hi)
                                 : text.substr(comma + 2, text.size() - comma - 3);
    return "[" + low + ", " + high + "]";
}

/// A count with thin spaces between groups of three digits.
[[nodiscard]] inline std::string count_text(std::uint64_t n) {
    std::string const digits = std::to_string(n);
    std::string out;
    for (std::size_t i = 0; i < digits.size(); ++i) {
        if (i > 0 && (digits.size() - i) % 3 == 0 && digits.size() > 4) out += "\xE2\x80\xAF";
        out += digits[i];
    }
    return out;
}

/// Seconds in a unit that reads well: "85 ms", "12.3 s", "4 min 5 s".
[[nodiscard]] inline std::string duration_text(double seconds) {
    if (!(seconds >= 0) || !std::isfinite(seconds)) return "?";
    if (seconds < 1) {
        return seconds == 0 ? "0 s" : rounded_text(seconds * 1e3, rounding::nearest) + " ms";
    }
    if (seconds < 120) return rounded_text(seconds, rounding::nearest) + " s";
    auto const whole = static_cast<std::uint64_t>(std::llround(std::min(seconds, 1e15)));
    return whole < 7200
               ? std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s"
               : count_text(whole / 3600) + " h " + std::to_string(whole % 3600 / 60) + " min";
}

/// A unit in typographic form: "kg m^2" gives "kg m" and a raised 2.
[[nodiscard]] inline std::string unit_text(std::string_view unit) {
    std::string out;
    for (std::size_t i = 0; i < unit.size(); ++i) {
        if (unit[i] == '^') {
            int value = 0;
            auto const [end, error] =
                std::from_chars(unit.data() + i + 1, unit.data() + unit.size(), value);
            if (error == std::errc{} && std::abs(value) < 100) {
                out += detail::superscript(value);
                i = static_cast<std::size_t>(end - unit.data()) - 1;
                continue;
            }
        }
        out += unit[i] == '*' ? "\xC2\xB7" : std::string(1, unit[i]);
    }
    return out;
}

/// A unit to be put after a value, with a space that does not break; empty without a unit, and for
/// 1, which would read as a digit.
[[nodiscard]] inline std::string unit_suffix(std::string_view unit) {
    return unit.empty() || unit == "1" ? std::string{} : "\xC2\xA0" + unit_text(unit);
}

/// True for a positive finite number: that of a fit.
[[nodiscard]] inline bool is_fitted(double inflation) {
    return std::isfinite(inflation) && inflation > 0;
}

/// True when a proved range of an inflation says anything.
[[nodiscard]] inline bool says_something(range const& inflation) {
    return !is_empty(inflation) && (inflation.lo > 0 || std::isfinite(inflation.hi));
}

/// Proved bounds as a reader sees them: three digits, outward; "at least 3.1", "at most 0.98".
[[nodiscard]] inline std::string span_text(range const& r, int digits = 3) {
    if (is_empty(r)) return "?";
    number_format const f{.significant = digits, .shift = 0};
    if (!std::isfinite(r.hi)) {
        return std::isfinite(r.lo) ? "at least " + rounded_text(r.lo, rounding::down, f)
                                   : "not bounded";
    }
    if (!std::isfinite(r.lo)) return "at most " + rounded_text(r.hi, rounding::up, f);
    std::string const low = rounded_text(r.lo, rounding::down, f);
    std::string const high = rounded_text(r.hi, rounding::up, f);
    return low == high ? low : low + " to " + high;
}

/// Proved bounds of an inflation, with up to seven digits so that a gap is not rounded away, else
/// as "more than 1".
[[nodiscard]] inline std::string inflation_text(range const& r) {
    if (!(r.lo > 0) && std::isfinite(r.hi)) return span_text({-INFINITY, r.hi});
    int digits = 3;
    for (double left = 0.01; r.lo > 1 && r.lo < 1 + 1.001 * left && digits < 8; left /= 10)
        ++digits;
    if (digits < 8) return span_text(r, digits);
    // Longer numbers tell a reader nothing more.
    return std::isfinite(r.hi) ? "more than 1, " + span_text({-INFINITY, r.hi}) : "more than 1";
}

/// A number that is not proved, three digits.
[[nodiscard]] inline std::string estimate_text(double x) {
    return std::isfinite(x) ? "\xE2\x89\x88\xE2\x80\xAF" + rounded_text(x, rounding::nearest) : "?";
}

/// A share in percent, rounded up or down; one that is known within bounds outward.
[[nodiscard]] inline std::string at_most_percent(double share) {
    return rounded_text(share, rounding::up, {.significant = 3, .shift = 2}) + " %";
}

[[nodiscard]] inline std::string at_least_percent(double share) {
    return rounded_text(share, rounding::down, {.significant = 3, .shift = 2}) + " %";
}

[[nodiscard]] inline std::string percent_interval(range const& share) {
    if (share.lo == share.hi && (share.lo == 0 || share.lo == 1))
        return share.lo == 0 ? "0 %" : "100 %";
    return is_empty(share) ? std::string{}
                           : outward_text(share, {.significant = 2, .shift = 2}) + " %";
}

/// Formula text for a reader: a raised dot for '*', at which lines do not break.
[[nodiscard]] inline std::string formula_text(std::string const& formula) {
    std::string out;
    for (char const c : formula) {
        out += c == '*' ? std::string{"\xE2\x80\xAF\xC2\xB7\xE2\x80\xAF"} : std::string(1, c);
    }
    return out;
}

/// With a capital letter in front.
[[nodiscard]] inline std::string capitalised(std::string text) {
    if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') {
        text[0] = static_cast<char>(text[0] - 'a' + 'A');
    }
    return text;
}

} // namespace sivid::report

#endif
