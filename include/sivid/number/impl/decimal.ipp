// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_IMPL_DECIMAL_IPP
#define SIVID_NUMBER_IMPL_DECIMAL_IPP

#include <sivid/compiled.hpp>
#include <sivid/number/decimal.hpp>

#include <boost/multiprecision/cpp_int.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

namespace sivid::detail {

/// floor(n / d 2^shift) made to at most 53 bits, with the comparison against the middle; n, d > 0.
/// `more`: the number is a little greater than n/d (less than any representable difference).
inline rounded_magnitude round_ratio(boost::multiprecision::cpp_int n,
                                     boost::multiprecision::cpp_int d, std::int64_t exponent,
                                     bool more) {
    using boost::multiprecision::cpp_int;
    // The number is n/d 2^exponent. Choose the unit 2^unit so that the quotient has 53 or 54 bits.
    auto const bits_of = [](cpp_int const& x) { return static_cast<std::int64_t>(msb(x)) + 1; };
    std::int64_t const top = bits_of(n) - bits_of(d) + exponent; // number in [2^(top-1), 2^(top+1))
    rounded_magnitude r;
    if (top - 1 >= 1024) {
        return {std::numeric_limits<double>::max(), false, true, 1};
    }
    if (top + 1 < -1074) {
        r.exact = false;
        return r; // below half the least subnormal
    }
    std::int64_t unit = top - 53;
    if (unit < -1074) unit = -1074;
    cpp_int q, rest;
    auto const divide = [&] {
        std::int64_t const shift = exponent - unit;
        cpp_int const scaled_n = shift > 0 ? cpp_int{n << static_cast<unsigned>(shift)} : n;
        cpp_int const scaled_d = shift < 0 ? cpp_int{d << static_cast<unsigned>(-shift)} : d;
        divide_qr(scaled_n, scaled_d, q, rest);
        cpp_int const twice = rest * 2;
        r.half = twice < scaled_d ? -1 : twice > scaled_d || more ? 1 : 0;
        r.exact = rest == 0 && !more;
    };
    divide();
    if (q >= cpp_int{1} << 53) {
        ++unit;
        divide();
    }
    if (unit > 971) {
        return {std::numeric_limits<double>::max(), false, true, 1};
    }
    // q < 2^53 and q 2^unit is a double: put the bits together.
    auto const m = q.convert_to<std::uint64_t>();
    constexpr std::uint64_t hidden = std::uint64_t{1} << 52;
    r.below = std::bit_cast<double>(
        m < hidden ? m : (m - hidden) | static_cast<std::uint64_t>(unit + 1075) << 52);
    if (!r.exact && r.below == std::numeric_limits<double>::max()) r.overflow = true;
    return r;
}

SIVID_DECL rounded_magnitude round_text(std::string_view text, number_text const& n) {
    using boost::multiprecision::cpp_int;
    if (n.digit_count == 0) return {};
    std::int64_t const base_bits = n.hexadecimal ? 4 : 1;
    // The leading digit decides out-of-range numbers without any work.
    std::int64_t const scale = n.hexadecimal ? base_bits * n.point + n.exponent2 : n.point;
    if (scale > (n.hexadecimal ? 1030 : 310))
        return {std::numeric_limits<double>::max(), false, true, 1};
    if (scale < (n.hexadecimal ? -1080 : -330)) return {0.0, false, false, -1};
    // 800 digits exceed the longest decimal expansion of a double or of a middle of two (769).
    constexpr std::size_t kept_digits = 800;
    std::string digits;
    bool more = false;
    std::size_t seen = 0;
    for (std::size_t i = n.first; seen < n.digit_count; ++i) {
        int const d = digit_value(text[i], n.hexadecimal);
        if (d < 0) continue;
        if (seen < kept_digits)
            digits += text[i];
        else if (d != 0)
            more = true;
        ++seen;
    }
    auto const kept = static_cast<std::int64_t>(digits.size());
    if (n.hexadecimal) {
        return round_ratio(cpp_int{"0x" + digits}, cpp_int{1}, 4 * (n.point - kept) + n.exponent2,
                           more);
    }
    std::int64_t const power = n.point - kept;
    auto const magnitude = static_cast<unsigned>(power < 0 ? -power : power);
    cpp_int const ten = pow(cpp_int{10}, magnitude);
    cpp_int const numerator{digits};
    return power >= 0 ? round_ratio(cpp_int{numerator * ten}, cpp_int{1}, 0, more)
                      : round_ratio(numerator, ten, 0, more);
}

} // namespace sivid::detail

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
