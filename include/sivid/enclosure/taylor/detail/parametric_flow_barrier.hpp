// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_TAYLOR_DETAIL_PARAMETRIC_FLOW_BARRIER_HPP
#define SIVID_ENCLOSURE_TAYLOR_DETAIL_PARAMETRIC_FLOW_BARRIER_HPP

/// @file
/// States that the right-hand side holds where they are, such as the velocity of a body that
/// sticks.

#include <sivid/enclosure/taylor/detail/parametric_flow_class.hpp>

#include <cstddef>
#include <vector>

namespace sivid {

/// Looks for states whose own motion keeps them in a smaller interval than a step of first order
/// says: the velocity of a body that sticks, or leaves a place where it stuck.
///   Let B be the tube, U the upper bound of \f$ x_i \f$ at the begin, c in \f$ B_i \f$, and σ the
///   upper bound of \f$ f_i \f$ (of all its limits, where it jumps) on the part of B where
///   \f$ x_i \ge c \f$. While a solution is in B, \f$ x_i \f$ changes at most at the rate σ
///   wherever it is above c, so
///     \f$ x_i(s) \le \max(U + \sigma s, c) \f$ for σ < 0, else \f$ \max(U, c) + \sigma s \f$.
///   What lies below the upper end of \f$ B_i \f$ is never reached from inside. The lower side is
///   the same in a mirror. Both sides together replace what the series says of this state.
/// Writes the bounds at the end into `held_`, and those during the step into `tube_box_`.
/// @cost  three expansions of order 1 for each state whose rate depends on it, about thirty more
///        where that promises something
template <class Model, class Centre>
void parametric_flow<Model, Centre>::hold_states(mask trying, C const& h, tube_entry const& times) {
    constexpr double slack = 1e-12;
    auto const entry = [](C const& low, C const& high) {
        C const middle = (low + high) * 0.5;
        C const radius = (high - low) * (0.5 + slack) +
                         (side_by_side::abs(low) + side_by_side::abs(high)) * slack +
                         C(polynomial::tiny);
        return widened(tube_entry::constant(middle), radius);
    };
    for (std::size_t i = 0; i < held_.size(); ++i) {
        held_[i] = held_state{};
        if (!flow_->sensitive(i, i)) continue;
        tube_entry const whole = tube_box_[i];
        auto const all = rough_bounds(whole);
        auto const range = rough_bounds(set_.centre[i]);
        C const reach = set_.reach[i] +
                        (side_by_side::abs(range.lower) + side_by_side::abs(range.upper)) * slack +
                        C(polynomial::tiny);
        struct side {
            double sign; ///< -1: the lower side, seen in a mirror
            C start, outer, inner;
            mask known{};    ///< the lanes with a bound
            C end{};         ///< the least bound at the end of the step
            C during{};      ///< and until then
            C low{}, high{}; ///< of the c that are still to be tried
        };
        auto const side_of = [&](double sign) {
            side s{sign, (sign > 0 ? range.upper : -range.lower) + reach,
                   sign > 0 ? all.upper : -all.lower, sign > 0 ? all.lower : -all.upper};
            s.low = s.inner;
            s.high = s.outer;
            return s;
        };
        // Tries one c: keeps the bound where it is the least, and halves what is to be tried.
        auto const attempt = [&](side& s, C const& c) {
            tube_box_[i] = s.sign > 0 ? entry(c, s.outer) : entry(-s.outer, -c);
            tube_.expand(set_.time, times, tube_box_, 1);
            auto const rate = rough_bounds(tube_.state(i, 1));
            C const most = s.sign > 0 ? rate.upper : -rate.lower;
            C const moved = s.start + most * h + side_by_side::abs(most * h) * slack;
            mask const falls = most < C(0.0);
            C const end = side_by_side::select(falls, side_by_side::max(moved, c),
                                               side_by_side::max(s.start, c) + (moved - s.start) +
                                                   side_by_side::abs(c) * slack);
            C const during = side_by_side::select(falls, side_by_side::max(s.start, c), end);
            mask const good =
                trying & !tube_.undefined() & (during < s.outer) & ((!s.known) | (end < s.end));
            s.known = s.known | good;
            s.end = side_by_side::select(good, end, s.end);
            s.during = side_by_side::select(good, during, s.during);
            mask const reached = falls & (moved <= c); // a lower c would say more
            s.low = side_by_side::select(reached, s.low, c);
            s.high = side_by_side::select(reached, c, s.high);
        };
        tube_.expand(set_.time, times, tube_box_, 1);
        auto const rate = rough_bounds(tube_.state(i, 1));
        C const plain = (range.upper - range.lower) + reach * 2.0 + (rate.upper - rate.lower) * h;
        side upper = side_of(1), lower = side_of(-1);
        attempt(upper, upper.start);
        attempt(lower, lower.start);
        mask held = upper.known & lower.known & (upper.end + lower.end < plain * 0.7);
        if (side_by_side::any(held)) {
            for (auto* s : {&upper, &lower}) {
                for (int round = 0; round < 14; ++round) attempt(*s, (s->low + s->high) * 0.5);
            }
            held = held & (upper.end + lower.end < plain * 0.5);
        }
        tube_box_[i] = whole;
        if (!side_by_side::any(held)) continue;
        held_[i] = {held, -lower.end, upper.end};
        tube_box_[i] = select(held, entry(-lower.during, upper.during), whole);
    }
}

/// Gives the held states of a finished step their bounds, without the unknowns.
/// @param lost  what goes into the generators
template <class Model, class Centre>
void parametric_flow<Model, Centre>::release_states(mask moved, std::vector<polynomial>& next,
                                                    std::vector<C>& lost) {
    for (std::size_t i = 0; i < held_.size(); ++i) {
        mask const held = moved & held_[i].lanes;
        if (!side_by_side::any(held)) continue;
        C const middle = (held_[i].lower + held_[i].upper) * 0.5;
        C const radius = side_by_side::max(held_[i].upper - middle, middle - held_[i].lower) * up +
                         C(polynomial::tiny);
        next[i] = select(held, polynomial::constant(middle), next[i]);
        lost[i] = side_by_side::select(held, radius, lost[i]);
        for (auto& g : set_.columns) g[i] = select(held, column_entry::constant(C(0.0)), g[i]);
    }
}

} // namespace sivid

#endif
