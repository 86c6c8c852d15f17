// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_EXCLUDED_BETWEEN_HPP
#define SIVID_PAVING_EXCLUDED_BETWEEN_HPP

#include <sivid/number/interval_traits.hpp>
#include <sivid/paving/subpaving.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace sivid {

/// How much of a side of the prior is excluded between the ends of a hull, whatever the other sides
/// are: no box but those proved outside has a point there.
/// @param boxes  cover all that is not proved outside
/// @param prior  the side's
/// @param hull   of that side: contains all that is not proved outside
/// @returns  a share of the side's width in the prior; 0 where it has none
/// @guarantee  rounded down: at least so much is excluded
/// @cost  O(n log n) in the boxes
[[nodiscard]] inline double excluded_between(std::vector<paved_box> const& boxes,
                                             interval const& prior, interval const& hull,
                                             std::size_t side) {
    using traits = interval_traits<interval>;
    if (!(prior.lower() < prior.upper()) || is_empty(hull)) return 0;
    std::vector<std::pair<double, double>> left;
    for (auto const& b : boxes)
        if (b.verdict != box_verdict::outside && !is_empty(b.set))
            left.emplace_back(b.set[side].lower(), b.set[side].upper());
    std::sort(left.begin(), left.end());
    interval sum{0.0};
    double reached = hull.lower();
    auto const gap_until = [&](double end) {
        end = std::min(end, hull.upper());
        if (end > reached)
            sum = traits::add(sum, traits::sub(traits::point(end), traits::point(reached)));
    };
    for (auto const& [from, to] : left) {
        gap_until(from);
        reached = std::max(reached, to);
    }
    if (sum.upper() == 0) return 0;
    bool undefined = false;
    auto const whole = traits::sub(traits::point(prior.upper()), traits::point(prior.lower()));
    auto const share = traits::div(sum, whole, undefined);
    return undefined || !std::isfinite(share.lower()) ? 0 : std::clamp(share.lower(), 0.0, 1.0);
}
[[nodiscard]] inline double excluded_between(subpaving const& paving, box const& hull,
                                             std::size_t side) {
    return is_empty(hull)
               ? 0
               : excluded_between(paving.boxes(), paving.prior()[side], hull[side], side);
}

} // namespace sivid

#endif
