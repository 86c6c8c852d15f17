// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_DIAGNOSE_HPP
#define SIVID_DIAGNOSIS_DIAGNOSE_HPP

#include <sivid/compiled.hpp>
#include <sivid/diagnosis/diagnosis_run.hpp>
#include <sivid/model/effect.hpp>
#include <sivid/model/problem.hpp>

#include <vector>

namespace sivid {

/// Says whether a model explains a campaign; if not, by how much it misses, and which effects of a
/// catalogue explain what is missing.
/// @throws std::invalid_argument  for an invalid problem, an effect that cannot be joined to the
///         model, and effects without names of their own (`require_distinct`)
/// @guarantee  what is called proved, certified, excluded or explained is a theorem under the
///             assumptions listed; the rest is an estimate (`diagnosis`)
/// @cost  a fit for each effect and each pair, validated runs for the best: seconds for three
///        parameters and twenty effects, at most the budget
[[nodiscard]] SIVID_DECL diagnosis_run diagnose(identification_problem problem,
                                                std::vector<effect> catalogue,
                                                diagnosis_options options = {});

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/diagnosis/impl/diagnose.ipp>
#endif

#endif
