// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_IMPL_NUMBER_TEXT_IPP
#define SIVID_REPORT_IMPL_NUMBER_TEXT_IPP

#include <sivid/report/number_text.hpp>

namespace sivid::report {

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
    std::string const text = std::string{"["} + bound_text(r.lo, quantum, f.shift, power, low) +
                             ", " + bound_text(r.hi, quantum, f.shift, power, high) + "]";
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
    return is_empty(r) ? "empty"
                       : std::string{"["} + given_text(r.lo) + ", " + given_text(r.hi) + "]";
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
    return unit.empty() || unit == "1" ? std::string{} : std::string{"\xC2\xA0"} + unit_text(unit);
}

} // namespace sivid::report

#endif
