// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CANDIDATE_DETAIL_EFFECT_SETS_HPP
#define SIVID_DIAGNOSIS_CANDIDATE_DETAIL_EFFECT_SETS_HPP

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace sivid {

/// Effects that act together, by their numbers in a catalogue, in this order.
using effect_set = std::vector<std::size_t>;
using effect_sets = std::vector<effect_set>;

[[nodiscard]] inline effect_set united(effect_set set, std::size_t one) {
    set.insert(std::upper_bound(set.begin(), set.end(), one), one);
    return set;
}
/// Each of the sets with every one of the effects that it lacks.
[[nodiscard]] inline effect_sets joined(effect_sets const& sets, effect_set const& effects) {
    effect_sets result;
    for (auto const& set : sets) {
        for (auto const e : effects) {
            if (std::find(set.begin(), set.end(), e) != set.end()) continue;
            auto more = united(set, e);
            if (std::find(result.begin(), result.end(), more) == result.end())
                result.push_back(std::move(more));
        }
    }
    return result;
}

} // namespace sivid

#endif
