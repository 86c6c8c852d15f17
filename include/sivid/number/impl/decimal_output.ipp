// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_IMPL_DECIMAL_OUTPUT_IPP
#define SIVID_NUMBER_IMPL_DECIMAL_OUTPUT_IPP

#include <sivid/number/decimal_output.hpp>

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <utility>

namespace sivid {

namespace detail {

SIVID_DECL digit_string exact_digits(double x) {
    std::array<char, 800> buffer;
    auto const end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), x,
                                   std::chars_format::scientific, 766);
    std::string_view const text{buffer.data(), static_cast<std::size_t>(end.ptr - buffer.data())};
    std::size_t const e = text.find('e');
    digit_string d;
    d.digits += text[0];
    d.digits += text.substr(2, e - 2);
    int exponent = 0;
    std::string_view const power = text.substr(text[e + 1] == '+' ? e + 2 : e + 1);
    std::from_chars(power.data(), power.data() + power.size(), exponent);
    d.point = exponent + 1;
    return d;
}

SIVID_DECL std::string layout(digit_string d) {
    while (d.digits.size() > 1 && d.digits.back() == '0') d.digits.pop_back();
    auto const n = static_cast<int>(d.digits.size());
    if (d.point > 0 && d.point <= 17) {
        if (n <= d.point) return d.digits + std::string(static_cast<std::size_t>(d.point - n), '0');
        auto const whole = static_cast<std::size_t>(d.point);
        return d.digits.substr(0, whole) + '.' + d.digits.substr(whole);
    }
    if (d.point <= 0 && d.point > -4)
        return d.digits.insert(0, static_cast<std::size_t>(-d.point), '0').insert(0, "0.");
    std::string text = d.digits.substr(0, 1);
    if (n > 1) text += '.' + d.digits.substr(1);
    return text + 'e' + std::to_string(d.point - 1);
}

SIVID_DECL digit_string shortened(digit_string const& all, std::size_t count, bool up) {
    digit_string d{all.digits.substr(0, count), all.point};
    bool const rest = all.digits.find_first_not_of('0', count) != std::string::npos;
    if (!up || !rest) return d;
    std::size_t i = count;
    while (i > 0 && d.digits[i - 1] == '9') d.digits[--i] = '0';
    if (i > 0) {
        ++d.digits[i - 1];
    } else {
        d.digits.insert(d.digits.begin(), '1');
        d.digits.pop_back();
        ++d.point;
    }
    return d;
}

/// A positive double as whole * 2^power, beside one whose power is greater by at most 1.
struct binary_parts {
    std::uint64_t whole;
    int power;
};

inline binary_parts parts_of(double x) {
    constexpr std::uint64_t hidden = std::uint64_t{1} << 52;
    auto const field = static_cast<int>(bits(x) >> 52);
    auto const significand = bits(x) & (hidden - 1);
    return field == 0 ? binary_parts{significand, -1074}
                      : binary_parts{significand | hidden, field - 1075};
}

/// The decimals t = n 10^unit with x >= t > next (or x <= t < next), of those the one with the
/// fewest digits that is nearest to x. `Whole` must hold 2^55 10^|unit| and 10^18 2^|power|.
/// @param unit  such that floor(x / 10^unit) has 17 or 18 digits
template <class Whole>
std::uint64_t shortest_multiple(binary_parts x, binary_parts next, int unit, bool up) {
    int const power = std::min(x.power, next.power);
    Whole ten = 1;
    for (int k = std::abs(unit); k > 0; --k) ten *= 10u;
    auto const numerator = [&](binary_parts const& a) {
        Whole n = a.whole;
        n <<= static_cast<unsigned>(a.power - power + std::max(power, 0));
        if (unit < 0) n *= ten;
        return n;
    };
    Whole denominator = 1;
    denominator <<= static_cast<unsigned>(std::max(-power, 0));
    if (unit > 0) denominator *= ten;
    Whole const from = numerator(x), limit = numerator(next);
    Whole const quotient = from / denominator;
    auto t = static_cast<std::uint64_t>(quotient);
    if (up && quotient * denominator != from) ++t;
    for (std::uint64_t step = 10; step <= 100'000'000'000'000'000u; step *= 10) {
        std::uint64_t const rest = t % step;
        std::uint64_t const rounder = rest == 0 ? t : up ? t - rest + step : t - rest;
        Whole const scaled = Whole{rounder} * denominator;
        if (up ? !(scaled < limit) : !(limit < scaled)) break;
        t = rounder;
    }
    return t;
}

