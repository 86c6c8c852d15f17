// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_FILL_DETAIL_DIAGNOSIS_PLOT_DATA_HPP
#define SIVID_REPORT_FILL_DETAIL_DIAGNOSIS_PLOT_DATA_HPP

#include <sivid/approximate/approximate_fit.hpp>
#include <sivid/compiled.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/report/diagnosis_view.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace sivid::report {

namespace detail {

/// Marks the q largest misfits beyond their bounds; none without an outlier budget.
SIVID_DECL std::vector<bool> suspects(std::vector<double> const& residuals, std::size_t n,
                                      std::size_t q);

} // namespace detail

/// The measurements of every experiment with the outputs of two fits to them, at the samples. A fit
/// without residuals is not drawn. Suspected outliers are the largest misfits of the second fit (of
/// the first when there is no second), as many as the budget allows.
/// @pre  both fits are of problems with these measurements, with whatever effects
[[nodiscard]] SIVID_DECL std::vector<compared_scenario>
compared_scenarios(identification_problem const& problem, approximate_fit const& base,
                   approximate_fit const& after = {}, bool holdout = false);

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/fill/impl/diagnosis_plot_data.ipp>
#endif

#endif
