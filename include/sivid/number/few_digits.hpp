// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_FEW_DIGITS_HPP
#define SIVID_NUMBER_FEW_DIGITS_HPP

#include <sivid/number/decimal.hpp>
#include <sivid/number/text/nearest_text.hpp>

#include <algorithm>
#include <cmath>

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
