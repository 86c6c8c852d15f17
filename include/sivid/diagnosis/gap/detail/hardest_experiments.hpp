// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_GAP_DETAIL_HARDEST_EXPERIMENTS_HPP
#define SIVID_DIAGNOSIS_GAP_DETAIL_HARDEST_EXPERIMENTS_HPP

#include <sivid/approximate/approximate_fit.hpp>
#include <sivid/model/problem.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

namespace sivid {

/// The `most` experiments that a fit misses by most, in their order; a problem that has no more is
/// returned as it is. Where many short experiments are at hand, few of them carry a refutation.
/// @guarantee  the inflation of the result is at most that of the problem: a maximum over fewer
///             experiments, for every parameter
[[nodiscard]] inline identification_problem
hardest_experiments(identification_problem problem, approximate_fit const& fit, std::size_t most) {
    auto const n = problem.experiments.size();
    if (n <= most || fit.residuals.size() != n) return problem;
    std::vector<double> missed(n, 0.0);
    for (std::size_t e = 0; e < n; ++e) {
        auto sizes = fit.residuals[e];
        for (double& r : sizes) r = std::abs(r);
        auto const q = problem.experiments[e].outliers;
        if (sizes.size() <= q) continue;
        auto const at = sizes.begin() + static_cast<std::ptrdiff_t>(q);
        std::nth_element(sizes.begin(), at, sizes.end(), std::greater<>{});
        missed[e] = *at;
    }
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return missed[a] > missed[b]; });
    order.resize(most);
    std::sort(order.begin(), order.end());
    std::vector<experiment> kept;
    for (auto const e : order) kept.push_back(std::move(problem.experiments[e]));
    problem.experiments = std::move(kept);
    return problem;
}

} // namespace sivid

#endif
