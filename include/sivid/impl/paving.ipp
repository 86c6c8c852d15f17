// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPL_PAVING_IPP
#define SIVID_IMPL_PAVING_IPP

#include <sivid/paving/contract/impl/window_contraction.ipp>
#include <sivid/paving/curve/impl/curve_family.ipp>
#include <sivid/paving/curve/impl/shaped_problem.ipp>
#include <sivid/paving/impl/complete.ipp>
#include <sivid/paving/impl/identify.ipp>
#include <sivid/paving/impl/inflation.ipp>
#include <sivid/paving/impl/outlier_budget.ipp>
#include <sivid/paving/inflation/impl/holdout_inflation.ipp>
#include <sivid/paving/judge/impl/response_judgement.ipp>
#include <sivid/paving/observer/impl/observer_contraction.ipp>
#include <sivid/paving/relation/impl/relation_contraction.ipp>
#include <sivid/paving/run/impl/run_reach.ipp>
#include <sivid/paving/strategy/impl/default_strategy.ipp>
#include <sivid/paving/strategy/impl/strategy.ipp>

#endif
