// SPDX-License-Identifier: MIT
#ifndef SIVID_SPACE_BOX_LANES_HPP
#define SIVID_SPACE_BOX_LANES_HPP

#include <sivid/number/text/needed_given.hpp>
#include <sivid/space/box.hpp>

#include <concepts>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace sivid {

/// The value of a mask in one lane.
[[nodiscard]] constexpr bool lane_of(bool m, std::size_t) { return m; }
template <std::unsigned_integral M>
    requires(!std::same_as<M, bool>)
[[nodiscard]] constexpr bool lane_of(M m, std::size_t lane) { return (m >> lane & 1) != 0; }

/// The box in a lane of x, in the vocabulary type.
/// @guarantee  contains it: where bounds are no doubles, they are rounded outward
template <interval_scalar I>
[[nodiscard]] box lane_of(basic_box<I> const& x, std::size_t lane = 0) {
    using traits = interval_traits<I>;
    box result(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
        result[i] = detail::bounded(traits::lower(x[i], lane), traits::upper(x[i], lane));
    }
    return result;
}

/// Boxes of the vocabulary type side by side: lane k contains boxes[k], lanes beyond the last are
/// empty. With a type of one lane, the one box in that type.
/// @throws std::invalid_argument  for no boxes, more than there are lanes, or of different sizes
template <interval_scalar I>
[[nodiscard]] basic_box<I> side_by_side(std::vector<box> const& boxes) {
    using traits = interval_traits<I>;
    if (boxes.empty() || boxes.size() > traits::lanes) {
        throw std::invalid_argument("side_by_side: one box at least, one for each lane at most" +
                                    needed_given(traits::lanes, boxes.size()));
    }
    for (auto const& x : boxes) {
        if (x.size() != boxes[0].size())
            throw std::invalid_argument("side_by_side: boxes of different sizes, " +
                                        std::to_string(boxes[0].size()) + " and " +
                                        std::to_string(x.size()) + " sides");
    }
    basic_box<I> result(boxes[0].size());
    for (std::size_t i = 0; i < result.size(); ++i) {
        if constexpr (single_interval<I>) {
            result[i] = traits::bounds(boxes[0][i].lower(), boxes[0][i].upper());
        } else {
            auto const bound = [&](std::size_t k, double (*of)(interval const&) noexcept) {
                return k < boxes.size() ? of(boxes[k][i]) : detail::not_a_number;
            };
            result[i] = traits::from_lanes([&](std::size_t k) { return bound(k, lower); },
                                           [&](std::size_t k) { return bound(k, upper); });
        }
    }
    return result;
}

/// Whether y is not empty and each of its members lies in `bound`, lane by lane. In type I the
/// bound itself may be wider than it is (`bounds` rounds outward), so it is not asked there.
/// @given  a type of several lanes holds doubles exactly
template <interval_scalar I>
[[nodiscard]] lane_mask<I> lies_in(I const& y, interval const& bound) {
    using traits = interval_traits<I>;
    if constexpr (single_interval<I>) {
        auto const seen = detail::bounded(traits::lower(y, 0), traits::upper(y, 0));
        return !sivid::is_empty(seen) && sivid::subset(seen, bound);
    } else {
        return traits::subset(y, traits::bounds(bound.lower(), bound.upper())) &
               ~traits::is_empty(y);
    }
}
/// Whether y is not empty and none of its members lies in `bound`, lane by lane.
template <interval_scalar I>
[[nodiscard]] lane_mask<I> misses(I const& y, interval const& bound) {
    using traits = interval_traits<I>;
    if constexpr (single_interval<I>) {
        auto const seen = detail::bounded(traits::lower(y, 0), traits::upper(y, 0));
        return !sivid::is_empty(seen) && sivid::disjoint(seen, bound);
    } else {
        return traits::disjoint(y, traits::bounds(bound.lower(), bound.upper())) &
               ~traits::is_empty(y);
    }
}

/// A box of the vocabulary type in type I; in every lane, where there are several.
/// @guarantee  contains x
template <interval_scalar I>
[[nodiscard]] basic_box<I> box_in(box const& x) {
    basic_box<I> result(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
        result[i] = interval_traits<I>::bounds(x[i].lower(), x[i].upper());
    }
    return result;
}

} // namespace sivid

#endif
