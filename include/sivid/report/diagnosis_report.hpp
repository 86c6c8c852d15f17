// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DIAGNOSIS_REPORT_HPP
#define SIVID_REPORT_DIAGNOSIS_REPORT_HPP

#include <sivid/compiled.hpp>
#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/model/effect.hpp>
#include <sivid/report/diagnosis_page.hpp>
#include <sivid/report/diagnosis_view.hpp>
#include <sivid/report/fill/detail/diagnosis_plot_data.hpp>

#include <vector>

namespace sivid::report {

/// Takes the meanings of a catalogue of effects into the options.
SIVID_DECL void describe(std::vector<effect> const& catalogue, diagnosis_report_options& options);

/// What the page of a diagnosis shows.
/// @cost  O(size of the plot data)
[[nodiscard]] SIVID_DECL diagnosis_view view_of(diagnosis const& d, diagnosis_plot_data plots = {},
                                                diagnosis_report_options options = {});

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/impl/diagnosis_report.ipp>
#endif

#endif
