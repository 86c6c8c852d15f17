// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_OUTLIER_BUDGET_HPP
#define SIVID_PAVING_OUTLIER_BUDGET_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/identification.hpp>
#include <sivid/paving/outliers/fewest_outliers.hpp>
#include <sivid/paving/outliers/outlier_search_options.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace sivid {

/// How many outliers explain the data at the least. `total.most` is proved by the witness; without
/// one it is the number of measurements.
struct smallest_budget : fewest_outliers {
    /// By experiment: with these budgets the data are consistent (the witness proves it). When
    /// `total` is exact they are inconsistent with one less in any experiment.
    std::vector<std::size_t> budgets;
    std::optional<verified_witness> witness;
    std::size_t boxes = 0;
    std::size_t integrations = 0;
    double seconds = 0;
};

/// The smallest budgets of outliers for which the data are consistent: how many measurements the
/// best parameter violates, for each experiment alone and for all together. The budgets that the
/// problem states do not matter.
///   Above: fits propose parameters, validated runs count what they violate. Below: branch and
///   bound over the prior (`outlier_count_search`).
/// @throws std::invalid_argument  for an invalid problem
/// @guarantee  both ends of every count are proved, whenever the search ends; `exact` counts are
///             the smallest ones
/// @cost  a fit for each outlier removed, and a set inversion with q-relaxed tests
[[nodiscard]] SIVID_DECL smallest_budget smallest_outlier_budget(
    identification_problem const& problem, outlier_search_options const& options = {});

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/paving/impl/outlier_budget.ipp>
#endif

#endif
