// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_TAYLOR_PARAMETRIC_FLOW_HPP
#define SIVID_ENCLOSURE_TAYLOR_PARAMETRIC_FLOW_HPP

#include <sivid/enclosure/detail/required_boxes.hpp>
#include <sivid/enclosure/taylor/detail/parametric_flow_accept.hpp>
#include <sivid/enclosure/taylor/detail/parametric_flow_attempt.hpp>
#include <sivid/enclosure/taylor/detail/parametric_flow_barrier.hpp>
#include <sivid/enclosure/taylor/detail/parametric_flow_class.hpp>
#include <sivid/enclosure/taylor/detail/parametric_flow_tails.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

template <class Model, class Centre>
void parametric_flow<Model, Centre>::begin(std::size_t lane, double time, box const& initial,
                                           box const& parameters) {
    require_sound_environment();
    if (lane >= width)
        throw std::out_of_range("parametric_flow: no lane " + std::to_string(lane) + " of " +
                                std::to_string(width) + ", counted from 0");
    enclosure_detail::require_boxes("parametric_flow", *flow_, initial, parameters);
    normalised_unknowns unknowns(initial, parameters);
    if (unknowns.variables > (shape_->degree == 0 ? 0 : shape_->variables))
        throw std::invalid_argument(
            "parametric_flow: " + std::to_string(unknowns.variables) +
            " sides of these boxes have a width, and its polynomials have " +
            std::to_string(shape_->degree == 0 ? 0 : shape_->variables) + " variables");
    end(lane);
    // Whatever the lanes held must not show: one that stands idle may decide which of several
    // bounds all lanes get.
    bool const alone = !side_by_side::any(running_);
    for (std::size_t l = 0; l < width; ++l) {
        if (l != lane && !alone) continue;
        for (std::size_t j = 0; j < parameters_.size(); ++j) {
            enclosure_detail::put(unknowns.parameters[j], l, parameters_[j]);
            enclosure_detail::put(unknowns.parameters[j], l, column_parameters_[j]);
            enclosure_detail::put(unknowns.parameters[j], l, tube_parameters_[j]);
        }
    }
    centre_.set_parameters(parameters_);
    derivative_.set_parameters(column_parameters_);
    tube_.set_parameters(tube_parameters_);
    observe_.set_parameters(parameters_);
    if (perturbed_) perturbed_->set_parameters(column_parameters_);
    if constexpr (Centre::by_formula) method_.set_parameters(parameters_, tube_parameters_);
    for (auto& x : disturbed_) {
        if (alone) x = 0.0;
        side_by_side::put(x, lane, 0.0);
    }
    if (alone) { // a fresh start for all
        set_ = set_type(flow_->states(), *shape_);
        // Knots of sampled inputs keep steps short; what lies between them decides on the order.
        order_ = Centre::by_formula || flow_->sampled_inputs().empty()
                     ? options_.order
                     : std::min<std::size_t>(options_.order, 6);
        flow_order_ = 3;
    }
    set_.begin(lane, time, unknowns, alone);
    sharp_ready_ = false;
    sharp_pays_ = true;
    lanes_[lane] = lane_state{};
    lanes_[lane].unknowns.emplace(std::move(unknowns));
    running_ = running_ | side_by_side::only(lane);
    stale_ = true;
}

template <class Model, class Centre>
std::vector<typename parametric_flow<Model, Centre>::polynomial>
parametric_flow<Model, Centre>::outputs() {
    std::vector<polynomial> x;
    for (std::size_t i = 0; i < set_.centre.size(); ++i) {
        x.push_back(widened(set_.centre[i], set_.reach[i]));
    }
    auto const t = polynomial::constant(set_.time);
    auto const inputs = widened(input_pieces<polynomial>(*flow_, set_.time, t), *flow_,
                                input_errors(*flow_, set_.time, set_.time));
    observe_.evaluate(t, x, inputs);
    std::vector<polynomial> result;
    for (std::size_t y = 0; y < flow_->channels(); ++y) {
        auto& p = result.emplace_back(observe_.output(y, 0));
        p.r() = side_by_side::select(observe_.undefined(), C(infinity), p.r());
    }
    return result;
}

