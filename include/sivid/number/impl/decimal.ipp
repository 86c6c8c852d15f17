// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_IMPL_DECIMAL_IPP
#define SIVID_NUMBER_IMPL_DECIMAL_IPP

#include <sivid/number/decimal.hpp>

namespace sivid {

namespace detail {

/// The fast way: at most 15 digits and a power of ten that is a double make two exact operands of
/// one product or quotient. Returns false if the text needs the slow way.
inline bool short_decimal(std::string_view text, number_text const& n, double& digits, int& power) {
    if (n.hexadecimal || n.digit_count > 15) return false;
    std::int64_t const exponent = n.point - static_cast<std::int64_t>(n.digit_count);
    if (exponent < -22 || exponent > 22) return false;
    std::int64_t value = 0;
    std::size_t seen = 0;
    for (std::size_t i = n.first; seen < n.digit_count; ++i) {
        int const d = digit_value(text[i], false);
        if (d < 0) continue;
        value = value * 10 + d;
        ++seen;
    }
    digits = static_cast<double>(value);
    power = static_cast<int>(exponent);
    return true;
}

inline constexpr std::array<double, 23> powers_of_ten{
    1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
    1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

SIVID_DECL interval enclose_text(std::string_view text, number_text const& n, bool negative) {
    double digits = 0.0, lo, hi;
    int power = 0;
    if (short_decimal(text, n, digits, power)) {
        double const ten = powers_of_ten[static_cast<std::size_t>(power < 0 ? -power : power)];
        lo = power < 0 ? div_down(digits, ten) : mul_down(digits, ten);
        hi = power < 0 ? div_up(digits, ten) : mul_up(digits, ten);
    } else {
        rounded_magnitude const r = round_text(text, n);
        lo = r.below;
        hi = r.exact ? lo : next_up(lo);
    }
    return negative ? unchecked_interval(-hi, -lo) : unchecked_interval(lo, hi);
}

SIVID_DECL double nearest_text(std::string_view text, number_text const& n, bool negative) {
    double digits = 0.0;
    int power = 0;
    if (short_decimal(text, n, digits, power)) {
        double const ten = powers_of_ten[static_cast<std::size_t>(power < 0 ? -power : power)];
        double const y = power < 0 ? directed_div<direction::nearest>(digits, ten)
                                   : directed_mul<direction::nearest>(digits, ten);
        return negative ? -y : y;
    }
    rounded_magnitude const r = round_text(text, n);
    bool const odd = (bits(r.below) & 1) != 0;
    bool const up = !r.exact && (r.half > 0 || (r.half == 0 && odd));
    double const y = up ? next_up(r.below) : r.below;
    return negative ? -y : y;
}

} // namespace detail

SIVID_DECL interval enclose(decimal d) {
    return detail::enclose_text(d.view(), detail::scan_number(d.view()), d.negative);
}

SIVID_DECL double nearest(decimal d) {
    return detail::nearest_text(d.view(), detail::scan_number(d.view()), d.negative);
}

SIVID_DECL std::optional<interval> parse_decimal(std::string_view text) {
    detail::number_text const n = detail::scan_number(text);
    if (!n.valid) return std::nullopt;
    interval const x = detail::enclose_text(text, n, n.negative);
    if (!is_bounded(x)) return std::nullopt;
    return x;
}

SIVID_DECL std::optional<double> parse_nearest(std::string_view text) {
    detail::number_text const n = detail::scan_number(text);
    if (!n.valid) return std::nullopt;
    double const x = detail::nearest_text(text, n, n.negative);
    if (detail::is_infinite(x)) return std::nullopt;
    return x;
}

} // namespace sivid

#endif
