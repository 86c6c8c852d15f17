// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPL_APP_DECISION_IPP
#define SIVID_IMPL_APP_DECISION_IPP

#include <sivid/app/impl/decide.ipp>
#include <sivid/app/impl/design.ipp>
#include <sivid/app/impl/export.ipp>
#include <sivid/app/impl/rank.ipp>

#endif