template <class Model, class Centre>
void parametric_flow<Model, Centre>::expand(std::size_t order) {
    auto const through = [&](std::vector<polynomial> const& start) {
        centre_.expand(set_.time, polynomial::constant(set_.time), start,
                       std::max<std::size_t>(order, 1));
    };
    bool exact = true;
    for (auto const& x : set_.tail) exact = exact && side_by_side::all(x == C(0.0));
    if (exact) {
        through(set_.centre);
    } else {
        auto start = set_.centre;
        for (std::size_t i = 0; i < start.size(); ++i) {
            start[i] = widened(start[i], side_by_side::abs(set_.tail[i]));
        }
        through(start);
    }
    smooth_ = order > 0;
    stale_ = false;
    expanded_ = 0;
}

template <class Model, class Centre>
void parametric_flow<Model, Centre>::expand_flow(std::size_t flow_order) {
    for (std::size_t i = 0; i < set_.centre.size(); ++i) {
        around_[i] = widened(converted(set_.centre[i], *column_shape_), set_.reach[i]);
    }
    derivative_.expand_with_variations(set_.time, column_entry::constant(set_.time), around_,
                                       flow_order - 1);
    expanded_ = flow_order;
}

/// The step length at which a coefficient reaches what is allowed, and its state.
template <class Model, class Centre>
std::pair<double, std::size_t> parametric_flow<Model, Centre>::estimate(std::size_t lane) const {
    std::pair<double, std::size_t> least{infinity, 0};
    for (std::size_t k = std::max<std::size_t>(order_, 2) - 1; k <= order_; ++k) {
        for (std::size_t i = 0; i < set_.centre.size(); ++i) {
            double const c = side_by_side::get(centre_.state(i, k).norm(), lane);
            if (!(c > 0) || !std::isfinite(c)) continue;
            double const h =
                enclosure_detail::length_for(side_by_side::get(allowed(i), lane), c, k);
            if (h < least.first) least = {h, i};
        }
    }
    return least;
}

/// Step length from the last coefficients; a preference, no proof rests on it.
template <class Model, class Centre>
double parametric_flow<Model, Centre>::propose(std::size_t lane, double rest) const {
    double const h =
        std::min({options_.longest_step(), rest, lanes_[lane].learned * estimate(lane).first});
    // A little longer rather than once more: the length aims at a tenth of what is allowed.
    double const longer = h * std::pow(4.0, 1.0 / static_cast<double>(order_ + 1));
    if (rest <= std::min(longer, options_.longest_step())) return rest;
    return h > 0.5 * rest ? std::max(0.5 * rest, std::min(h, options_.shortest_step())) : h;
}

/// The longest step up to h that does not magnify by much what the degree of the polynomials loses.
///   What products lose beyond degree D is in the radii of the coefficients \f$ x_k \f$, so a step
///   loses \f$ \ell(h) = \sum_{k \ge 1} h^k r_k \f$. In proportion to the time that is least on
///   short steps, \f$ \ell(h)/h \to r_1 \f$; on long ones every term is magnified by norms,
///   like \f$ e^{3 h |A|} \f$. Where it is more than a step may lose, it should stay below \f$ 2 h
///   r_1 \f$. A preference, no proof rests on it.
template <class Model, class Centre>
double parametric_flow<Model, Centre>::gentle(std::size_t lane, double h) const {
    if (shape_->degree == 0)
        return h; // no degree: all of it are roundings, which do not want more steps
    constexpr double most = 2, rounding = 1e-12;
    std::array<double, 64> lost{}; // the largest share of what the step may lose, for each order
    std::size_t const last = std::min(order_, lost.size() - 1);
    for (std::size_t k = 1; k <= last; ++k) {
        for (std::size_t i = 0; i < set_.centre.size(); ++i) {
            auto const& x = centre_.state(i, k);
            C const share = (x.r() - x.norm() * rounding) / allowed(i);
            lost[k] = std::max(lost[k], side_by_side::get(share, lane));
        }
    }
    while (h > options_.shortest_step()) {
        double rate = 0;
        for (std::size_t k = last; k >= 1; --k) rate = rate * h + lost[k];
        if (!(rate * h > 1 && rate > most * lost[1])) break;
        h *= 0.9;
    }
    return h;
}

/// One order more where the tolerance limits the step, one less where the end of an interval or
/// `gentle` does.
template <class Model, class Centre>
void parametric_flow<Model, Centre>::adapt_order(mask moved, C const& h, bool clamped) {
    if (Centre::by_formula) return;
    if (!clamped) {
        order_ = std::min(options_.order, order_ + 1);
        return;
    }
    if (order_ <= 2) return;
    // With one order less, the next length follows from these coefficients.
    for (std::size_t k = order_ - 2; k < order_; ++k) {
        C power = h;
        for (std::size_t j = 1; j < k; ++j) power *= h;
        for (std::size_t i = 0; i < set_.centre.size(); ++i) {
            auto const large = centre_.state(i, k).norm() * power > allowed(i) * 0.3;
            if (side_by_side::any(moved & large)) return;
        }
    }
    --order_;
}

