// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CANDIDATE_DETAIL_PROPOSED_FAULTS_HPP
#define SIVID_DIAGNOSIS_CANDIDATE_DETAIL_PROPOSED_FAULTS_HPP

#include <sivid/approximate/place/estimated_place.hpp>
#include <sivid/compiled.hpp>
#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/model/effect.hpp>
#include <sivid/model/named_effects.hpp>
#include <sivid/model/problem.hpp>

#include <cstddef>
#include <stdexcept>
#include <vector>

namespace sivid {

/// Faults of the instruments that may be what is wrong, of every kind that they may have
/// (`sensor_fault`): of those that are suspected places, that were found to explain the data, or
/// whose channel alone stands against the model; and of each with another one of its unit, which
/// may be one instrument. Sizes reach as far as the measurements: an offset as their range, times
/// an eighth of the longest experiment.
[[nodiscard]] SIVID_DECL std::vector<effect>
proposed_faults(identification_problem const& problem, place_estimate const& estimate,
                std::vector<confined_gap> const& confined);

/// Terms that the most important of the equations that seem wrong may lack; those whose formulas
/// cannot be read are left out, as names of a model may be any.
[[nodiscard]] inline std::vector<effect> proposed_terms(place_estimate const& estimate) {
    constexpr std::size_t most_equations = 2;
    std::vector<effect> terms;
    std::size_t equations = 0;
    for (auto const& p : estimate.places) {
        if (p.kind != place_kind::equation || ++equations > most_equations) continue;
        for (auto const& name : p.terms) {
            try {
                terms.push_back(missing_term(name));
            } catch (std::invalid_argument const&) {
            }
        }
    }
    return terms;
}

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/diagnosis/candidate/impl/proposed_faults.ipp>
#endif

#endif
