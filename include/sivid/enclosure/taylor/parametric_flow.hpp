// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_TAYLOR_PARAMETRIC_FLOW_HPP
#define SIVID_ENCLOSURE_TAYLOR_PARAMETRIC_FLOW_HPP

/// @file
/// The proof of one step of a `parametric_flow`: a tube, what is lost on it, the lanes where the
/// tube holds, and the set at its end.

#include <sivid/enclosure/series/detail/power_sum.hpp>
#include <sivid/enclosure/series/detail/variation_step.hpp>
#include <sivid/enclosure/taylor/detail/parametric_flow_class.hpp>
#include <sivid/work_clock.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace sivid {

template <class Model>
void parametric_flow<Model>::meet_kink(mask lanes) {
    for (std::size_t l = 0; l < width; ++l) {
        if (side_by_side::test(lanes, l)) lanes_[l].rough = true;
    }
}

template <class Model>
void parametric_flow<Model>::note_steepest(mask lanes, square const& m) {
    auto const n = flow_->states();
    for (std::size_t l = 0; l < width; ++l) {
        if (!side_by_side::test(lanes, l)) continue;
        double most = -1;
        for (std::size_t i = 0; i < n; ++i) {
            double row = 0;
            for (std::size_t c = 0; c < n; ++c) row += side_by_side::get(m[i * n + c], l);
            if (row <= most) continue;
            most = std::isfinite(row) ? row : infinity;
            lanes_[l].why.component = i;
        }
    }
}

/// The lanes whose truncation is allowed; the others try again with a shorter step.
template <class Model>
typename parametric_flow<Model>::mask
parametric_flow<Model>::short_enough(mask trying, C const& h, std::size_t order,
                                     std::vector<C> const& truncation, square const& slopes) {
    auto const n = truncation.size();
    // A set that rests on a kink is not carried across by short steps: there the old ones do.
    mask resting{};
    for (std::size_t l = 0; l < width; ++l) {
        if (lanes_[l].crossing >= enclosure_detail::crossing_steps)
            resting = resting | side_by_side::only(l);
    }
    C ratio{}; // of the truncation to what is allowed
    for (std::size_t i = 0; i < n; ++i) {
        C bearable = allowed(i) * 10.0;
        if (order == 0) {
            C crossing = allowed_at_kink(i);
            for (std::size_t c = 0; c < n && !slopes.empty(); ++c) {
                crossing += slopes[i * n + c] * (set_.centre[c].spread() + set_.reach[c]) * 0.25;
            }
            bearable = side_by_side::select(resting, bearable * 1e3, crossing);
        }
        C const share = truncation[i] / bearable;
        // NaN counts as too large.
        auto const more = !(share <= ratio);
        ratio = side_by_side::select(more, share, ratio);
        if (!side_by_side::any(trying & more)) continue;
        for (std::size_t l = 0; l < width; ++l) {
            if (side_by_side::test(more, l)) lanes_[l].why.component = i;
        }
    }
    ratio_ = ratio;
    mask forced{};
    for (std::size_t l = 0; l < width; ++l) {
        if (lanes_[l].forced) forced = forced | side_by_side::only(l);
    }
    C const least = each_lane<C>([&](std::size_t l) {
        return 4 * (lanes_[l].root ? enclosure_detail::step_off_root(options_) : shortest(l));
    });
    mask const enough = order > 0
                            ? (h <= least) & !forced
                            : landing_ | (h <= least) |
                                  (resting & (h <= C(enclosure_detail::resting_step(options_))));
    mask const too_long = trying & !(ratio <= C(1.0)) & !enough;
    if (side_by_side::any(too_long)) {
        auto const shorten = each_lane<C>([&](std::size_t l) {
            double const x = side_by_side::get(ratio, l);
            if (!std::isfinite(x)) return 0.5;
            // At a kink the loss may be in proportion to the length, and stay too large.
            return std::clamp(0.9 * std::pow(x, -1.0 / static_cast<double>(order + 1)), 0.3,
                              order > 0 ? 0.9 : 0.4);
        });
        reject(too_long, failure_reason::minimum_step, shorten);
    }
    return trying & !too_long;
}

/// The tube's middle: the Taylor polynomials over s = h (1 + tau)/2, in q and tau.
template <class Model>
void parametric_flow<Model>::guess_tube(C const& h, std::size_t order) {
    for (std::size_t i = 0; i < path_.size(); ++i) {
        path_[i] = path_of_([&](std::size_t k) -> polynomial const& { return centre_.state(i, k); },
                            order, h);
    }
}

template <class Model>
typename parametric_flow<Model>::mask parametric_flow<Model>::attempt(trial& t) {
    held_.assign(t.smooth() ? 0 : flow_->states(), held_state{});
    if (t.smooth()) {
        mask kinked = centre_.kinked();
        kinked |= derivative_.kinked();
        kinked |= derivative_.steep();
        leave_at_kink(t, t.lanes & kinked);
        if (!side_by_side::any(t.lanes)) return mask{};
    }
    t.h = (t.to - set_.time) * (1 + 4 * polynomial::unit);
    tails_ = t.smooth() && t.flow_order > 1 && centre_tail_.covers() && derivative_tail_.covers() &&
             side_by_side::all(bound_tails(t.h, t.order, t.flow_order) | !t.lanes);
    return tails_ ? prove_by_tails(t) : prove_by_tube(t);
}