/// The lanes whose sets still say enough; the others fail.
template <class Model, class Centre>
typename parametric_flow<Model, Centre>::mask parametric_flow<Model, Centre>::useful(mask lanes) {
    for (std::size_t i = 0; i < set_.centre.size(); ++i) {
        double const limit = flow_->model().about.states[i].limit;
        // What uncertain inputs cause is no weakness of the set: no smaller box would lose less.
        C const spread = set_.centre[i].spread() + disturbed_[i];
        C const lost = set_.reach[i] - disturbed_[i];
        auto const known =
            (lost <= side_by_side::max(spread, C(0.02 * limit)) * options_.remainder_share) &
            (spread + lost <= C(options_.widest * limit));
        if (side_by_side::all(known | !lanes)) continue;
        for (std::size_t l = 0; l < width; ++l) {
            if (!side_by_side::test(lanes, l) || side_by_side::test(known, l)) continue;
            enclosure_failure why;
            why.component = i;
            why.reason = std::isfinite(side_by_side::get(lost + spread, l))
                             ? failure_reason::too_wide
                             : failure_reason::not_finite;
            fail(l, why);
            lanes = lanes & !side_by_side::only(l);
        }
    }
    return lanes;
}

template <class Model, class Centre>
void parametric_flow<Model, Centre>::reject(mask lanes, failure_reason reason, C const& shorten) {
    for (std::size_t l = 0; l < width; ++l) {
        if (!side_by_side::test(lanes, l)) continue;
        lanes_[l].why.reason = reason;
        lanes_[l].next *= side_by_side::get(shorten, l);
    }
}

template <class Model, class Centre>
template <class Entry>
std::optional<domain_edge> parametric_flow<Model, Centre>::edge(std::size_t lane,
                                                                Entry const& times,
                                                                std::vector<Entry> const& x,
                                                                std::vector<Entry> const& p) const {
    return find_domain_edge(
        *flow_, set_.time, times, x, p,
        [lane](mask const& m) { return side_by_side::test(m, lane); },
        [lane](Entry const& a) {
            auto const b = rough_bounds(a);
            return std::pair{side_by_side::get(b.lower, lane), side_by_side::get(b.upper, lane)};
        });
}

