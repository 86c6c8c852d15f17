// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPL_REPORT_IPP
#define SIVID_IMPL_REPORT_IPP

#include <sivid/report/impl/decision_page.ipp>
#include <sivid/report/impl/diagnosis_page.ipp>
#include <sivid/report/impl/identification_report.ipp>
#include <sivid/report/impl/page.ipp>
#include <sivid/report/impl/stored_page.ipp>

#endif