/// Where `bound_tails` holds in all lanes: the tube follows from the series.
template <class Model>
typename parametric_flow<Model>::mask parametric_flow<Model>::prove_by_tails(trial& t) {
    auto const n = flow_->states();
    t.lanes = carries_well(short_enough(t.lanes, t.h, t.order, truncation_, {}), t.h, t.flow_order);
    if (!side_by_side::any(t.lanes)) return mask{};
    guess_tube(t.h, t.order);
    auto const all =
        enclosure_detail::variation_sizes(*flow_, derivative_, n, t.h, t.flow_order, 0);
    for (std::size_t i = 0; i < n; ++i) {
        C sum = truncation_[i];
        for (std::size_t c = 0; c < n; ++c) {
            sum += (all[i * n + c] + derivative_tail_.variation(i, c)) * set_.reach[c];
        }
        tube_box_[i] = widened(path_[i], sum * up);
    }
    return t.lanes;
}

/// A tube b that both images lie strictly inside of, guessed from the series and widened in up to
/// three rounds.
template <class Model>
typename parametric_flow<Model>::mask parametric_flow<Model>::prove_by_tube(trial& t) {
    auto known = begin_tube(t);
    for (int round = 0;; ++round) {
        expand_tube(t, known.times);
        bound_truncation(t, known);
        if (!side_by_side::any(t.lanes)) return mask{};
        bound_spread(t, known);
        mask const proved = lies_inside(t, known);
        mask const open = t.lanes & !proved;
        if (!side_by_side::any(open) || round == 2) {
            reject(open, failure_reason::minimum_step, C(0.7));
            return proved;
        }
        widen_rooms(t, known, open);
    }
}

/// The middle of the tube, and the first guess of its `room_`.
template <class Model>
typename parametric_flow<Model>::tube_bounds parametric_flow<Model>::begin_tube(trial const& t) {
    using namespace enclosure_detail;
    auto const n = flow_->states();
    std::size_t const K = t.order, L = t.flow_order;
    C const& h = t.h;
    tube_bounds known;
    known.power = known.flow_power = h;
    for (std::size_t k = 1; k < K + 1; ++k) known.power *= h;
    for (std::size_t k = 1; k < L; ++k) known.flow_power *= h;
    known.power *= up;
    known.flow_power *= up;
    known.times = tube_entry::constant(set_.time) + within_step(h);
    known.base = variation_sizes(*flow_, derivative_, n, h, L, 1);
    auto const all = variation_sizes(*flow_, derivative_, n, h, L, 0);
    known.carried.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t c = 0; c < n; ++c) known.carried[i] += all[i * n + c] * set_.reach[c];
    }
    guess_tube(h, K);
    C const before = known.power / h;
    for (std::size_t i = 0; i < n; ++i) {
        C const next = K > 0 ? centre_.state(i, K).norm() * before : centre_.state(i, 1).norm() * h;
        // Room for the truncation that is still accepted, as a second round costs as much as the
        // first; but not much on the scale of the tube.
        C const wide = path_[i].spread() * 0.3 + known.carried[i] * 0.05;
        C const more =
            side_by_side::min(allowed(i) * 5.0, side_by_side::max(allowed(i) * 0.1, wide));
        room_[i] = known.carried[i] * 1.2 + next + more;
    }
    known.share.resize(n);
    known.spread.resize(n);
    return known;
}

/// The series over b, in the lanes where it is defined and has no kink; which lanes V carries.
template <class Model>
void parametric_flow<Model>::expand_tube(trial& t, tube_entry const& times) {
    for (std::size_t i = 0; i < room_.size(); ++i) tube_box_[i] = widened(path_[i], room_[i]);
    if (!t.smooth()) hold_states(t.lanes, t.h, times);
    tube_.expand(set_.time, times, tube_box_, t.order + 1);
    leave(t, t.lanes & tube_.undefined(), failure_reason::undefined, C(0.5));
    leave_at_kink(t, t.lanes & tube_.kinked());
    // Without series terms x(h) = x(0) + h f(b) holds for every member, jumps or not. With them no
    // sign varies here (it would be a kink), and V carries the members as usual.
    // A lane with a held state goes the same way.
    t.jumps = t.smooth() ? mask{} : t.lanes & tube_.jumped();
    for (auto const& state : held_) t.jumps = t.jumps | (t.lanes & state.lanes);
    // So does one where V has no bound.
    if (!t.smooth() && side_by_side::any(t.lanes & !t.jumps)) {
        tube_.add_variations(t.flow_order);
        t.jumps = t.jumps | (t.lanes & tube_.steep());
    }
}

/// \f$ h^{K+1} \|x_{K+1}(b)\| \f$, in the lanes where what of it varies is small enough.
template <class Model>
void parametric_flow<Model>::bound_truncation(trial& t, tube_bounds& known) {
    for (std::size_t i = 0; i < truncation_.size(); ++i) {
        auto const& lagrange = tube_.state(i, t.order + 1);
        truncation_[i] = lagrange.norm() * known.power * up;
        if (t.smooth()) {
            known.share[i] = (lagrange.spread() + lagrange.r()) * known.power;
        } else {
            C const share = without_last_variable(lagrange, *shape_).r() * known.power;
            known.share[i] = side_by_side::select(held_[i].lanes, C(0.0), share);
        }
    }
    if (t.smooth()) t.lanes = short_enough(t.lanes, t.h, t.order, known.share, {});
}

