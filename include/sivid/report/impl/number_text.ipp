// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_IMPL_NUMBER_TEXT_IPP
#define SIVID_REPORT_IMPL_NUMBER_TEXT_IPP

#include <sivid/report/number_text.hpp>

#include <sivid/io/text/printable_text.hpp>

#include <charconv>
#include <cstdlib>

namespace sivid::report {

namespace detail {

SIVID_DECL int leading_exponent(double x) {
    char text[32];
    auto const end =
        std::to_chars(text, text + sizeof text, std::fabs(x), std::chars_format::scientific, 16)
            .ptr;
    std::string_view const all{text, static_cast<std::size_t>(end - text)};
    std::string_view const tail = all.substr(all.find('e') + 1);
    int value = 0;
    std::from_chars(tail.data() + 1, tail.data() + tail.size(), value);
    return x == 0 ? 0 : tail.front() == '-' ? -value : value;
}

SIVID_DECL std::string superscript(int value) {
    static constexpr std::string_view glyph[10] = {
        "\xE2\x81\xB0", "\xC2\xB9",     "\xC2\xB2",     "\xC2\xB3",     "\xE2\x81\xB4",
        "\xE2\x81\xB5", "\xE2\x81\xB6", "\xE2\x81\xB7", "\xE2\x81\xB8", "\xE2\x81\xB9"};
    std::string out = value < 0 ? "\xE2\x81\xBB" : "";
    for (char const c : std::to_string(std::abs(value))) out += glyph[c - '0'];
    return out;
}

} // namespace detail

SIVID_DECL std::string power_text(int exponent) {
    return " \xC3\x97 10" + detail::superscript(exponent);
}

SIVID_DECL scaled_decimal round_decimal(double x, int quantum, rounding way) {
    // 767 significant digits write any double exactly.
    char text[800];
    auto const end =
        std::to_chars(text, text + sizeof text, std::fabs(x), std::chars_format::scientific, 766)
            .ptr;
    std::string_view const all{text, static_cast<std::size_t>(end - text)};
    std::string exact;
    for (char const c : all.substr(0, all.find('e')))
        if (c != '.') exact += c;
    std::string_view const tail = all.substr(all.find('e') + 1);
    int lead = 0;
    std::from_chars(tail.data() + 1, tail.data() + tail.size(), lead);
    lead = tail.front() == '-' ? -lead : lead;

    int const kept = lead - quantum + 1;
    scaled_decimal out{.negative = std::signbit(x) && x != 0, .digits = "0", .exponent = quantum};
    std::string dropped = exact;
    if (kept > 0) {
        auto const n = static_cast<std::size_t>(kept);
        out.digits = exact.substr(0, std::min(n, exact.size()));
        out.digits.append(n > exact.size() ? n - exact.size() : 0, '0');
        dropped = n < exact.size() ? exact.substr(n) : "";
    }
    bool const lost = dropped.find_first_not_of('0') != std::string::npos;
    bool const away = way == rounding::nearest
                          ? kept >= 0 && !dropped.empty() && dropped.front() >= '5'
                          : lost && ((way == rounding::up) != out.negative);
    if (away) {
        auto place = out.digits.size();
        while (place > 0 && out.digits[place - 1] == '9') out.digits[--place] = '0';
        if (place == 0) {
            out.digits.insert(out.digits.begin(), '1');
        } else {
            ++out.digits[place - 1];
        }
    }
    return out;
}

SIVID_DECL std::string plain_text(scaled_decimal const& d) {
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

SIVID_DECL std::string escape(std::string_view text) {
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

SIVID_DECL double approximate_text_width(std::string_view text, double size) {
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

SIVID_DECL std::string shorten(std::string_view text, std::size_t longest) {
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

SIVID_DECL std::string interval_text(range const& r, number_format f, rounding low, rounding high) {
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

SIVID_DECL std::string rounded_text(double x, rounding way, number_format f) {
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

SIVID_DECL std::string wider_text(double share) {
    if (share < 1)
        return rounded_text(std::max(0.0, share), rounding::up, {.significant = 2, .shift = 2}) +
               " % wider";
    return rounded_text(std::nextafter(1 + share, HUGE_VAL), rounding::up, {.significant = 2}) +
           " times as wide";
}

SIVID_DECL std::string outward_text(range const& r, number_format f) {
    if (is_empty(r)) return "empty";
    return detail::interval_text(r, f, rounding::down, rounding::up);
}

SIVID_DECL std::optional<std::string> inward_text(range const& r, number_format f) {
    // Three units of the last digit that 16 digits leave: the ends cannot pass each other.
    double const size = std::max(std::fabs(r.lo), std::fabs(r.hi));
    if (is_empty(r) || !is_finite(r) || !(r.hi - r.lo > 3e-15 * size)) return std::nullopt;
    return detail::interval_text(r, f, rounding::up, rounding::down);
}

SIVID_DECL std::string given_text(double x) {
    return detail::text_within(x, 2 * (std::nextafter(std::fabs(x), INFINITY) - std::fabs(x)));
}

SIVID_DECL std::string given_text(range const& r) {
    return is_empty(r) ? "empty" : "[" + given_text(r.lo) + ", " + given_text(r.hi) + "]";
}

SIVID_DECL std::string exact_text(double x) { return detail::text_within(x, 0); }

SIVID_DECL std::string outward_text_within(range const& proven, range const& given,
                                           number_format f) {
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

SIVID_DECL std::string count_text(std::uint64_t n) {
    std::string const digits = std::to_string(n);
    std::string out;
    for (std::size_t i = 0; i < digits.size(); ++i) {
        if (i > 0 && (digits.size() - i) % 3 == 0 && digits.size() > 4) out += "\xE2\x80\xAF";
        out += digits[i];
    }
    return out;
}

SIVID_DECL std::string duration_text(double seconds) {
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

SIVID_DECL std::string unit_text(std::string_view unit) {
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

SIVID_DECL std::string unit_suffix(std::string_view unit) {
    return unit.empty() || unit == "1" ? std::string{} : "\xC2\xA0" + unit_text(unit);
}

SIVID_DECL bool is_fitted(double inflation) { return std::isfinite(inflation) && inflation > 0; }

SIVID_DECL bool says_something(range const& inflation) {
    return !is_empty(inflation) && (inflation.lo > 0 || std::isfinite(inflation.hi));
}

SIVID_DECL std::string span_text(range const& r, int digits) {
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

SIVID_DECL std::string inflation_text(range const& r) {
    if (!(r.lo > 0) && std::isfinite(r.hi)) return span_text({-INFINITY, r.hi});
    int digits = 3;
    for (double left = 0.01; r.lo > 1 && r.lo < 1 + 1.001 * left && digits < 8; left /= 10)
        ++digits;
    if (digits < 8) return span_text(r, digits);
    // Longer numbers tell a reader nothing more.
    return std::isfinite(r.hi) ? "more than 1, " + span_text({-INFINITY, r.hi}) : "more than 1";
}

SIVID_DECL std::string estimate_text(double x) {
    return std::isfinite(x) ? "\xE2\x89\x88\xE2\x80\xAF" + rounded_text(x, rounding::nearest) : "?";
}

SIVID_DECL std::string at_most_percent(double share) {
    return rounded_text(share, rounding::up, {.significant = 3, .shift = 2}) + " %";
}

SIVID_DECL std::string at_least_percent(double share) {
    return rounded_text(share, rounding::down, {.significant = 3, .shift = 2}) + " %";
}

SIVID_DECL std::string percent_interval(range const& share) {
    if (share.lo == share.hi && (share.lo == 0 || share.lo == 1))
        return share.lo == 0 ? "0 %" : "100 %";
    return is_empty(share) ? std::string{}
                           : outward_text(share, {.significant = 2, .shift = 2}) + " %";
}

SIVID_DECL std::string formula_text(std::string const& formula) {
    std::string out;
    for (char const c : formula) {
        out += c == '*' ? std::string{"\xE2\x80\xAF\xC2\xB7\xE2\x80\xAF"} : std::string(1, c);
    }
    return out;
}

SIVID_DECL std::string capitalised(std::string text) {
    if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') {
        text[0] = static_cast<char>(text[0] - 'a' + 'A');
    }
    return text;
}

} // namespace sivid::report

#endif
