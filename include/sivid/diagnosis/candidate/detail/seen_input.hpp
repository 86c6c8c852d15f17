// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CANDIDATE_DETAIL_SEEN_INPUT_HPP
#define SIVID_DIAGNOSIS_CANDIDATE_DETAIL_SEEN_INPUT_HPP

#include <sivid/measurement/signal.hpp>
#include <sivid/number/interval.hpp>
#include <sivid/number/interval_traits.hpp>

#include <algorithm>
#include <cstddef>

namespace sivid {

namespace diagnosis_detail {

/// What a recorded input is over some times.
struct seen_input {
    interval values; ///< all of them, errors left out
    double steepest = 0;
    double error = 0; ///< the largest bound
};

/// @param from, until  clipped to `begin` and later; until >= from
inline seen_input seen_between(sampled_signal const& u, double begin, double from, double until) {
    from = std::max(from, begin);
    until = std::max(until, from);
    seen_input seen;
    seen.values = interval_traits<interval>::empty();
    // A knot belongs to both of its pieces.
    auto first = u.piece(from);
    if (first > 0 && u.times()[first] == from) --first;
    for (auto k = first; k == first || (k < u.times().size() && u.times()[k] <= until); ++k) {
        bool const last = k + 1 >= u.times().size();
        double const low = k == first ? from : u.times()[k];
        double const high = last ? until : std::min(until, u.times()[k + 1]);
        seen.values = hull(seen.values, u.value<interval>(k, interval(low, std::max(low, high))));
        seen.steepest = std::max(seen.steepest, mag(u.slope<interval>(k)));
        seen.error = std::max({seen.error, u.error_bound(k, low), u.error_bound(k, high)});
        if (last) break;
        // The last piece of straight lines goes on to the right.
        if (u.kind() == interpolation::linear && k + 2 == u.times().size()) {
            if (until > high) {
                seen.values = hull(seen.values, u.value<interval>(k, interval(high, until)));
            }
            seen.error = std::max(seen.error, u.error_bound(k, until));
            break;
        }
    }
    return seen;
}

} // namespace diagnosis_detail

} // namespace sivid

#endif
