// SPDX-License-Identifier: MIT
#ifndef SIVID_MEASUREMENT_IMPL_PLAYED_SIGNAL_IPP
#define SIVID_MEASUREMENT_IMPL_PLAYED_SIGNAL_IPP

#include <sivid/measurement/played_signal.hpp>

#include <sivid/measurement/detail/widened_signal.hpp>
#include <sivid/number/interval_traits.hpp>
#include <sivid/number/text/nearest_text.hpp>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sivid {

namespace measurement_detail {

/// The output of a play along the pieces of its input, for one half-width.
class play {
    using traits = interval_traits<interval>;

public:
    play(interval const& begin, double half_width)
        : value_(begin), half_width_(interval(half_width)) {}

    [[nodiscard]] interval const& value() const { return value_; }
    [[nodiscard]] double slope_by_width() const { return side_; }

    /// Where within (0, 1) of a way from u to v, going one way, the gap closes; else 1.
    [[nodiscard]] double closes_at(interval const& u, interval const& v) const {
        double const from = mid(u), to = mid(v), p = mid(value_), b = mid(half_width_);
        double const edge = to > from ? p + b : p - b; // where u has to be
        double const share = (edge - from) / (to - from);
        return share > 0 && share < 1 ? share : 1;
    }
    /// The input goes one way, from a value to u.
    /// @returns  at most how far p was from the straight line between its values at both ends
    double follow(interval const& from, interval const& u, bool up) {
        interval const before = value_;
        interval const low = traits::sub(u, half_width_), high = traits::add(u, half_width_);
        if (mid(low) > mid(value_)) side_ = -1;
        if (mid(high) < mid(value_)) side_ = 1;
        auto const greater = [](interval const& a, interval const& b) {
            return interval(std::max(a.lower(), b.lower()), std::max(a.upper(), b.upper()));
        };
        auto const less = [](interval const& a, interval const& b) {
            return interval(std::min(a.lower(), b.lower()), std::min(a.upper(), b.upper()));
        };
        value_ = greater(low, less(high, value_));
        // It goes one way, too, and on the way up it is max(p, u - b), which is convex: below the
        // line by no more than p - (u - b) at the begin, as the difference of two straight lines.
        double const moved = mag(traits::sub(value_, before));
        auto const pushed = up ? traits::sub(from, half_width_) : traits::add(from, half_width_);
        return std::min(moved, mag(traits::sub(before, pushed)));
    }

private:
    interval value_, half_width_;
    double side_ = 0;
};

struct play_knot {
    double time;
    interval value;
    double far; ///< from the straight line to the next one
    double error;
};

/// The lines between the knots, with all that the output may be beside them.
inline sampled_signal lines_through(std::vector<play_knot> const& knots, interpolation kind,
                                    double spread) {
    widened_signal all(kind);
    double before = 0;
    for (auto const& k : knots) {
        all.add(k.time, k.value, std::max(before, k.far) + k.error + spread);
        before = k.far;
    }
    return std::move(all).take();
}

} // namespace measurement_detail

SIVID_DECL played_signal played(sampled_signal const& u, double begin, double end,
                                interval const& half_width) {
    if (!(half_width.lower() >= 0))
        throw std::invalid_argument("played: the half-width of a play is 0 or more, not from " +
                                    nearest_text(half_width.lower()) + " on");
    bool const holds = u.kind() == interpolation::hold;
    double const middle = mid(half_width);
    double const spread = mag(interval_traits<interval>::sub(half_width, interval(middle)));
    auto const grid = measurement_detail::grid_of(u.times(), begin, end);
    auto const value = [&](double t) { return u.value<interval>(u.piece(t), interval(t)); };

    std::vector<measurement_detail::play_knot> knots;
    played_signal result;
    measurement_detail::play p(value(begin), middle);
    double worst = u.error_bound(u.piece(begin), begin);
    knots.push_back({begin, p.value(), 0, worst});
    for (std::size_t k = 0; k + 1 < grid.size(); ++k) {
        double const t = grid[k], next = grid[k + 1];
        auto const piece = u.piece(t);
        worst = std::max({worst, u.error_bound(piece, t), u.error_bound(piece, next)});
        knots.back().error = std::max(knots.back().error, worst);
        auto const& values = u.values();
        bool const up = piece + 1 < values.size() && values[piece + 1] >= values[piece];
        auto const step = [&](double to, interval const& from, interval const& at) {
            double const far = p.follow(from, at, up);
            knots.back().far = holds ? 0 : far;
            knots.push_back({to, p.value(), 0, worst});
        };
        if (holds) {
            result.slope_by_width.push_back(p.slope_by_width());
            step(next, value(t), value(next));
            continue;
        }
        interval const from = value(t), to = u.value<interval>(piece, interval(next));
        double const turn = t + p.closes_at(from, to) * (next - t);
        if (t < turn && turn < next) {
            auto const there = u.value<interval>(piece, interval(turn));
            result.slope_by_width.push_back(p.slope_by_width()); // it rests until then
            step(turn, from, there);
            step(next, there, to);
        } else {
            step(next, from, to);
        }
        result.slope_by_width.push_back(p.slope_by_width());
    }
    knots.back().error = std::max(worst, u.error_bound(u.piece(grid.back()), grid.back()));
    if (holds) result.slope_by_width.push_back(p.slope_by_width());
    result.within = measurement_detail::lines_through(knots, u.kind(), spread);
    return result;
}

} // namespace sivid

#endif
