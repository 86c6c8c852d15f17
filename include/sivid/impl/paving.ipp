// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPL_PAVING_IPP
#define SIVID_IMPL_PAVING_IPP

#include <sivid/paving/impl/holdout_inflation.ipp>
#include <sivid/paving/impl/identify.ipp>
#include <sivid/paving/impl/inflation.ipp>
#include <sivid/paving/impl/outlier_budget.ipp>
#include <sivid/paving/impl/response_judgement.ipp>
#include <sivid/paving/impl/run_reach.ipp>
#include <sivid/paving/impl/window_contraction.ipp>

#endif
