// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_TIME_GRID_HPP
#define SIVID_PAVING_RELATION_TIME_GRID_HPP

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace sivid {

/// The given times, each gap cut into pieces no longer than about `step`.
[[nodiscard]] inline std::vector<double> refined_times(std::vector<double> times, double step) {
    std::sort(times.begin(), times.end());
    std::vector<double> result;
    for (std::size_t k = 0; k + 1 < times.size(); ++k) {
        double const gap = times[k + 1] - times[k];
        auto const pieces =
            static_cast<std::size_t>(std::clamp(std::ceil(gap / step - 1e-6), 1.0, 1e3));
        for (std::size_t p = 0; p < pieces; ++p) {
            double const t = times[k] + gap * static_cast<double>(p) / static_cast<double>(pieces);
            if (result.empty() || result.back() < t) result.push_back(t);
        }
    }
    if (result.empty() || result.back() < times.back()) result.push_back(times.back());
    return result;
}

/// Windows (first, last) between so many times: of many lengths, each about half as much longer
/// than the one before, from one gap to all; those of a length overlap, and are some hundred at
/// most.
[[nodiscard]] inline std::vector<std::pair<std::size_t, std::size_t>>
spread_windows(std::size_t times) {
    std::vector<std::pair<std::size_t, std::size_t>> result;
    std::size_t last = 0;
    for (double gaps = 1; last + 1 < times; gaps *= 1.5) {
        auto const length = std::min(static_cast<std::size_t>(gaps), times - 1);
        if (length == last) continue;
        last = length;
        auto const stride = std::max(length / 8, times / 128 + 1);
        for (std::size_t a = 0; a + length < times; a += stride) result.emplace_back(a, a + length);
    }
    return result;
}

} // namespace sivid

#endif
