// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RESPONSE_RELAXED_INTERSECTION_HPP
#define SIVID_PAVING_RESPONSE_RELAXED_INTERSECTION_HPP

#include <sivid/number/interval_traits.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace sivid {

/// The hull of all points that lie in at least n - q of n intervals.
/// @guarantee  contains every such point; empty when there is none
/// @cost  O(n log n), a sweep over the sorted end points
/// @ref   Jaulin, Reliable Computing 13 (2009): q-relaxed intersection
[[nodiscard]] inline interval relaxed_intersection(std::vector<interval> const& sets,
                                                   std::size_t q) {
    using traits = interval_traits<interval>;
    std::size_t const n = sets.size();
    if (q >= n) return traits::entire();
    std::vector<std::pair<double, int>> ends; // closed sets: at equal places openings come first
    ends.reserve(2 * n);
    for (auto const& s : sets) {
        if (is_empty(s)) continue;
        ends.emplace_back(s.lower(), -1);
        ends.emplace_back(s.upper(), 1);
    }
    std::sort(ends.begin(), ends.end());
    std::size_t const needed = n - q;
    std::size_t depth = 0;
    bool found = false;
    double lo = 0;
    double hi = 0;
    for (auto const& [place, kind] : ends) {
        if (kind < 0) {
            if (++depth == needed && !found) {
                lo = place;
                found = true;
            }
        } else {
            if (depth == needed) hi = place;
            --depth;
        }
    }
    return found ? traits::bounds(lo, hi) : traits::empty();
}

} // namespace sivid

#endif
