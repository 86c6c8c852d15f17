// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_CANDIDATE_DETAIL_BEYOND_PRIOR_HPP
#define SIVID_APPROXIMATE_CANDIDATE_DETAIL_BEYOND_PRIOR_HPP

#include <sivid/approximate/candidate/screened.hpp>
#include <sivid/model/effect.hpp>
#include <sivid/model/prior_end.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// The index of the effect of this name in a catalogue, to which it is added where it is not there.
[[nodiscard]] inline std::size_t index_of_effect(std::vector<effect>& catalogue, effect e) {
    auto const known = std::find_if(catalogue.begin(), catalogue.end(),
                                    [&e](effect const& x) { return x.name == e.name; });
    auto const index = static_cast<std::size_t>(known - catalogue.begin());
    if (known == catalogue.end()) catalogue.push_back(std::move(e));
    return index;
}

/// Whether the fit of an effect's parameters ends where its prior does and a wider one does not.
[[nodiscard]] inline bool ends_at_prior(screened const& s, effect const& e, effect const& wider) {
    auto const& names = s.problem.choice.unknown;
    for (std::size_t k = 0; k < e.parameters.size(); ++k) {
        auto const name = e.name + "." + e.parameters[k].name;
        auto const j =
            static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
        auto const own = e.parameters[k].prior(), wide = wider.parameters[k].prior();
        auto const end = end_of_prior(s.fit.parameters.at(j), own);
        if (end == prior_end::lower && wide.lower() < own.lower()) return true;
        if (end == prior_end::upper && wide.upper() > own.upper()) return true;
    }
    return false;
}

/// The effects of a candidate, `widened` ones for those whose fit ends at its prior. Those that
/// count turns stay: the prior of T tells how many there were.
/// @param catalogue  of the candidate; wider effects are added behind the `planned` ones
[[nodiscard]] inline std::vector<std::size_t>
beyond_prior(screened const& s, std::vector<effect>& catalogue, std::size_t planned) {
    auto effects = s.figures.effects;
    for (auto& e : effects) {
        if (e >= planned || catalogue[e].wraps) continue;
        auto wider = widened(catalogue[e]);
        if (!ends_at_prior(s, catalogue[e], wider)) continue;
        e = index_of_effect(catalogue, std::move(wider));
    }
    std::sort(effects.begin(), effects.end());
    return effects;
}

} // namespace sivid

#endif