/// The reach during the step: as it was in lanes that jump, else what a V within W of 1 makes of
/// it.
template <class Model>
void parametric_flow<Model>::bound_spread(trial& t, tube_bounds& known) {
    auto const n = flow_->states();
    known.last.assign(n * n, C(0.0));
    t.w.assign(n * n, C(0.0));
    known.spread.assign(set_.reach.begin(), set_.reach.end());
    if (side_by_side::any(t.jumps))
        t.lanes =
            short_enough(t.lanes & t.jumps, t.h, t.order, known.share, {}) | (t.lanes & !t.jumps);
    if (!side_by_side::any(t.lanes & !t.jumps)) return;
    if (t.smooth()) tube_.add_variations(t.flow_order);
    mask late = t.lanes & !t.jumps & tube_.steep();
    if (t.flow_order > 1) late = late | (t.lanes & !t.jumps & tube_.kinked());
    leave_at_kink(t, late);
    leave(t, t.lanes & !t.jumps & tube_.undefined(), failure_reason::undefined, C(0.5));
    known.last =
        enclosure_detail::last_variation_sizes(*flow_, tube_, n, known.flow_power, t.flow_order);
    if (!t.smooth())
        t.lanes = short_enough(t.lanes & !t.jumps, t.h, t.order, known.share, known.last) |
                  (t.lanes & t.jumps);
    mask const bounded =
        enclosure_detail::bound_variations(known.base, known.last, n, 8, t.lanes & !t.jumps, t.w);
    mask const unbounded = t.lanes & !t.jumps & !bounded;
    if (side_by_side::any(unbounded)) {
        square growth = known.base;
        for (std::size_t k = 0; k < n * n; ++k) growth[k] += known.last[k];
        note_steepest(unbounded, growth);
        leave(t, unbounded, failure_reason::minimum_step, C(0.5));
    }
    for (std::size_t i = 0; i < n; ++i) { // carried + last (1 + w) reach
        C sum = known.carried[i];
        for (std::size_t l = 0; l < n; ++l) {
            C inner = set_.reach[l];
            for (std::size_t c = 0; c < n; ++c) inner += t.w[l * n + c] * set_.reach[c];
            sum += known.last[i * n + l] * inner;
        }
        known.spread[i] = side_by_side::select(t.jumps, known.spread[i], sum * up);
    }
}

/// The lanes in which the image of the tube lies strictly inside of it. Notes for the others the
/// state that leaves it by most.
template <class Model>
typename parametric_flow<Model>::mask
parametric_flow<Model>::lies_inside(trial const& t, tube_bounds const& known) {
    mask proved = t.lanes;
    std::array<double, width> worst{};
    for (std::size_t i = 0; i < room_.size(); ++i) {
        C const image = known.image(truncation_[i], i);
        auto inside = image < room_[i];
        if (!t.smooth()) inside = inside | held_[i].lanes;
        proved = proved & inside;
        if (side_by_side::all(inside | !t.lanes)) continue;
        for (std::size_t l = 0; l < width; ++l) {
            double const excess = side_by_side::get(image, l) / side_by_side::get(room_[i], l);
            if (side_by_side::test(inside, l) || excess <= worst[l]) continue;
            worst[l] = std::isfinite(excess) ? excess : infinity;
            lanes_[l].why.component = i;
        }
    }
    return proved;
}

/// For the next round. Rooms of lanes that are proved stay; it judges them again.
template <class Model>
void parametric_flow<Model>::widen_rooms(trial& t, tube_bounds const& known, mask open) {
    mask finite = open;
    for (std::size_t i = 0; i < room_.size(); ++i) {
        C const image = known.image(truncation_[i], i);
        auto const grow = open & !(image < room_[i]);
        room_[i] = side_by_side::select(grow, image * 1.3, room_[i]);
        finite = finite & (room_[i] < C(1e300));
    }
    leave(t, open & !finite, failure_reason::minimum_step, C(0.5));
}

template <class Model>
typename parametric_flow<Model>::mask parametric_flow<Model>::perturb(mask moved, C const& to) {
    // What an input may add is small: ranges of the rates' derivatives need no polynomial in time.
    C const half = (to - set_.time) * (0.5 * (1 + 4 * polynomial::unit));
    auto const times =
        column_entry::constant(set_.time) + widened(column_entry::constant(half), half);
    std::vector<column_entry> tube;
    for (auto const& x : tube_box_) tube.push_back(without_last_variable(x, *column_shape_));
    mask const bounded = perturbed_->prove(set_.time, to, times, tube, moved);
    reject(moved & !bounded, failure_reason::minimum_step, C(0.5));
    return bounded;
}

template <class Model>
typename parametric_flow<Model>::mask
parametric_flow<Model>::bound_tails(C const& h, std::size_t order, std::size_t flow_order) {
    mask const proved = centre_tail_.bound_states(centre_, h, order, false);
    for (std::size_t i = 0; i < truncation_.size(); ++i) truncation_[i] = centre_tail_.state(i);
    if (!side_by_side::any(proved)) return proved;
    return proved & derivative_tail_.bound_variations(derivative_, h, flow_order);
}

