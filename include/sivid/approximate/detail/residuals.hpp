// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_DETAIL_RESIDUALS_HPP
#define SIVID_APPROXIMATE_DETAIL_RESIDUALS_HPP

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

namespace sivid {

/// Per experiment and measurement: (output - measured) / half-width of the bound.
using residual_lists = std::vector<std::vector<double>>;

/// The (q+1)-th largest |residual|; 0 when there are no more than q.
[[nodiscard]] inline double relaxed_maximum(std::vector<double> const& r, std::size_t q) {
    if (q >= r.size()) return 0;
    std::vector<double> size;
    size.reserve(r.size());
    for (double const v : r) size.push_back(std::abs(v));
    std::nth_element(size.begin(), size.begin() + static_cast<std::ptrdiff_t>(q), size.end(),
                     std::greater<>());
    return size[q];
}

/// By what the bounds must grow: the largest of the experiments' relaxed maxima.
[[nodiscard]] inline double inflation_of(residual_lists const& r,
                                         std::vector<std::size_t> const& outliers) {
    double worst = 0;
    for (std::size_t e = 0; e < r.size(); ++e) {
        worst = std::max(worst, relaxed_maximum(r[e], outliers[e]));
    }
    return worst;
}

/// 1 for what counts and 0 for the (at most) q largest of each experiment.
[[nodiscard]] inline residual_lists kept_of(residual_lists const& r,
                                            std::vector<std::size_t> const& outliers) {
    residual_lists kept(r.size());
    for (std::size_t e = 0; e < r.size(); ++e) {
        double const limit = outliers[e] > 0 ? relaxed_maximum(r[e], outliers[e])
                                             : std::numeric_limits<double>::infinity();
        for (double const v : r[e]) kept[e].push_back(std::abs(v) > limit ? 0.0 : 1.0);
    }
    return kept;
}

} // namespace sivid

#endif