SIVID_DECL std::string shortest_magnitude(double x, bool up) {
    auto const here = parts_of(x), next = parts_of(up ? next_up(x) : next_down(x));
    // 17 digits always suffice: their spacing is below that of doubles. x >= 2^top; the quotient is
    // log10(2) so closely that the floor is right for all doubles.
    int const top = static_cast<int>(std::bit_width(here.whole)) - 1 + here.power;
    int const unit = ((top * 1'262'611) >> 22) - 16;
    bool const fits = unit <= 0 && unit >= -22 && here.power <= 0 && here.power > -66;
    auto const t = fits ? shortest_multiple<boost::multiprecision::uint128_t>(here, next, unit, up)
                        : shortest_multiple<boost::multiprecision::cpp_int>(here, next, unit, up);
    digit_string d{std::to_string(t), unit};
    d.point += static_cast<int>(d.digits.size());
    return layout(std::move(d));
}

SIVID_DECL std::string in_brackets(std::string const& lo, std::string const& hi) {
    std::string text(1, '[');
    return text.append(lo).append(", ").append(hi).append(1, ']');
}

SIVID_DECL std::string to_decimal(double x, bool up, int digits) {
    if (is_nan(x)) return "nan";
    if (is_infinite(x)) return x > 0.0 ? "inf" : "-inf";
    if (is_zero(x)) return "0";
    auto const magnitude = [&](double m, bool away) {
        return digits > 0
                   ? layout(shortened(exact_digits(m), static_cast<std::size_t>(digits), away))
                   : shortest_magnitude(m, away);
    };
    if ((bits(x) & sign_bit) == 0) return magnitude(x, up); // a comparison may flush to zero
    std::string text(1, '-');
    return text.append(magnitude(-x, !up));
}

} // namespace detail

SIVID_DECL std::string to_decimal_lower(double x) { return detail::to_decimal(x, false); }

SIVID_DECL std::string to_decimal_upper(double x) { return detail::to_decimal(x, true); }

SIVID_DECL std::string to_decimal_lower(double x, int digits) {
    return detail::to_decimal(x, false, digits);
}

SIVID_DECL std::string to_decimal_upper(double x, int digits) {
    return detail::to_decimal(x, true, digits);
}

SIVID_DECL std::string to_string(interval const& x) {
    if (is_empty(x)) return "[empty]";
    return detail::in_brackets(to_decimal_lower(x.lower()), to_decimal_upper(x.upper()));
}

SIVID_DECL std::string to_string(interval const& x, int digits) {
    if (is_empty(x)) return "[empty]";
    return detail::in_brackets(to_decimal_lower(x.lower(), digits),
                               to_decimal_upper(x.upper(), digits));
}

SIVID_DECL std::string to_hex(double x) {
    if (detail::is_nan(x)) return "nan";
    if (detail::is_infinite(x)) return x > 0.0 ? "inf" : "-inf";
    bool const negative = (detail::bits(x) & detail::sign_bit) != 0;
    std::array<char, 40> buffer;
    auto const end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), negative ? -x : x,
                                   std::chars_format::hex);
    std::string text = negative ? "-0x" : "0x";
    text.append(buffer.data(), end.ptr);
    return text;
}

SIVID_DECL std::optional<double> from_hex(std::string_view text) {
    if (text == "inf") return detail::infinity;
    if (text == "-inf") return -detail::infinity;
    if (text == "nan") return detail::not_a_number;
    detail::number_text const n = detail::scan_number(text);
    if (!n.valid || !n.hexadecimal) return std::nullopt;
    detail::rounded_magnitude const r = detail::round_text(text, n);
    if (!r.exact) return std::nullopt;
    return n.negative ? -r.below : r.below;
}

} // namespace sivid

#endif
