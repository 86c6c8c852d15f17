// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPL_MODEL_IPP
#define SIVID_IMPL_MODEL_IPP

#include <sivid/model/change/impl/changed_formulas.ipp>
#include <sivid/model/change/impl/slower_inputs.ipp>
#include <sivid/model/graph/impl/graph.ipp>
#include <sivid/model/graph/impl/graph_listing.ipp>
#include <sivid/model/graph/impl/linear_solution.ipp>
#include <sivid/model/impl/affected_problem.ipp>
#include <sivid/model/impl/bound_model.ipp>
#include <sivid/model/impl/closed_loop.ipp>
#include <sivid/model/impl/describe.ipp>
#include <sivid/model/impl/disturbance.ipp>
#include <sivid/model/impl/effect.ipp>
#include <sivid/model/impl/effect_names.ipp>
#include <sivid/model/impl/effect_scope.ipp>
#include <sivid/model/impl/effects.ipp>
#include <sivid/model/impl/expression.ipp>
#include <sivid/model/impl/implicit_model.ipp>
#include <sivid/model/impl/missing_term.ipp>
#include <sivid/model/impl/model.ipp>
#include <sivid/model/impl/named_effects.ipp>
#include <sivid/model/impl/to_dot.ipp>
#include <sivid/model/impl/unit.ipp>
#include <sivid/model/structure/impl/find_combinations.ipp>
#include <sivid/model/structure/impl/state_sum.ipp>
#include <sivid/model/structure/impl/symmetry.ipp>

#endif
