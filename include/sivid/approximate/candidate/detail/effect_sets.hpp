// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_CANDIDATE_DETAIL_EFFECT_SETS_HPP
#define SIVID_APPROXIMATE_CANDIDATE_DETAIL_EFFECT_SETS_HPP

#include <algorithm>
#include <cstddef>
#include <stdexcept>
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
/// Sets that cannot be joined to a model: one of their effects needs what another one changes (a
/// lag begins at what an input is then, which may depend on a state).
class impossible_sets {
public:
    [[nodiscard]] bool has(effect_set const& set) const {
        return std::find(sets_.begin(), sets_.end(), set) != sets_.end();
    }
    /// @param join  throws std::invalid_argument, or std::domain_error, where that cannot be
    template <class Join>
    [[nodiscard]] bool allow(effect_set const& set, Join const& join) {
        if (has(set)) return false;
        try {
            join();
            return true;
        } catch (std::invalid_argument const&) {
        } catch (std::domain_error const&) {
        }
        sets_.push_back(set);
        return false;
    }

private:
    effect_sets sets_;
};

/// Each of the sets with every one of the effects that it lacks.
[[nodiscard]] inline effect_sets sets_joined(effect_sets const& sets, effect_set const& effects,
                                             impossible_sets const& but = {}) {
    effect_sets result;
    for (auto const& set : sets) {
        for (auto const e : effects) {
            if (std::find(set.begin(), set.end(), e) != set.end()) continue;
            auto more = united(set, e);
            if (!but.has(more) && std::find(result.begin(), result.end(), more) == result.end())
                result.push_back(std::move(more));
        }
    }
    return result;
}

} // namespace sivid

#endif
