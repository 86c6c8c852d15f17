// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPL_REPORT_IPP
#define SIVID_IMPL_REPORT_IPP

#include <sivid/report/draw/impl/bar_chart.ipp>
#include <sivid/report/draw/impl/candidate_chart.ipp>
#include <sivid/report/draw/impl/channel_series.ipp>
#include <sivid/report/draw/impl/comparison_plot.ipp>
#include <sivid/report/draw/impl/heat_map.ipp>
#include <sivid/report/draw/impl/interval_chart.ipp>
#include <sivid/report/draw/impl/legend.ipp>
#include <sivid/report/draw/impl/missing_rate_plot.ipp>
#include <sivid/report/draw/impl/motion_plot.ipp>
#include <sivid/report/draw/impl/paving_plot.ipp>
#include <sivid/report/draw/impl/paving_projections.ipp>
#include <sivid/report/draw/impl/paving_raster.ipp>
#include <sivid/report/draw/impl/plane_plot.ipp>
#include <sivid/report/draw/impl/svg.ipp>
#include <sivid/report/draw/impl/ticks.ipp>
#include <sivid/report/draw/impl/time_plot.ipp>
#include <sivid/report/fill/impl/diagnosis_plot_data.ipp>
#include <sivid/report/impl/control_page.ipp>
#include <sivid/report/impl/decision_page.ipp>
#include <sivid/report/impl/design_page.ipp>
#include <sivid/report/impl/diagnosis_page.ipp>
#include <sivid/report/impl/diagnosis_report.ipp>
#include <sivid/report/impl/diagnosis_words.ipp>
#include <sivid/report/impl/identifiability_words.ipp>
#include <sivid/report/impl/identification_page.ipp>
#include <sivid/report/impl/identification_report.ipp>
#include <sivid/report/impl/identification_words.ipp>
#include <sivid/report/impl/number_text.ipp>
#include <sivid/report/impl/page.ipp>
#include <sivid/report/impl/ranking_page.ipp>
#include <sivid/report/impl/reach_words.ipp>
#include <sivid/report/impl/table.ipp>
#include <sivid/report/page/impl/advice.ipp>
#include <sivid/report/page/impl/diagnosis_figures.ipp>
#include <sivid/report/page/impl/diagnosis_tables.ipp>
#include <sivid/report/page/impl/identification_parameters.ipp>
#include <sivid/report/text/impl/escape.ipp>
#include <sivid/report/text/impl/rounded_decimal.ipp>
#include <sivid/report/words/impl/place_words.ipp>

#endif
