// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_TEXT_IMPL_DECIMAL_TEXT_IPP
#define SIVID_NUMBER_TEXT_IMPL_DECIMAL_TEXT_IPP

/// @file
/// Number texts rounded to neighbouring doubles, in whole numbers of any size: the end of
/// decimal_text.hpp.

#include <sivid/number/text/detail/decimal_text.hpp>

#include <sivid/compiled.hpp>

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

#endif
