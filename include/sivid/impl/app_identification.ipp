// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPL_APP_IDENTIFICATION_IPP
#define SIVID_IMPL_APP_IDENTIFICATION_IPP

#include <sivid/app/impl/check.ipp>
#include <sivid/app/impl/confidence.ipp>
#include <sivid/app/impl/diagnose.ipp>
#include <sivid/app/impl/disturbance.ipp>
#include <sivid/app/impl/identify.ipp>
#include <sivid/app/impl/report.ipp>

#endif
