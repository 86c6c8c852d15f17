// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_STEP_DETAIL_STEP_LENGTH_HPP
#define SIVID_ENCLOSURE_STEP_DETAIL_STEP_LENGTH_HPP

/// @file
/// Powers and roots of lengths of steps that another unit of time, if it is a power of two, changes
/// by that factor and by no rounding. All of it are preferences; no proof rests on them.

#include <cmath>
#include <cstddef>

namespace sivid::enclosure_detail {

/// h with c h^k = most.
/// @given  most and c positive and finite, k at least 1
[[nodiscard]] inline double length_for(double most, double c, std::size_t k) {
    double const x = most / c;
    if (!(x > 0) || !std::isfinite(x)) return std::pow(x, 1 / static_cast<double>(k));
    int const n = static_cast<int>(k), e = std::ilogb(x);
    int const whole = (e >= 0 ? e : e - n + 1) / n;
    double const rest = std::ldexp(x, -whole * n);
    return std::ldexp(std::pow(rest, 1 / static_cast<double>(k)), whole);
}
/// h^k
[[nodiscard]] inline double power_of(double h, std::size_t k) {
    int e = 0;
    double const m = std::frexp(h, &e);
    return std::ldexp(std::pow(m, static_cast<double>(k)), e * static_cast<int>(k));
}

} // namespace sivid::enclosure_detail

#endif
