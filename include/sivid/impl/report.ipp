// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPL_REPORT_IPP
#define SIVID_IMPL_REPORT_IPP

#include <sivid/report/impl/bar_chart.ipp>
#include <sivid/report/impl/candidate_chart.ipp>
#include <sivid/report/impl/channel_series.ipp>
#include <sivid/report/impl/comparison_plot.ipp>
#include <sivid/report/impl/control_page.ipp>
#include <sivid/report/impl/decision_page.ipp>
#include <sivid/report/impl/design_page.ipp>
#include <sivid/report/impl/diagnosis_figures.ipp>
#include <sivid/report/impl/diagnosis_page.ipp>
#include <sivid/report/impl/diagnosis_plot_data.ipp>
#include <sivid/report/impl/diagnosis_report.ipp>
#include <sivid/report/impl/diagnosis_tables.ipp>
#include <sivid/report/impl/diagnosis_words.ipp>
#include <sivid/report/impl/escape.ipp>
#include <sivid/report/impl/heat_map.ipp>
#include <sivid/report/impl/holdout_tables.ipp>
#include <sivid/report/impl/identifiability_words.ipp>
#include <sivid/report/impl/identification_page.ipp>
#include <sivid/report/impl/identification_parameters.ipp>
#include <sivid/report/impl/identification_report.ipp>
#include <sivid/report/impl/identification_words.ipp>
#include <sivid/report/impl/interval_chart.ipp>
#include <sivid/report/impl/legend.ipp>
#include <sivid/report/impl/missing_rate_plot.ipp>
#include <sivid/report/impl/motion_plot.ipp>
#include <sivid/report/impl/number_text.ipp>
#include <sivid/report/impl/page.ipp>
#include <sivid/report/impl/paving_plot.ipp>
#include <sivid/report/impl/paving_projections.ipp>
#include <sivid/report/impl/paving_raster.ipp>
#include <sivid/report/impl/place_words.ipp>
#include <sivid/report/impl/plane_plot.ipp>
#include <sivid/report/impl/ranking_page.ipp>
#include <sivid/report/impl/reach_words.ipp>
#include <sivid/report/impl/residual_plot.ipp>
#include <sivid/report/impl/rounded_decimal.ipp>
#include <sivid/report/impl/svg.ipp>
#include <sivid/report/impl/table.ipp>
#include <sivid/report/impl/ticks.ipp>
#include <sivid/report/impl/time_plot.ipp>

#endif
