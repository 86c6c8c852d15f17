// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CANDIDATE_DETAIL_PROPOSED_TERMS_HPP
#define SIVID_DIAGNOSIS_CANDIDATE_DETAIL_PROPOSED_TERMS_HPP

#include <sivid/approximate/place/estimated_place.hpp>
#include <sivid/model/named_effects.hpp>

#include <cstddef>
#include <stdexcept>
#include <vector>

namespace sivid {

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

#endif
