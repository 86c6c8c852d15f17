// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_PAGE_DETAIL_DIAGNOSIS_FIGURES_HPP
#define SIVID_REPORT_PAGE_DETAIL_DIAGNOSIS_FIGURES_HPP

#include <sivid/compiled.hpp>
#include <sivid/report/diagnosis_words.hpp>
#include <sivid/report/draw/candidate_chart.hpp>
#include <sivid/report/draw/comparison_plot.hpp>
#include <sivid/report/draw/heat_map.hpp>
#include <sivid/report/draw/missing_rate_plot.hpp>
#include <sivid/report/page.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

/// The figures of a diagnosis's page; one without panels has nothing to show.
namespace sivid::report {

/// One pair of maps for each scenario, all with the same colours.
[[nodiscard]] SIVID_DECL figure misfit_figure(diagnosis_view const& v);

/// One figure for each equation, with a panel for each scenario, all on one scale.
/// @param still  how the title goes on, "with rudder_lag"
[[nodiscard]] SIVID_DECL std::vector<figure>
missing_rate_figures(std::vector<missing_rate_series> const& rates, std::string const& still = {});

/// The channels of one scenario with both models' lines.
[[nodiscard]] SIVID_DECL figure motion_figure(compared_scenario const& s);

/// What is left of the gap with each of the foremost candidates.
[[nodiscard]] SIVID_DECL figure candidate_figure(diagnosis_view const& v, std::size_t most = 25);

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/page/impl/diagnosis_figures.ipp>
#endif

#endif
