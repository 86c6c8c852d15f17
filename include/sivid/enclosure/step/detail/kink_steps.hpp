// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_STEP_DETAIL_KINK_STEPS_HPP
#define SIVID_ENCLOSURE_STEP_DETAIL_KINK_STEPS_HPP

/// @file
/// How sets of either kind cross a kink. All of it are preferences; no proof rests on them.

#include <sivid/enclosure/options.hpp>

#include <algorithm>
#include <cstddef>

namespace sivid::enclosure_detail {

/// Steps of first order, at most, that are kept short to cross a kink with little loss. A set that
/// needs more rests on the kink, and loses it all however short the steps are.
inline constexpr std::size_t crossing_steps = 20;

/// The shortest step; across a kink a thousandth of what the options say.
[[nodiscard]] inline double shortest_step(enclosure_options const& o, bool crosses) {
    return (crosses ? 1e-3 : 1.0) * o.shortest_step();
}
/// The same of a set that touches a root of 0. Beyond it series reach about as far as the state is
/// from 0: the step has to bring it so far that theirs are longer than the shortest.
[[nodiscard]] inline double step_off_root(enclosure_options const& o) {
    return 5 * o.shortest_step();
}
/// Share of what a set spans that one step across a kink may lose.
[[nodiscard]] inline double kink_share(enclosure_options const& o) {
    return std::min(0.02, 1e3 * o.relative_tolerance);
}
/// Where a set rests on a kink, steps of this length are always short enough.
[[nodiscard]] inline double resting_step(enclosure_options const& o) {
    return 1e-5 * o.span * std::min(1.0, o.minimum_step / 1e-8);
}

} // namespace sivid::enclosure_detail

#endif
