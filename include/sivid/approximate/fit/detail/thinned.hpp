// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_FIT_DETAIL_THINNED_HPP
#define SIVID_APPROXIMATE_FIT_DETAIL_THINNED_HPP

#include <sivid/measurement/record.hpp>
#include <sivid/model/problem.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace sivid {

/// So many measurements are thinned before a fit looks at all of them.
inline constexpr std::size_t many_measurements = 6000;

/// Which measurements of each experiment a fit looks at first, in the order of `sorted`: of each
/// channel every n-th, and the last one, so that all its time is seen.
/// @param most  about so many are left of all together
[[nodiscard]] inline std::vector<std::vector<std::size_t>>
thinned_indices(identification_problem const& problem, std::size_t most) {
    auto const step = (measurement_count(problem) + most - 1) / most;
    std::vector<std::vector<std::size_t>> result;
    for (auto const& e : problem.experiments) {
        auto const all = sorted(e.measurements);
        auto& own = result.emplace_back();
        std::vector<std::size_t> left(problem.model.about.channels.size(), 0);
        for (auto const& m : all) ++left[m.channel];
        for (std::size_t k = 0; k < all.size(); ++k) { // counted from the end
            if (--left[all[k].channel] % step == 0) own.push_back(k);
        }
    }
    return result;
}

/// What belongs to the thinned measurements, of something that belongs to all of them in order.
template <class List>
[[nodiscard]] std::vector<List> thinned(std::vector<List> const& all,
                                        std::vector<std::vector<std::size_t>> const& indices) {
    std::vector<List> result(all.size());
    for (std::size_t e = 0; e < all.size(); ++e) {
        for (auto const k : indices[e]) result[e].push_back(all[e].at(k));
    }
    return result;
}

/// The same problem with fewer measurements: `thinned_indices`. Budgets of outliers shrink to what
/// may stand among them (three standard deviations more than their share). What explains these may
/// miss others.
[[nodiscard]] inline identification_problem thinned(identification_problem problem,
                                                    std::size_t most) {
    auto const step = (measurement_count(problem) + most - 1) / most;
    if (step < 2) return problem;
    auto const indices = thinned_indices(problem, most);
    std::vector<record> records;
    for (auto& e : problem.experiments) records.push_back(sorted(std::move(e.measurements)));
    records = thinned(records, indices);
    for (std::size_t e = 0; e < records.size(); ++e) {
        auto& budget = problem.experiments[e].outliers;
        double const share = static_cast<double>(budget) / static_cast<double>(step);
        auto const some = static_cast<std::size_t>(std::ceil(share + 3 * std::sqrt(share)));
        budget = std::min({budget, some, records[e].size()});
        problem.experiments[e].measurements = std::move(records[e]);
    }
    return problem;
}

} // namespace sivid

#endif