/// The lanes in which what V has beyond its coefficients does not add much to the reach; the others
/// try again with more of them or, if there are no more, with a shorter step.
template <class Model>
typename parametric_flow<Model>::mask parametric_flow<Model>::carries_well(mask trying, C const& h,
                                                                           std::size_t flow_order) {
    auto const n = flow_->states();
    C most{};
    for (std::size_t i = 0; i < n; ++i) {
        C added{};
        for (std::size_t c = 0; c < n; ++c)
            added += derivative_tail_.variation(i, c) * set_.reach[c];
        most = side_by_side::max(added / side_by_side::max(allowed(i), set_.reach[i] * 0.01), most);
    }
    mask const poor = trying & (most > C(1.0)) & (h > C(4 * options_.shortest_step()));
    if (!side_by_side::any(poor)) return trying;
    if (flow_order < std::min(options_.order, order_)) {
        flow_order_ = flow_order + 1;
        return trying & !poor;
    }
    reject(poor, failure_reason::minimum_step, each_lane<C>([&](std::size_t l) {
               double const x = side_by_side::get(most, l);
               if (!std::isfinite(x)) return 0.5;
               return std::clamp(0.9 * std::pow(x, -1.0 / static_cast<double>(flow_order)), 0.3,
                                 0.9);
           }));
    return trying & !poor;
}

/// One side of a state that may be held, the lower one as the upper one of a mirror.
template <class Model>
struct parametric_flow<Model>::held_side {
    static constexpr double slack = 1e-12;
    double sign;       ///< -1: the mirror
    C start, outer;    ///< U, and the upper end of the tube
    C low, high;       ///< of the c that are still to be tried
    mask known{};      ///< the lanes with a bound
    C end{}, during{}; ///< the least bound, at the end of the step and until then

    held_side(double s, C const& from, C const& above, C const& below)
        : sign(s), start(from), outer(above), low(below), high(above) {}

    [[nodiscard]] static tube_entry between(C const& below, C const& above) {
        C const middle = (below + above) * 0.5;
        C const radius = (above - below) * (0.5 + slack) +
                         (side_by_side::abs(below) + side_by_side::abs(above)) * slack +
                         C(polynomial::tiny);
        return widened(tube_entry::constant(middle), radius);
    }
    /// Where the state is at least c, in the tube.
    [[nodiscard]] tube_entry part_beyond(C const& c) const {
        return sign > 0 ? between(c, outer) : between(-outer, -c);
    }
    /// Takes the bound that one c gives where it is the least, and halves what is to be tried.
    /// @param rate  of the state on `part_beyond(c)`
    template <class Bounds>
    void note(C const& c, Bounds const& rate, C const& h, mask defined) {
        C const most = sign > 0 ? rate.upper : -rate.lower;
        C const moved = start + most * h + side_by_side::abs(most * h) * slack;
        mask const falls = most < C(0.0);
        C const last = side_by_side::select(falls, side_by_side::max(moved, c),
                                            side_by_side::max(start, c) + (moved - start) +
                                                side_by_side::abs(c) * slack);
        C const until = side_by_side::select(falls, side_by_side::max(start, c), last);
        mask const good = defined & (until < outer) & ((!known) | (last < end));
        known = known | good;
        end = side_by_side::select(good, last, end);
        during = side_by_side::select(good, until, during);
        mask const reached = falls & (moved <= c); // a lower c would say more
        low = side_by_side::select(reached, low, c);
        high = side_by_side::select(reached, c, high);
    }
};

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
template <class Model>
void parametric_flow<Model>::hold_states(mask trying, C const& h, tube_entry const& times) {
    for (std::size_t i = 0; i < held_.size(); ++i) {
        held_[i] = held_state{};
        if (!flow_->sensitive(i, i)) continue;
        tube_entry const whole = tube_box_[i];
        auto const all = rough_bounds(whole);
        auto const range = rough_bounds(set_.centre[i]);
        C const reach =
            set_.reach[i] +
            (side_by_side::abs(range.lower) + side_by_side::abs(range.upper)) * held_side::slack +
            C(polynomial::tiny);
        held_side upper(1, range.upper + reach, all.upper, all.lower);
        held_side lower(-1, -range.lower + reach, -all.lower, -all.upper);
        auto const improve = [&](held_side& s, C const& c) {
            tube_box_[i] = s.part_beyond(c);
            tube_.expand(set_.time, times, tube_box_, 1);
            s.note(c, rough_bounds(tube_.state(i, 1)), h, trying & !tube_.undefined());
        };
        tube_.expand(set_.time, times, tube_box_, 1);
        auto const rate = rough_bounds(tube_.state(i, 1));
        C const plain = (range.upper - range.lower) + reach * 2.0 + (rate.upper - rate.lower) * h;
        improve(upper, upper.start);
        improve(lower, lower.start);
        mask held = upper.known & lower.known & (upper.end + lower.end < plain * 0.7);
        if (side_by_side::any(held)) {
            for (auto* s : {&upper, &lower}) {
                for (int round = 0; round < 14; ++round) improve(*s, (s->low + s->high) * 0.5);
            }
            held = held & (upper.end + lower.end < plain * 0.5);
        }
        tube_box_[i] = whole;
        if (!side_by_side::any(held)) continue;
        held_[i] = {held, -lower.end, upper.end};
        tube_box_[i] = select(held, held_side::between(-lower.during, upper.during), whole);
    }
}

