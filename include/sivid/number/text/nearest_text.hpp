// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_TEXT_NEAREST_TEXT_HPP
#define SIVID_NUMBER_TEXT_NEAREST_TEXT_HPP

#include <sivid/number/decimal.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>

namespace sivid {

/// x to so many significant digits, without trailing zeros: 0.25, 1e-05, -3, nan. Rounded to
/// nearest, so it is for names and estimates; bounds are printed by `to_decimal_lower` and
/// `to_decimal_upper`.
[[nodiscard]] inline std::string nearest_text(double x, int digits) {
    std::array<char, 64> text{};
    auto const end = std::to_chars(text.data(), text.data() + text.size(), x,
                                   std::chars_format::general, digits);
    return {text.data(), end.ptr};
}

/// The shortest decimal that reads back as the same double.
[[nodiscard]] inline std::string nearest_text(double x) {
    std::array<char, 64> text{};
    auto const end = std::to_chars(text.data(), text.data() + text.size(), x);
    return {text.data(), end.ptr};
}

/// x rounded to so many significant digits.
[[nodiscard]] inline double rounded_to(double x, int digits) {
    auto const text = nearest_text(x, digits);
    double result = x;
    std::from_chars(text.data(), text.data() + text.size(), result);
    return result;
}

} // namespace sivid

namespace sivid {

/// The double of a decimal of few digits in [lower, upper], within `tolerance` of a point of it:
/// what people can read and type.
[[nodiscard]] inline double few_digits(double lower, double upper, double at, double tolerance) {
    for (int digits = 1; digits < 17; ++digits) {
        double const value = parse_nearest(nearest_text(at, digits)).value_or(at);
        if (std::abs(value - at) <= tolerance && lower <= value && value <= upper) return value;
    }
    return std::clamp(at, lower, upper);
}

} // namespace sivid

#endif
