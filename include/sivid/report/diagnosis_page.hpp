// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DIAGNOSIS_PAGE_HPP
#define SIVID_REPORT_DIAGNOSIS_PAGE_HPP

#include <sivid/approximate/approximate_fit.hpp>
#include <sivid/compiled.hpp>
#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/model/effect.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/report/diagnosis_view.hpp>
#include <sivid/report/page.hpp>

#include <vector>

namespace sivid::report {

/// The whole page of a diagnosis. Sections without content are left out.
/// @throws nothing of its own
/// @guarantee  it proves nothing and reads no data: numbers are those of the view, bounds rounded
///   outward
/// @cost  text and pictures of the size of the view: milliseconds
[[nodiscard]] SIVID_DECL page diagnosis_page(diagnosis_view const& v);

/// The measurements of every experiment with the outputs of two fits to them, at the samples. A fit
/// without residuals is not drawn. Suspected outliers are the largest misfits of the second fit (of
/// the first when there is no second), as many as the budget allows.
/// @pre  both fits are of problems with these measurements, with whatever effects
[[nodiscard]] SIVID_DECL std::vector<compared_scenario>
compared_scenarios(identification_problem const& problem, approximate_fit const& base,
                   approximate_fit const& after = {}, bool holdout = false);

/// Takes the meanings of a catalogue of effects into the options.
SIVID_DECL void describe(std::vector<effect> const& catalogue, diagnosis_report_options& options);

/// What the page of a diagnosis shows.
/// @cost  O(size of the plot data)
[[nodiscard]] SIVID_DECL diagnosis_view view_of(diagnosis const& d, diagnosis_plot_data plots = {},
                                                diagnosis_report_options options = {});

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/impl/diagnosis_page.ipp>
#endif

#endif