/// Gives the held states of a finished step their bounds, without the unknowns.
/// @param lost  what goes into the generators
template <class Model>
void parametric_flow<Model>::release_states(mask moved, std::vector<polynomial>& next,
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

/// Fewer generators lose more, all of them cost the cube of n in a step: with 12 states fewer than
/// these widen hulls (`benchmarks/paving/robots`, "chain of 6 masses"), with 64 twice their number
/// does as well and takes a quarter of the time ("chain of 32 masses").
[[nodiscard]] constexpr std::size_t most_columns(std::size_t states) {
    return std::max(2 * states, std::min<std::size_t>(13 * states, 156));
}

template <class Model>
void parametric_flow<Model>::accept(trial const& t) {
    auto const n = flow_->states();
    mask const moved = t.lanes;
    C const length = t.to - set_.time; // off by less than a unit
    std::vector<mask> stopped;
    for (auto& s : sticking_) stopped.push_back(t.smooth() ? mask{} : stops(s, t));
    auto end = centre_at_end(t, length);
    auto const added = added_by_last_variation(t, length);
    if (!side_by_side::all(t.jumps | !moved)) carry_generators(t, length, end.lost);
    release_states(moved, end.centre, end.lost);
    if (perturbed_) add_perturbation(t, length, end.lost);
    for (auto& x : end.lost) x *= up;
    bool const clamped = is_clamped(t, length);
    for (std::size_t i = 0; i < n; ++i) {
        set_.centre[i] = select(moved, end.centre[i], set_.centre[i]);
        set_.tail[i] = side_by_side::select(moved, end.tail[i], set_.tail[i]);
        auto const during =
            perturbed_ ? widened(tube_box_[i], perturbed_->largest()[i]) : tube_box_[i];
        swept_[i] = select(moved, during, swept_[i]);
    }
    set_.time = side_by_side::select(moved, t.to, set_.time);
    set_.reduce(most_columns(n), end.lost, running_);
    set_.append(end.lost);
    set_.measure();
    for (std::size_t k = 0; k < stopped.size(); ++k) {
        auto& s = sticking_[k];
        set_.rest(stopped[k], s.state);
        s.until = side_by_side::select(stopped[k], set_.time, s.until);
    }
    adapt_flow_order(moved, t.order, t.flow_order, added);
    if (t.smooth()) adapt_order(moved, length, clamped);
    for (std::size_t i = 0; i < n && perturbed_; ++i) {
        disturbed_[i] = side_by_side::min(disturbed_[i], set_.reach[i]);
    }
    stale_ = true;
}

/// \f$ \sum_{k \le K} h^k x_k + h^{K+1} x_{K+1}(b) \f$, in twice the digits where that pays.
template <class Model>
typename parametric_flow<Model>::centre_image
parametric_flow<Model>::centre_at_end(trial const& t, C const& length) {
    auto const n = flow_->states();
    centre_image end{std::vector<polynomial>(n), std::vector<C>(n), std::vector<C>(n)};
    std::size_t const sharp = sharp_orders(length, t.order);
    bool const sharply = sharp > 0 && expand_sharply(sharp);
    bool pays = false;
    std::size_t const top = tails_ ? t.order : t.order + 1;
    for (std::size_t i = 0; i < n; ++i) {
        auto& next = end.centre[i];
        polynomial last;
        if (!tails_) last = without_last_variable(tube_.state(i, top), *shape_);
        auto const coefficient = [&](std::size_t k) -> polynomial const& {
            return k <= t.order ? centre_.state(i, k) : last;
        };
        next = at_time(*shape_, coefficient, top, length);
        if (sharply) {
            C const rounding = next.r();
            C const beyond = tails_ ? truncation_[i] : C(0.0);
            end.tail[i] = sharpen(i, coefficient, top, t.to, sharp, beyond, next);
            pays = pays || side_by_side::all(next.r() < beyond + rounding * 0.5);
        } else if (tails_) {
            next = widened(next, truncation_[i]);
        }
        end.lost[i] = side_by_side::select(t.lanes, next.r(), C(0.0));
        next.r() = 0.0;
    }
    if (sharp > 0) sharp_pays_ = pays;
    return end;
}

/// What V's Lagrange term adds to the reach; nothing where all lanes jump.
template <class Model>
std::vector<typename parametric_flow<Model>::C>
parametric_flow<Model>::added_by_last_variation(trial const& t, C const& length) const {
    auto const n = flow_->states();
    std::vector<C> added(n);
    if (side_by_side::all(t.jumps | !t.lanes)) return added;
    C flow_power = length;
    for (std::size_t k = 1; k < t.flow_order; ++k) flow_power *= length;
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t c = 0; c < n; ++c) {
            if (!flow_->sensitive(i, c)) continue;
            added[i] += (tails_ ? derivative_tail_.variation(i, c)
                                : tube_.variation(i, c, t.flow_order).norm() * flow_power) *
                        set_.reach[c];
        }
    }
    return added;
}

