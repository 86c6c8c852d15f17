// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_DETAIL_RATE_STRETCH_HPP
#define SIVID_PAVING_RELATION_DETAIL_RATE_STRETCH_HPP

#include <sivid/number/interval_traits.hpp>

#include <algorithm>
#include <vector>

namespace sivid {

/// What a rate may do over a stretch of time: rise and fall in proportion to the time in it, and
/// beside that at any moment; and where it lies.
struct rate_stretch {
    double from = 0, to = 0;
    double rise = 0, fall = 0; ///< over the whole stretch, at most
    double up = 0, down = 0;   ///< at any moment in it, at most
    interval range{0.0};
};

/// What a rate may change by at most between two times: by what the stretches add up to in one
/// direction, and by no more than the width of where they lie.
/// @given  adjacent stretches, in the order of time
[[nodiscard]] inline double most_change(std::vector<rate_stretch> const& all, double from,
                                        double to) {
    using traits = interval_traits<interval>;
    double rise = 0, fall = 0;
    auto range = traits::empty();
    auto s = std::upper_bound(all.begin(), all.end(), from,
                              [](double t, rate_stretch const& x) { return t < x.to; });
    for (; s != all.end() && s->from < to; ++s) {
        double const inside = std::min(to, s->to) - std::max(from, s->from);
        double const share = std::min(1.0, inside / (s->to - s->from) * (1 + 1e-12));
        rise = detail::add_up(rise, detail::add_up(detail::mul_up(share, s->rise), s->up));
        fall = detail::add_up(fall, detail::add_up(detail::mul_up(share, s->fall), s->down));
        range = traits::hull(range, s->range);
    }
    if (is_empty(range)) return detail::infinity; // nothing is known of that time
    return std::min(std::max(rise, fall), width(range));
}
/// The same within any time of one length.
[[nodiscard]] inline double most_change(std::vector<rate_stretch> const& all, double period) {
    double most = 0;
    // The sums are piecewise linear in where the window begins: an end lies at one of a stretch.
    for (auto const& s : all) {
        most = std::max(most, most_change(all, s.from, s.from + period));
        most = std::max(most, most_change(all, std::max(s.to - period, all.front().from), s.to));
    }
    return most;
}

} // namespace sivid

#endif
