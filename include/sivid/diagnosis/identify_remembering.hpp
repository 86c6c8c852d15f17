// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_IDENTIFY_REMEMBERING_HPP
#define SIVID_DIAGNOSIS_IDENTIFY_REMEMBERING_HPP

#include <sivid/compiled.hpp>
#include <sivid/diagnosis/candidate/effect_hull_options.hpp>
#include <sivid/model/effect.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/identification.hpp>

#include <vector>

namespace sivid {

/// Identifies a model with effects over whose ranges no run goes: those that remember (delays,
/// plays, rate limits, late sensors), and lags that begin where other effects say. Hulls of all
/// parameters come from slices of these
/// (`effect_hulls`), and a fit is verified at its own values.
///   The paving is one box, the hull, and what lies outside is excluded by proof; there are no
/// inside boxes, and nothing is kept for a check.
/// @param base     without the effects
/// @param options  the limits; the fit and its verification take at most a third of the time
/// @guarantee  every parameter of `affected(base, effects)` that explains the data lies in the
///             hull; consistent: the witness explains them
/// @throws std::invalid_argument  as `affected`
/// @cost  a fit, a run for each experiment, searches of slices until they rest
[[nodiscard]] SIVID_DECL identification identify_remembering(identification_problem const& base,
                                                             std::vector<effect> const& effects,
                                                             effect_hull_options options = {});

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/diagnosis/impl/identify_remembering.ipp>
#endif

#endif