/// V at the end of the step; 1 in lanes that stay, or jump: they keep their generators.
template <class Model>
std::vector<typename parametric_flow<Model>::column_entry>
parametric_flow<Model>::flow_at_end(trial const& t, C const& length) const {
    using namespace enclosure_detail;
    auto const n = flow_->states();
    auto const L = t.flow_order;
    std::vector<column_entry> v(n * n);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t c = 0; c < n; ++c) {
            if (!flow_->sensitive(i, c)) continue;
            auto sum =
                tails_
                    ? variation_at_end(derivative_, derivative_tail_.variation(i, c), i, c, L,
                                       *column_shape_, length)
                    : variation_at_end(derivative_,
                                       last_variation(*flow_, tube_, t.w, i, c, L, *column_shape_),
                                       i, c, L, *column_shape_, length);
            v[i * n + c] = select(t.lanes & !t.jumps, std::move(sum),
                                  column_entry::constant(C(i == c ? 1.0 : 0.0)));
        }
    }
    return v;
}

/// Multiplies the generators by V. What the products lose goes into `lost`.
template <class Model>
void parametric_flow<Model>::carry_generators(trial const& t, C const& length,
                                              std::vector<C>& lost) {
    if (set_.columns.empty()) return;
    auto const n = flow_->states();
    auto const v = flow_at_end(t, length);
    mask const carried = t.lanes & !t.jumps;
    bool const all = side_by_side::all(carried);
    image_.resize(n);
    std::vector<unsigned char> present(n);
    double work = 0;
    for (auto& g : set_.columns) {
        for (std::size_t l = 0; l < n; ++l) {
            present[l] = side_by_side::all(g[l].norm() == C(0.0)) ? 0 : 1;
        }
        for (std::size_t i = 0; i < n; ++i) {
            product_sum<C> sum(image_[i]);
            for (std::size_t l = 0; l < n; ++l) {
                if (present[l] == 0 || !flow_->sensitive(i, l)) continue;
                sum.add(v[i * n + l], g[l]);
                work += g[l].shape().product_work;
            }
            sum.finish();
            if (!all) image_[i] = select(carried, image_[i], g[i]);
            lost[i] += image_[i].r();
            image_[i].r() = 0.0;
        }
        g.swap(image_);
    }
    work_clock::count(1, work);
}

/// What uncertain inputs may add goes into new generators.
template <class Model>
void parametric_flow<Model>::add_perturbation(trial const& t, C const& length,
                                              std::vector<C>& lost) {
    auto const n = flow_->states();
    auto const all =
        enclosure_detail::variation_sizes(*flow_, derivative_, n, length, t.flow_order, 0);
    std::vector<C> carried(n);
    for (std::size_t i = 0; i < n; ++i) {
        C const own = side_by_side::select(t.lanes, perturbed_->at_end()[i], C(0.0));
        lost[i] += own;
        carried[i] = own;
        for (std::size_t c = 0; c < n; ++c) carried[i] += all[i * n + c] * disturbed_[c];
    }
    for (std::size_t i = 0; i < n; ++i) {
        disturbed_[i] = side_by_side::select(t.lanes, carried[i], disturbed_[i]);
    }
}

template <class Model>
typename parametric_flow<Model>::mask
parametric_flow<Model>::stays(C const& from, C const& h, std::vector<tube_entry> const& tube,
                              C& share, C& strength) {
    if (!conditions_) conditions_.emplace(flow_->observe(), 0, *tube_shape_);
    conditions_->set_parameters(tube_parameters_);
    auto const t = tube_entry::constant(from) + within_step(h);
    conditions_->evaluate(t, tube, input_pieces<tube_entry>(*flow_, from, t));
    mask good = !conditions_->undefined();
    share = C(0.0);
    strength = C(infinity);
    for (std::size_t k = 0; k + 1 < flow_->channels(); k += 2) {
        auto const q = rough_bounds(conditions_->output(k, 0));
        auto const b = rough_bounds(conditions_->output(k + 1, 0));
        share = side_by_side::max(share, side_by_side::max(q.upper, -q.lower));
        strength = side_by_side::min(strength, b.lower);
        good = good & (q.upper < C(1.0)) & (q.lower > C(-1.0)) & (b.lower > C(0.0));
    }
    return good;
}

template <class Model>
parametric_flow<Model>& parametric_flow<Model>::at_rest(sticking& s, mask lanes) {
    if (!s.run) {
        s.run = std::make_unique<parametric_flow>(s.equations->equations(), options_,
                                                  shape_->variables, shape_->degree);
    }
    auto& run = *s.run;
    if (run.known_ != begun_) {
        run.parameters_ = parameters_;
        run.column_parameters_ = column_parameters_;
        run.tube_parameters_ = tube_parameters_;
        run.centre_.set_parameters(parameters_);
        run.derivative_.set_parameters(column_parameters_);
        run.tube_.set_parameters(tube_parameters_);
        run.known_ = begun_;
        run.sharp_ready_ = false;
        ++run.begun_;
        run.running_ = mask{};
    }
    mask goes_on = run.running_; // with a shorter step
    for (std::size_t l = 0; l < width; ++l) {
        if (run.lanes_[l].attempts == 0) goes_on = goes_on & !side_by_side::only(l);
    }
    if (side_by_side::all(goes_on | !lanes) && side_by_side::all(lanes | !run.running_)) return run;
    for (std::size_t l = 0; l < width; ++l) {
        if (!side_by_side::test(lanes & !goes_on, l)) continue;
        auto& lane = run.lanes_[l];
        auto const learned = lane.learned;
        lane = lane_state{};
        lane.learned = learned;
        lane.unknowns = lanes_[l].unknowns;
    }
    run.set_ = set_;
    run.running_ = lanes;
    run.stale_ = true;
    return run;
}

