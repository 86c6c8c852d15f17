// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_TAYLOR_PARAMETRIC_FLOW_HPP
#define SIVID_ENCLOSURE_TAYLOR_PARAMETRIC_FLOW_HPP

/// @file
/// The proof of one step of a `parametric_flow`: a tube, what is lost on it, the lanes where the
/// tube holds, and the set at its end.

#include <sivid/enclosure/series/detail/power_sum.hpp>
#include <sivid/enclosure/series/detail/variation_step.hpp>
#include <sivid/enclosure/taylor/detail/parametric_flow_class.hpp>

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
    mask const enough =
        order > 0 ? (h <= least) & !forced
                  : (h <= least) | (resting & (h <= C(enclosure_detail::resting_step(options_))));
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
typename parametric_flow<Model>::mask
parametric_flow<Model>::attempt(mask trying, C const& to, std::size_t order, std::size_t flow_order,
                                square& w, mask& jumps) {
    using namespace enclosure_detail;
    auto const n = flow_->states();
    std::size_t const K = order;
    std::size_t const L = flow_order;
    C const half = C(0.5);
    held_.assign(K == 0 ? n : 0, held_state{});
    if (K > 0) {
        mask kinked = centre_.kinked();
        kinked |= derivative_.kinked();
        kinked |= derivative_.steep();
        kinked &= trying;
        meet_kink(kinked);
        trying = trying & !kinked;
        if (!side_by_side::any(trying)) return mask{};
    }
    C const h = (to - set_.time) * (1 + 4 * polynomial::unit); // not less than the length
    tails_ = false;
    if (K > 0 && L > 1 && centre_tail_.covers() && derivative_tail_.covers()) {
        mask const bounded = bound_tails(h, K, L);
        if (side_by_side::all(bounded | !trying)) {
            tails_ = true;
            trying = carries_well(short_enough(trying, h, K, truncation_, {}), h, L);
            if (!side_by_side::any(trying)) return mask{};
            guess_tube(h, K);
            auto const all = variation_sizes(*flow_, derivative_, n, h, L, 0);
            for (std::size_t i = 0; i < n; ++i) {
                C sum = truncation_[i];
                for (std::size_t c = 0; c < n; ++c) {
                    sum += (all[i * n + c] + derivative_tail_.variation(i, c)) * set_.reach[c];
                }
                tube_box_[i] = widened(path_[i], sum * up);
            }
            return trying;
        }
    }
    C power = h; // h^(K+1), h^L, rounded up
    C flow_power = h;
    for (std::size_t k = 1; k < K + 1; ++k) power *= h;
    for (std::size_t k = 1; k < L; ++k) flow_power *= h;
    power *= up;
    flow_power *= up;
    auto const s = within_step(h);
    auto const times = tube_entry::constant(set_.time) + s;
    // What the reach becomes during the step, as far as the series knows.
    auto const all = variation_sizes(*flow_, derivative_, n, h, L, 0);
    auto const base = variation_sizes(*flow_, derivative_, n, h, L, 1);
    square last;
    std::vector<C> carried(n), spread(n);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t c = 0; c < n; ++c) carried[i] += all[i * n + c] * set_.reach[c];
    }
    guess_tube(h, K);
    C const before = power / h;
    for (std::size_t i = 0; i < n; ++i) {
        C const next = K > 0 ? centre_.state(i, K).norm() * before : centre_.state(i, 1).norm() * h;
        // Room for the truncation that is still accepted, as a second round costs as much as the
        // first; but not much on the scale of the tube.
        C const wide = path_[i].spread() * 0.3 + carried[i] * 0.05;
        C const more =
            side_by_side::min(allowed(i) * 5.0, side_by_side::max(allowed(i) * 0.1, wide));
        room_[i] = carried[i] * 1.2 + next + more;
    }
    mask proved{};
    for (int round = 0; round < 3; ++round) {
        for (std::size_t i = 0; i < n; ++i) tube_box_[i] = widened(path_[i], room_[i]);
        if (K == 0) hold_states(trying, h, times);
        tube_.expand(set_.time, times, tube_box_, K + 1);
        mask undefined = trying & tube_.undefined();
        if (side_by_side::any(undefined)) {
            reject(undefined, failure_reason::undefined, half);
            trying = trying & !undefined;
        }
        mask const kinked = trying & tube_.kinked();
        if (side_by_side::any(kinked)) {
            meet_kink(kinked);
            trying = trying & !kinked;
        }
        // Without series terms x(h) = x(0) + h f(b) holds for every member, jumps or not. With them
        // no sign varies here (it would be a kink), and V carries the members as usual.
        // A lane with a held state goes the same way.
        jumps = K == 0 ? trying & tube_.jumped() : mask{};
        for (auto const& state : held_) jumps = jumps | (trying & state.lanes);
        // So does one where V has no bound.
        if (K == 0 && side_by_side::any(trying & !jumps)) {
            tube_.add_variations(L);
            jumps = jumps | (trying & tube_.steep());
        }
        std::vector<C> share(n);
        for (std::size_t i = 0; i < n; ++i) {
            auto const& lagrange = tube_.state(i, K + 1);
            truncation_[i] = lagrange.norm() * power * up;
            share[i] = K > 0 ? (lagrange.spread() + lagrange.r()) * power
                             : without_last_variable(lagrange, *shape_).r() * power;
            if (K == 0) share[i] = side_by_side::select(held_[i].lanes, C(0.0), share[i]);
        }
        if (K > 0) trying = short_enough(trying, h, K, share, {});
        if (!side_by_side::any(trying)) return mask{};
        last.assign(n * n, C(0.0));
        w.assign(n * n, C(0.0));
        for (std::size_t i = 0; i < n; ++i) spread[i] = set_.reach[i];
        if (side_by_side::any(jumps))
            trying = short_enough(trying & jumps, h, K, share, {}) | (trying & !jumps);
        if (side_by_side::any(trying & !jumps)) {
            if (K > 0) tube_.add_variations(L);
            mask late = trying & !jumps & tube_.steep();
            if (L > 1) late = late | (trying & !jumps & tube_.kinked());
            meet_kink(late);
            trying = trying & !late;
            undefined = trying & !jumps & tube_.undefined();
            if (side_by_side::any(undefined)) {
                reject(undefined, failure_reason::undefined, half);
                trying = trying & !undefined;
            }
            last = last_variation_sizes(*flow_, tube_, n, flow_power, L);
            if (K == 0)
                trying = short_enough(trying & !jumps, h, K, share, last) | (trying & jumps);
            mask const bounded = bound_variations(base, last, n, 8, trying & !jumps, w);
            mask const unbounded = trying & !jumps & !bounded;
            if (side_by_side::any(unbounded)) {
                square growth = base;
                for (std::size_t k = 0; k < n * n; ++k) growth[k] += last[k];
                note_steepest(unbounded, growth);
                reject(unbounded, failure_reason::minimum_step, half);
                trying = trying & !unbounded;
            }
            for (std::size_t i = 0; i < n; ++i) { // carried + last (1 + w) reach
                C sum = carried[i];
                for (std::size_t l = 0; l < n; ++l) {
                    C inner = set_.reach[l];
                    for (std::size_t c = 0; c < n; ++c) inner += w[l * n + c] * set_.reach[c];
                    sum += last[i * n + l] * inner;
                }
                spread[i] = side_by_side::select(jumps, spread[i], sum * up);
            }
        }
        proved = trying;
        std::array<double, width> worst{};
        for (std::size_t i = 0; i < n; ++i) {
            C const image = (truncation_[i] + spread[i]) * up;
            auto inside = image < room_[i];
            if (K == 0) inside = inside | held_[i].lanes;
            proved = proved & inside;
            if (side_by_side::all(inside | !trying)) continue;
            for (std::size_t l = 0; l < width; ++l) {
                double const excess = side_by_side::get(image, l) / side_by_side::get(room_[i], l);
                if (side_by_side::test(inside, l) || excess <= worst[l]) continue;
                worst[l] = std::isfinite(excess) ? excess : infinity;
                lanes_[l].why.component = i;
            }
        }
        mask const open = trying & !proved;
        if (!side_by_side::any(open) || round == 2) {
            reject(open, failure_reason::minimum_step, C(0.7));
            return proved;
        }
        // Rooms of lanes that are proved stay; the next round judges them again.
        mask finite = open;
        for (std::size_t i = 0; i < n; ++i) {
            C const image = (truncation_[i] + spread[i]) * up;
            auto const grow = open & !(image < room_[i]);
            room_[i] = side_by_side::select(grow, image * 1.3, room_[i]);
            finite = finite & (room_[i] < C(1e300));
        }
        mask const lost = open & !finite;
        if (side_by_side::any(lost)) {
            reject(lost, failure_reason::minimum_step, half);
            trying = trying & !lost;
        }
    }
    return proved;
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

