// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_TEXT_IMPL_ROUNDED_DECIMAL_IPP
#define SIVID_REPORT_TEXT_IMPL_ROUNDED_DECIMAL_IPP

#include <sivid/report/text/detail/rounded_decimal.hpp>

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
    return std::string{" \xC3\x97 10"} + detail::superscript(exponent);
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

} // namespace sivid::report

#endif