template <class Model, class Centre>
typename parametric_flow<Model, Centre>::mask
parametric_flow<Model, Centre>::advance(C const& limit) {
    mask trying = running_ & (set_.time < limit);
    bool const cancelled = options_.cancelled();
    for (std::size_t l = 0; l < width; ++l) {
        if (!side_by_side::test(trying, l)) continue;
        bool const worn = lanes_[l].attempts == 0 && lanes_[l].steps >= options_.maximum_steps;
        if (cancelled || worn) {
            enclosure_failure why;
            why.reason = cancelled ? failure_reason::cancelled : failure_reason::step_limit;
            fail(l, why);
        }
    }
    trying = useful(trying & running_);
    if (!side_by_side::any(trying)) return mask{};
    // Lanes at a kink take their turn with a step of first order, in which any function may jump.
    mask rough{};
    for (std::size_t l = 0; l < width; ++l) {
        if (lanes_[l].rough) rough = rough | side_by_side::only(l);
    }
    bool const smooth = !side_by_side::any(trying & rough);
    if (!smooth) trying = trying & rough;
    std::size_t const order = smooth ? order_ : 0;
    // What uncertain inputs spread is carried by V alone, so V's truncation counts from the first
    // step on; elsewhere its order may grow from step to step.
    std::size_t const least = perturbed_ ? 8 : 1;
    flow_order_ = std::min(std::max(flow_order_, least), std::max<std::size_t>(order_, 1));
    std::size_t const flow_order = smooth ? flow_order_ : 1;
    if (stale_ || smooth != smooth_) expand(order);
    if (expanded_ != flow_order) expand_flow(flow_order);

    mask undefined = derivative_.undefined();
    undefined &= !derivative_.steep();
    undefined |= centre_.undefined();
    undefined &= trying;
    for (std::size_t l = 0; l < width && side_by_side::any(undefined); ++l) {
        if (!side_by_side::test(undefined, l)) continue;
        enclosure_failure why;
        why.reason = failure_reason::undefined;
        why.note(edge(l, column_entry::constant(set_.time), around_, column_parameters_));
        fail(l, why);
    }
    trying = trying & !undefined;
    C to = set_.time;
    for (std::size_t l = 0; l < width; ++l) {
        if (!side_by_side::test(trying, l)) continue;
        auto& lane = lanes_[l];
        double const from = time(l);
        double const end = std::min(side_by_side::get(limit, l), flow_->next_knot(from));
        double const rest = end - from;
        if (lane.attempts == 0) {
            // Where the set touches a root of 0, the centre's coefficients say nothing of a step.
            bool const steep = smooth && side_by_side::test(derivative_.steep(), l);
            lane.root = steep;
            double const length =
                steep ? std::min(options_.longest_step(), rest) : propose(l, rest);
            lane.next = smooth && !steep ? gentle(l, length) : length;
            lane.held = lane.next < length;
            if (lane.held)
                lane.next = std::min(lane.next, std::max(0.5 * rest, options_.shortest_step()));
            lane.cut = lane.near < lane.next;
            if (lane.cut) lane.next = lane.near;
            lane.proposed = lane.next;
            lane.free = lane.next < 0.5 * rest && !lane.held && !lane.cut;
            lane.tried = infinity;
            lane.forced = false;
            lane.why = enclosure_failure{};
            lane.why.reason = failure_reason::minimum_step;
        }
        // Before a lane gives up, it tries the shortest step itself.
        double const shortest_step = shortest(l);
        if (lane.next < shortest_step && lane.tried > shortest_step) {
            lane.next = shortest_step;
            lane.proposed = std::max(lane.proposed, lane.next);
            lane.forced = true;
        }
        double const target = lane.next >= rest ? end : from + lane.next;
        lane.tried = lane.next;
        if (++lane.attempts > 60 || !(target > from) ||
            (lane.next < shortest_step && target < end)) {
            if (lane.why.reason == failure_reason::undefined) {
                C const half = (C(lane.why.until) - set_.time) * 0.5;
                lane.why.note(edge(
                    l,
                    tube_entry::constant(set_.time) +
                        tube_entry::variable(*tube_shape_, tube_shape_->variables - 1, half, half),
                    tube_box_, tube_parameters_));
            }
            if (lane.attempts == 1)
                lane.why.component = estimate(l).second; // too short to be tried
            fail(l, lane.why);
            trying = trying & !side_by_side::only(l);
            continue;
        }
        lane.why.until = target;
        side_by_side::put(to, l, target);
    }
    if (!side_by_side::any(trying)) return mask{};

    square w;
    mask jumps{};
    mask moved = attempt(trying, to, order, flow_order, w, jumps);
    if constexpr (Centre::by_formula) moved = moved && apply_formula(to, w);
    if (perturbed_ && side_by_side::any(moved)) moved = perturb(moved, to);
    for (std::size_t l = 0; l < width; ++l) {
        if (!side_by_side::test(trying, l)) continue;
        auto& lane = lanes_[l];
        if (!side_by_side::test(moved, l)) {
            if (!smooth) lane.rough = false; // a shorter step may miss the kink
            lane.cut = lane.cut || lane.rough;
            continue;
        }
        bool held = false; // such steps lose little, however many they are
        for (auto const& state : held_) held = held || side_by_side::test(state.lanes, l);
        lane.crossing = smooth || held ? 0 : lane.crossing + 1;
        lane.near = lane.cut ? 4 * lane.next : infinity;
        if (!lane.cut && (lane.next < lane.proposed || lane.free)) {
            // Aim at a tenth of the allowed truncation; what is too long costs a whole attempt.
            double const ratio = side_by_side::get(ratio_, l);
            double const exponent = 1 / static_cast<double>(order + 1);
            double const better =
                ratio > 0 ? std::clamp(std::pow(0.1 / ratio, exponent), 0.8, 1.1) : 1.1;
            lane.learned = std::clamp(lane.learned * lane.next / lane.proposed * better, 0.05, 4.0);
        }
        lane.attempts = 0;
        lane.rough = false;
        ++lane.steps;
    }
    if (side_by_side::any(moved)) accept(moved, to, order, flow_order, w, jumps);
    return moved;
}

} // namespace sivid

#endif
