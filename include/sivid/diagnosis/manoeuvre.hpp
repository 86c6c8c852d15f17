// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_MANOEUVRE_HPP
#define SIVID_DIAGNOSIS_MANOEUVRE_HPP

#include <sivid/approximate/candidate/screened.hpp>
#include <sivid/compiled.hpp>
#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/model/manoeuvre.hpp>

#include <functional>
#include <optional>
#include <vector>

namespace sivid {

/// The manoeuvre among those given that tells candidates apart best, its settings optimised.
/// Predicted at the candidates' fits, which a further fit may partly make up for; not a proof.
/// @param measured  says how channels are measured: within which bounds, and how often
/// @param go_on     asked before and within simulations; false ends with the best found by then;
///                  may be empty
/// @returns nothing when there are fewer than two candidates or no manoeuvre can be simulated
[[nodiscard]] SIVID_DECL std::optional<next_experiment>
propose_experiment(std::vector<screened const*> candidates, std::vector<manoeuvre> const& menu,
                   identification_problem const& measured, std::function<bool()> const& go_on = {});

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/diagnosis/impl/manoeuvre.ipp>
#endif

#endif
