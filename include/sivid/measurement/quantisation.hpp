// SPDX-License-Identifier: MIT
#ifndef SIVID_MEASUREMENT_QUANTISATION_HPP
#define SIVID_MEASUREMENT_QUANTISATION_HPP

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace sivid {

/// How many different values there are, counted up to `most`.
[[nodiscard]] inline std::size_t distinct_count(std::vector<double> const& values,
                                                std::size_t most) {
    std::vector<double> seen;
    for (double const v : values) {
        if (std::find(seen.begin(), seen.end(), v) == seen.end()) seen.push_back(v);
        if (seen.size() >= most) break;
    }
    return seen.size();
}

namespace quantisation_detail {

/// Exceeded by a tenth of the values.
inline double usual_magnitude(std::vector<double> values) {
    for (double& v : values) v = std::abs(v);
    auto const at = values.begin() +
                    static_cast<std::vector<double>::difference_type>((values.size() - 1) * 9 / 10);
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

/// Euclid for doubles: the largest step of which all gaps are whole multiples within their
/// rounding; 0: none above the smallest.
inline double exact_step(std::vector<double> const& gaps, double size, double smallest) {
    double step = gaps.front();
    for (double gap : gaps) {
        // Euclid with a tolerance: the rounding of the step counts as often as the gap holds it.
        while (true) {
            double const rest = std::abs(std::remainder(gap, step));
            double const rounding = 1e-15 * size * (1 + gap / step);
            if (rounding > 0.1 * step || rest <= rounding + 1e-4 * step) break;
            gap = step;
            step = rest;
        }
        if (step < smallest) return 0;
    }
    return step;
}

/// The last decimal place of all values, counted from the first digit of the largest, whatever
/// their unit is; 0: they have more than so many, as doubles that were computed have.
/// @param size  of the largest, above 0
inline double last_place(std::vector<double> const& values, double size) {
    constexpr int most = 9; // after the first one; doubles hold 15 places
    int const first = static_cast<int>(std::floor(std::log10(size)));
    for (int k = first; k >= first - most; --k) {
        double const place = std::pow(10.0, std::abs(k));
        bool const whole = std::all_of(values.begin(), values.end(), [&](double v) {
            double const scaled = k < 0 ? v * place : v / place;
            return std::abs(scaled - std::round(scaled)) <= 1e-6 + 1e-15 * std::abs(scaled);
        });
        if (whole) return k < 0 ? 1 / place : place;
    }
    return 0;
}

/// The step of readings that were written with a last decimal place: whole multiples within one of
/// it, and many of it. Euclid, with each longer gap telling the step more finely; 0: there is none.
/// @param gaps  of the sorted values, ascending
inline double written_step(std::vector<double> const& values, std::vector<double> const& gaps,
                           double place) {
    constexpr std::size_t least = 10; // gaps; fewer would agree by chance
    double const slack = 2 * place, smallest = 20 * place;
    if (gaps.size() < least) return 0;
    double step = gaps.front(), told_by = 1; // so many steps tell it
    for (double gap : gaps) {
        while (true) {
            double const n = std::round(gap / step), rest = std::abs(gap - n * step);
            if (step < smallest) return 0;
            if (rest <= slack) {
                if (n > told_by) step = gap / n, told_by = n;
                break;
            }
            gap = step;
            step = rest;
            told_by = 1;
        }
    }
    double const range = values.back() - values.front();
    step = range / std::round(range / step);
    bool const all = std::all_of(values.begin(), values.end(), [&](double v) {
        return std::abs(std::remainder(v - values.front(), step)) <= slack;
    });
    return all ? step : 0;
}

} // namespace quantisation_detail

/// The largest step of which all differences of the values are whole multiples, within the rounding
/// of doubles; 0 when there is none above 1e-9 of the largest magnitude, or no two different
/// values. The true step of the instrument divides it: short records may show a multiple.
///   Where that is no more than the last decimal place they are written with, it is a step of at
/// least 20 such places of which they are multiples within one, if there is one.
/// @given  finite values (trusted)
/// @cost  n log n
[[nodiscard]] inline double quantisation_step(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    if (values.empty()) return 0;
    double const size = std::max(std::abs(values.front()), std::abs(values.back()));
    double const tolerance = 1e-12 * size, smallest = 1e-9 * size;
    // Differences of the sorted values, the smallest first, so that remainders stay accurate.
    std::vector<double> gaps;
    double const usual_tolerance = 1e-12 * quantisation_detail::usual_magnitude(values);
    for (std::size_t i = 1; i < values.size(); ++i) {
        double const gap = values[i] - values[i - 1];
        if (gap > tolerance)
            gaps.push_back(gap);
        else if (gap > usual_tolerance) // more than rounding: a few absurd readings hide the step
            return 0;
    }
    std::sort(gaps.begin(), gaps.end());
    if (gaps.empty() || !std::isfinite(gaps.back())) return 0;
    double const step = quantisation_detail::exact_step(gaps, size, smallest);
    double const place = quantisation_detail::last_place(values, size);
    if (place > 0 && step < 1.5 * place) {
        double const coarse = quantisation_detail::written_step(values, gaps, place);
        if (coarse > 0) return coarse;
    }
    if (!(step > 0)) return 0;
    double const range = values.back() - values.front();
    return std::isfinite(range) ? range / std::round(range / step) : step;
}

} // namespace sivid

#endif
