// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_TAYLOR_DETAIL_PARAMETRIC_FLOW_ATTEMPT_HPP
#define SIVID_ENCLOSURE_TAYLOR_DETAIL_PARAMETRIC_FLOW_ATTEMPT_HPP

/// @file
/// The proof of one step: a tube, what is lost on it, and the lanes where the tube holds.

#include <sivid/enclosure/series/detail/variation_step.hpp>
#include <sivid/enclosure/taylor/detail/parametric_flow_class.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace sivid {

template <class Model, class Centre>
void parametric_flow<Model, Centre>::meet_kink(mask lanes) {
    if (Centre::by_formula) return reject(lanes, failure_reason::minimum_step, C(0.5));
    for (std::size_t l = 0; l < width; ++l) {
        if (side_by_side::test(lanes, l)) lanes_[l].rough = true;
    }
}

template <class Model, class Centre>
void parametric_flow<Model, Centre>::note_steepest(mask lanes, square const& m) {
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
template <class Model, class Centre>
typename parametric_flow<Model, Centre>::mask
parametric_flow<Model, Centre>::short_enough(mask trying, C const& h, std::size_t order,
                                             std::vector<C> const& truncation,
                                             square const& slopes) {
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
template <class Model, class Centre>
void parametric_flow<Model, Centre>::guess_tube(C const& h, std::size_t order) {
    for (std::size_t i = 0; i < path_.size(); ++i) {
        path_[i] = path_of_([&](std::size_t k) -> polynomial const& { return centre_.state(i, k); },
                            order, h);
    }
}

template <class Model, class Centre>
typename parametric_flow<Model, Centre>::mask
parametric_flow<Model, Centre>::attempt(mask trying, C const& to, std::size_t order,
                                        std::size_t flow_order, square& w, mask& jumps) {
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
    if (!Centre::by_formula && K > 0 && L > 1 && centre_tail_.covers() &&
        derivative_tail_.covers()) {
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
            mask const bounded =
                bound_variations(base, last, n, Centre::by_formula ? 8 + n : 8, trying & !jumps, w);
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

template <class Model, class Centre>
bool parametric_flow<Model, Centre>::apply_formula(C const& to, square const& w) {
    if constexpr (Centre::by_formula) {
        using traits = interval_traits<interval>;
        C const h = (to - set_.time) * (1 + 4 * polynomial::unit); // not less than the length
        auto const length = traits::sub(traits::point(to), traits::point(set_.time));
        if (auto const why = method_.apply(set_.time, set_.centre, length, within_step(h))) {
            if (*why == failure_reason::unsolved_stages) note_steepest(true, w);
            reject(true, *why, 0.5);
            return false;
        }
        // The rest does not depend on the time within the step and goes into the centre; the
        // series' own share was allowed as much.
        std::vector<C> share(flow_->states());
        for (std::size_t i = 0; i < share.size(); ++i) share[i] = 0.5 * method_.loss(i);
        return short_enough(true, h, order_, share, {});
    }
    return true;
}

template <class Model, class Centre>
typename parametric_flow<Model, Centre>::mask parametric_flow<Model, Centre>::perturb(mask moved,
                                                                                      C const& to) {
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

} // namespace sivid

#endif
