// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPL_DECISION_IPP
#define SIVID_IMPL_DECISION_IPP

#include <sivid/decision/design/impl/design_goal.ipp>
#include <sivid/decision/impl/control_law.ipp>
#include <sivid/decision/impl/experiment_design.ipp>
#include <sivid/decision/impl/gain_search.ipp>
#include <sivid/decision/impl/measurement_ranking.ipp>
#include <sivid/decision/impl/prediction.ipp>
#include <sivid/decision/impl/promised_width.ipp>
#include <sivid/decision/impl/rank.ipp>
#include <sivid/decision/impl/requirement.ipp>
#include <sivid/decision/impl/verification.ipp>
#include <sivid/decision/motion/impl/motion_cover.ipp>
#include <sivid/decision/requirement/impl/robustness.ipp>

#endif
