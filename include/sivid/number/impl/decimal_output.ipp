// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_IMPL_DECIMAL_OUTPUT_IPP
#define SIVID_NUMBER_IMPL_DECIMAL_OUTPUT_IPP

#include <sivid/number/decimal_output.hpp>

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

SIVID_DECL std::size_t fewest_digits(double x, digit_string const& all, bool up) {
    double const next = std::nextafter(x, up ? std::numeric_limits<double>::infinity() : 0.0);
    if (is_zero(next) || is_infinite(next)) return 1;
    digit_string const other = exact_digits(next);
    if (other.point != all.point) return 1;
    std::size_t const same = static_cast<std::size_t>(
        std::mismatch(all.digits.begin(), all.digits.end(), other.digits.begin()).first -
        all.digits.begin());
    if (all.digits.find_first_not_of('0', same) != std::string::npos) return same + 1;
    return all.digits.find_last_not_of('0') + 1; // x itself is that short
}

SIVID_DECL std::string shortest_magnitude(double x, bool up) {
    digit_string const all = exact_digits(x);
    // 17 digits always suffice: their spacing is below the spacing of doubles.
    for (std::size_t count = fewest_digits(x, all, up); count < 17; ++count) {
        std::string text = layout(shortened(all, count, up));
        number_text const n = scan_number(text);
        interval const seen = enclose_text(text, n, false);
        if ((up ? seen.lower() : seen.upper()) == x && is_bounded(seen)) return text;
    }
    return layout(shortened(all, 17, up));
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
    if (x > 0.0) return magnitude(x, up);
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
