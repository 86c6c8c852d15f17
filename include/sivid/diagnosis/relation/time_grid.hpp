// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_RELATION_TIME_GRID_HPP
#define SIVID_DIAGNOSIS_RELATION_TIME_GRID_HPP

#include <algorithm>
#include <cmath>
#include <cstddef>
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

} // namespace sivid

#endif