template <class Model>
void parametric_flow<Model>::accept(mask moved, C const& to, std::size_t order,
                                    std::size_t flow_order, square const& w, mask jumps) {
    using namespace enclosure_detail;
    auto const n = flow_->states();
    C const length = to - set_.time; // off by less than a unit
    std::vector<C> lost(n);
    std::vector<polynomial> next(n);
    std::vector<C> tails(n);
    std::size_t const sharp = sharp_orders(length, order);
    bool const sharply = sharp > 0 && expand_sharply(sharp);
    bool pays = false;
    std::size_t const top = tails_ ? order : order + 1;
    for (std::size_t i = 0; i < n; ++i) {
        polynomial last;
        if (!tails_) last = without_last_variable(tube_.state(i, order + 1), *shape_);
        auto const coefficient = [&](std::size_t k) -> polynomial const& {
            return k <= order ? centre_.state(i, k) : last;
        };
        next[i] = at_time(*shape_, coefficient, top, length);
        if (sharply) {
            C const rounding = next[i].r();
            C const beyond = tails_ ? truncation_[i] : C(0.0);
            tails[i] = sharpen(i, coefficient, top, to, sharp, beyond, next[i]);
            pays = pays || side_by_side::all(next[i].r() < beyond + rounding * 0.5);
        } else if (tails_) {
            next[i] = widened(next[i], truncation_[i]);
        }
        lost[i] = side_by_side::select(moved, next[i].r(), C(0.0));
        next[i].r() = 0.0;
    }
    if (sharp > 0) sharp_pays_ = pays;
    // What V's Lagrange term adds to the reach.
    std::vector<C> added(n);
    C flow_power = length;
    for (std::size_t k = 1; k < flow_order; ++k) flow_power *= length;
    if (!side_by_side::all(jumps | !moved)) {
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t c = 0; c < n; ++c) {
                if (!flow_->sensitive(i, c)) continue;
                added[i] += (tails_ ? derivative_tail_.variation(i, c)
                                    : tube_.variation(i, c, flow_order).norm() * flow_power) *
                            set_.reach[c];
            }
        }
    }
    if (!side_by_side::all(jumps | !moved) && !set_.columns.empty()) {
        std::vector<column_entry> j(n * n);
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t c = 0; c < n; ++c) {
                if (!flow_->sensitive(i, c)) continue;
                auto sum = tails_ ? variation_at_end(derivative_, derivative_tail_.variation(i, c),
                                                     i, c, flow_order, *column_shape_, length)
                                  : variation_at_end(derivative_,
                                                     last_variation(*flow_, tube_, w, i, c,
                                                                    flow_order, *column_shape_),
                                                     i, c, flow_order, *column_shape_, length);
                // Lanes that stay, or jump, keep their generators.
                j[i * n + c] = select(moved & !jumps, std::move(sum),
                                      column_entry::constant(C(i == c ? 1.0 : 0.0)));
            }
        }
        mask const carried = moved & !jumps;
        bool const all = side_by_side::all(carried);
        image_.resize(n);
        std::vector<unsigned char> present(n);
        for (auto& g : set_.columns) {
            for (std::size_t l = 0; l < n; ++l) {
                present[l] = side_by_side::all(g[l].norm() == C(0.0)) ? 0 : 1;
            }
            for (std::size_t i = 0; i < n; ++i) {
                product_sum<C> sum(image_[i]);
                for (std::size_t l = 0; l < n; ++l) {
                    if (present[l] != 0 && flow_->sensitive(i, l)) sum.add(j[i * n + l], g[l]);
                }
                sum.finish();
                if (!all) image_[i] = select(carried, image_[i], g[i]);
                lost[i] += image_[i].r();
                image_[i].r() = 0.0;
            }
            g.swap(image_);
        }
    }
    release_states(moved, next, lost);
    if (perturbed_) {
        auto const all = variation_sizes(*flow_, derivative_, n, length, flow_order, 0);
        std::vector<C> carried(n);
        for (std::size_t i = 0; i < n; ++i) {
            C const own = side_by_side::select(moved, perturbed_->at_end()[i], C(0.0));
            lost[i] += own;
            carried[i] = own;
            for (std::size_t c = 0; c < n; ++c) carried[i] += all[i * n + c] * disturbed_[c];
        }
        for (std::size_t i = 0; i < n; ++i) {
            disturbed_[i] = side_by_side::select(moved, carried[i], disturbed_[i]);
        }
    }
    for (auto& x : lost) x *= up;
    bool clamped = true;
    for (std::size_t l = 0; l < width; ++l) {
        if (!side_by_side::test(moved, l)) continue;
        double const h = side_by_side::get(length, l);
        clamped = clamped && (side_by_side::get(to, l) >= flow_->next_knot(time(l)) ||
                              h >= options_.longest_step() || lanes_[l].held);
    }
    for (std::size_t i = 0; i < n; ++i) {
        set_.centre[i] = select(moved, next[i], set_.centre[i]);
        set_.tail[i] = side_by_side::select(moved, tails[i], set_.tail[i]);
        auto const during =
            perturbed_ ? widened(tube_box_[i], perturbed_->largest()[i]) : tube_box_[i];
        swept_[i] = select(moved, during, swept_[i]);
    }
    set_.time = side_by_side::select(moved, to, set_.time);
    set_.reduce(13 * n, lost, running_);
    set_.append(lost);
    set_.measure();
    adapt_flow_order(moved, order, flow_order, added);
    if (order > 0) adapt_order(moved, length, clamped);
    for (std::size_t i = 0; i < n && perturbed_; ++i) {
        disturbed_[i] = side_by_side::min(disturbed_[i], set_.reach[i]);
    }
    stale_ = true;
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