template <class Model>
typename parametric_flow<Model>::mask parametric_flow<Model>::stick(mask able, C const& limit,
                                                                    mask& moved) {
    mask tried{};
    for (auto& s : sticking_) {
        mask const resting = able & !tried & set_.rests(s.state) & (set_.time >= s.until);
        if (!side_by_side::any(resting)) continue;
        auto& run = at_rest(s, resting);
        C const from = set_.time;
        C const end = side_by_side::min(limit, from + s.most);
        mask const went = run.advance(end) & resting;
        C const h = (run.set_.time - from) * (1 + 4 * polynomial::unit);
        C share{}, strength{};
        mask good = went & run.by_rest_;
        if (side_by_side::any(went & !good))
            good = good | (went & run.stays(from, h, run.swept_, share, strength));
        set_.take(good, run.set_);
        set_.rest(good, s.state);
        for (std::size_t i = 0; i < swept_.size(); ++i)
            swept_[i] = select(good, run.swept_[i], swept_[i]);
        for (std::size_t l = 0; l < width; ++l) {
            if (!side_by_side::test(resting, l)) continue;
            if (side_by_side::test(good, l)) {
                auto& lane = lanes_[l];
                lane.attempts = lane.crossing = 0;
                lane.rough = false;
                lane.near = infinity;
                ++lane.steps;
                side_by_side::put(s.most, l, infinity);
                continue;
            }
            bool const ended = run.lanes_[l].failure.has_value();
            if (!ended && !side_by_side::test(went, l)) continue; // tries a shorter step
            double const start = side_by_side::get(from, l);
            // Up to where something is torn off, in quarters of what is left; the rest by series.
            double const shorter = 0.25 * side_by_side::get(h, l);
            if (ended || !(shorter > 64 * options_.shortest_step())) {
                side_by_side::put(s.until, l,
                                  std::min(side_by_side::get(limit, l), flow_->next_knot(start)));
                side_by_side::put(s.most, l, infinity);
                run.lanes_[l] = lane_state{};
            } else {
                side_by_side::put(s.most, l, shorter);
            }
        }
        stale_ = stale_ || side_by_side::any(good);
        by_rest_ = by_rest_ | good;
        moved = moved | good;
        tried = tried | (resting & !(set_.time < s.until));
    }
    return tried;
}

/// While |a/b| <= m < 1 and b >= c > 0 on the tube, |y| falls at the rate (1 - m) c until y is 0,
/// and stays there (see `resting_models`).
template <class Model>
typename parametric_flow<Model>::mask parametric_flow<Model>::stops(sticking& s, trial const& t) {
    C const far = set_.centre[s.state].norm() + set_.reach[s.state];
    C const length = (t.to - set_.time) * (1 - 1e-9);
    mask const near = t.lanes & (far > C(0.0));
    if (!side_by_side::any(near)) return mask{};
    C share{}, strength{};
    mask const falls = at_rest(s, near).stays(set_.time, t.h, tube_box_, share, strength);
    return near & falls & (far <= (C(1.0) - share) * strength * length);
}

/// Where 0 lies within about what the set spans: when it comes to rest is not known better, and
/// shorter steps would lose more.
template <class Model>
typename parametric_flow<Model>::mask parametric_flow<Model>::land(mask able, C const& limit) {
    mask rough{}, landed{};
    for (std::size_t l = 0; l < width; ++l) {
        if (lanes_[l].rough) rough = rough | side_by_side::only(l);
    }
    for (auto& s : sticking_) {
        auto const range = rough_bounds(set_.centre[s.state]);
        C const reach = set_.reach[s.state];
        C const far = side_by_side::max(range.upper, -range.lower) + reach;
        C const across = (range.upper - range.lower) + reach * 2.0;
        // Landing in one step loses what jumps for as long as it takes: about as long as the
        // members differ anyway. Farther away, smooth steps come nearer first.
        mask const near = able & rough & !landed & (far > C(0.0)) & (far <= across * 3.0);
        if (!side_by_side::any(near)) continue;
        std::vector<tube_entry> here;
        for (std::size_t i = 0; i < set_.centre.size(); ++i) {
            auto const x = rough_bounds(set_.centre[i]);
            here.push_back(held_side::between(x.lower - set_.reach[i], x.upper + set_.reach[i]));
        }
        C share{}, strength{};
        mask lanes = near & at_rest(s, near).stays(set_.time, C(0.0), here, share, strength);
        C const takes = far / ((C(1.0) - share) * strength) * 1.1;
        trial t{lanes, 0, 1};
        t.to = set_.time + takes;
        for (std::size_t l = 0; l < width; ++l) {
            double const from = time(l), to = side_by_side::get(t.to, l);
            bool const fits =
                to > from && to <= side_by_side::get(limit, l) && to <= flow_->next_knot(from);
            if (!fits) t.lanes = t.lanes & !side_by_side::only(l);
        }
        if (!side_by_side::any(t.lanes)) continue;
        if (stale_ || smooth_) expand(0);
        if (expanded_ != 1) expand_flow(1);
        auto const lanes_before = lanes_;
        landing_ = t.lanes;
        t.lanes = attempt(t);
        landing_ = mask{};
        lanes_ = lanes_before;
        t.lanes = t.lanes & stops(s, t);
        if (!side_by_side::any(t.lanes)) continue;
        accept(t);
        landed = landed | t.lanes;
        for (std::size_t l = 0; l < width; ++l) {
            if (!side_by_side::test(t.lanes, l)) continue;
            auto& lane = lanes_[l];
            lane.attempts = lane.crossing = 0;
            lane.rough = false;
            ++lane.steps;
        }
    }
    return landed;
}

