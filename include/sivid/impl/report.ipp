// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPL_REPORT_IPP
#define SIVID_IMPL_REPORT_IPP

#include <sivid/report/draw/impl/axes.ipp>
#include <sivid/report/draw/impl/charts.ipp>
#include <sivid/report/draw/impl/paving_plot.ipp>
#include <sivid/report/draw/impl/svg.ipp>
#include <sivid/report/draw/impl/time_plot.ipp>
#include <sivid/report/impl/decision_page.ipp>
#include <sivid/report/impl/diagnosis_page.ipp>
#include <sivid/report/impl/identification_page.ipp>
#include <sivid/report/impl/identification_report.ipp>
#include <sivid/report/impl/number_text.ipp>
#include <sivid/report/impl/page.ipp>
#include <sivid/report/impl/stored_page.ipp>

#endif