/// Whether in no lane the tolerance alone has limited the step.
template <class Model>
bool parametric_flow<Model>::is_clamped(trial const& t, C const& length) const {
    for (std::size_t l = 0; l < width; ++l) {
        if (!side_by_side::test(t.lanes, l)) continue;
        bool const at_knot = side_by_side::get(t.to, l) >= flow_->next_knot(time(l));
        bool const longest = side_by_side::get(length, l) >= options_.longest_step();
        if (!at_knot && !longest && !lanes_[l].held) return false;
    }
    return true;
}

/// The order of V follows what its Lagrange term adds to the reach: that may be a share of the
/// reach itself, smaller where this is still less than what the step may lose anyway.
template <class Model>
void parametric_flow<Model>::adapt_flow_order(mask moved, std::size_t order, std::size_t flow_order,
                                              std::vector<C> const& added) {
    if (order == 0) {
        flow_order_ = 3;
        return;
    }
    C most{};
    for (std::size_t i = 0; i < added.size(); ++i) {
        C const bearable = side_by_side::max(
            side_by_side::min(allowed(i) * 0.3, set_.reach[i] * 0.05), set_.reach[i] * 1e-3);
        most = side_by_side::max(most, added[i] / (bearable + C(1e-300)));
    }
    if (side_by_side::any(moved & (most > C(1.0)))) {
        flow_order_ = std::min(flow_order + 1, options_.order);
    } else if (side_by_side::all((most < C(0.01)) | !moved) && flow_order > 2) {
        flow_order_ = flow_order - 1;
    }
}

template <class Model>
std::size_t parametric_flow<Model>::sharp_orders(C const& length, std::size_t order) const {
    if constexpr (!std::is_same_v<C, double>) {
        return 0;
    } else {
        if (order == 0 || !sharp_pays_ || unknowns().variables > 0) return 0;
        // What the roundings of an order cost, as `at_time` counts them.
        auto const cost = [&](std::size_t i, std::size_t k, double power) {
            auto const& a = centre_.state(i, k);
            return (a.r() + a.norms()[0] * (static_cast<double>(3 * k + 1) * a.unit)) * power;
        };
        std::size_t orders = 0;
        for (std::size_t i = 0; i < set_.centre.size(); ++i) {
            double all = 0, power = 1;
            for (std::size_t k = 0; k <= order; ++k, power *= length) all += cost(i, k, power);
            if (!(all > allowed(i))) continue;
            power = 1;
            std::size_t k = 0;
            for (; k <= order && all > 0.1 * allowed(i); ++k, power *= length) {
                all -= cost(i, k, power);
            }
            orders = std::max(orders, k);
        }
        return orders;
    }
}

template <class Model>
bool parametric_flow<Model>::expand_sharply(std::size_t orders) {
    if constexpr (!std::is_same_v<C, double>) {
        return false;
    } else {
        if (!sharp_) sharp_.emplace(*flow_, options_.order + 1, variations::by_state);
        if (!sharp_ready_) {
            std::vector<twofold> p;
            for (auto const& s : unknowns().parameters) p.emplace_back(s.centre, 0.0, s.rest);
            sharp_->set_parameters(p);
            sharp_ready_ = true;
        }
        std::vector<twofold> x;
        for (std::size_t i = 0; i < set_.centre.size(); ++i) {
            x.emplace_back(set_.centre[i].c()[0], set_.tail[i], 0.0);
        }
        sharp_->expand(set_.time, twofold(set_.time), x, orders - 1);
        return !sharp_->undefined() && !sharp_->kinked();
    }
}

template <class Model>
template <class Coefficient>
typename parametric_flow<Model>::C
parametric_flow<Model>::sharpen(std::size_t i, Coefficient const& coefficient, std::size_t top,
                                C const& to, std::size_t orders, C const& beyond,
                                polynomial& next) {
    next = widened(next, beyond);
    if constexpr (!std::is_same_v<C, double>) {
        return C(0.0);
    } else {
        polynomial const none;
        auto const high = at_time(
            *shape_,
            [&](std::size_t k) -> polynomial const& { return k < orders ? none : coefficient(k); },
            top, to - set_.time);
        twofold const h = twofold(to) - twofold(set_.time);
        twofold sum = sharp_->state(i, orders - 1);
        for (std::size_t k = orders - 1; k-- > 0;) sum = sum * h + sharp_->state(i, k);
        // No variable enters a point, so there is no spread.
        sum = sum + twofold(high.c()[0], 0.0, (high.r() + high.spread() + beyond) * up);
        if (!(sum.radius() < next.r())) return 0.0;
        next = polynomial::constant(sum.head());
        next.r() = sum.radius();
        return sum.tail();
    }
}

} // namespace sivid

#endif
