// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_PARAMETRIC_FLOW_HPP
#define SIVID_ENCLOSURE_PARAMETRIC_FLOW_HPP

#include <sivid/enclosure/detail/parametric_flow_class.hpp>
#include <sivid/enclosure/detail/power_sum.hpp>

namespace sivid {

template <std::size_t N, std::size_t D, class C>
void parametric_flow<N, D, C>::begin(std::size_t lane, double time, box const& initial,
                                     box const& parameters) {
    require_sound_environment();
    if (lane >= width) throw std::out_of_range("parametric_flow: no such lane");
    if (initial.size() != flow_->states() || parameters.size() != flow_->parameters()) {
        throw std::invalid_argument("parametric_flow: the boxes do not have the model's sizes");
    }
    for (auto const* x : {&initial, &parameters}) {
        for (auto const& side : *x) {
            if (!std::isfinite(mag(side))) {
                throw std::invalid_argument("parametric_flow: empty or unbounded box");
            }
        }
    }
    normalised_unknowns unknowns(initial, parameters);
    if (unknowns.variables > (D == 0 ? 0 : N)) throw std::invalid_argument("parametric_flow: too many unknowns");
    for (std::size_t j = 0; j < parameters_.size(); ++j) {
        normalised_unknowns::put(unknowns.parameters[j], lane, parameters_[j]);
        normalised_unknowns::put(unknowns.parameters[j], lane, column_parameters_[j]);
        normalised_unknowns::put(unknowns.parameters[j], lane, tube_parameters_[j]);
    }
    centre_.set_parameters(parameters_);
    derivative_.set_parameters(column_parameters_);
    tube_.set_parameters(tube_parameters_);
    observe_.set_parameters(parameters_);
    end(lane);
    if (!side_by_side::any(running_)) { // a fresh start for all
        set_ = set_type(flow_->states());
        // Knots of sampled inputs keep steps short; what lies between them decides on the order.
        order_ = flow_->sampled_inputs().empty() ? options_.order
                                                 : std::min<std::size_t>(options_.order, 6);
        flow_order_ = 3;
    }
    set_.begin(lane, time, unknowns);
    lanes_[lane] = lane_state{};
    lanes_[lane].unknowns.emplace(std::move(unknowns));
    running_ = running_ | side_by_side::only(lane);
    stale_ = true;
}

template <std::size_t N, std::size_t D, class C>
std::vector<typename parametric_flow<N, D, C>::polynomial> parametric_flow<N, D, C>::outputs() {
    std::vector<polynomial> x;
    for (std::size_t i = 0; i < set_.centre.size(); ++i) {
        x.push_back(widened(set_.centre[i], set_.reach[i]));
    }
    auto const t = polynomial::constant(set_.time);
    input_pieces<polynomial> const inputs(*flow_, set_.time, t);
    observe_.start(t);
    observe_.advance(
        0, [&x](std::size_t i, std::size_t) -> polynomial const& { return x[i]; }, inputs);
    std::vector<polynomial> result;
    for (std::size_t y = 0; y < flow_->channels(); ++y) {
        auto& p = result.emplace_back(observe_.output(y, 0));
        p.r = side_by_side::select(observe_.undefined(), C(infinity), p.r);
    }
    return result;
}

template <std::size_t N, std::size_t D, class C>
void parametric_flow<N, D, C>::expand(std::size_t order, std::size_t flow_order) {
    centre_.expand(set_.time, polynomial::constant(set_.time), set_.centre,
                   std::max<std::size_t>(order, 1));
    for (std::size_t i = 0; i < set_.centre.size(); ++i) {
        around_[i] = widened(converted<N, column_degree>(set_.centre[i]), set_.reach[i]);
    }
    derivative_.expand_with_variations(set_.time, column_entry::constant(set_.time), around_,
                                       flow_order - 1);
    smooth_ = order > 0;
    stale_ = false;
}

/// Step length from the last coefficients; a preference, no proof rests on it.
template <std::size_t N, std::size_t D, class C>
double parametric_flow<N, D, C>::propose(std::size_t lane, double rest) const {
    double h = std::min(options_.maximum_step, rest);
    for (std::size_t k = std::max<std::size_t>(order_, 2) - 1; k <= order_; ++k) {
        for (std::size_t i = 0; i < set_.centre.size(); ++i) {
            double const c = side_by_side::get(centre_.state(i, k).norm(), lane);
            if (!(c > 0) || !std::isfinite(c)) continue;
            h = std::min(h, lanes_[lane].learned *
                                std::pow(side_by_side::get(allowed(i), lane) / c,
                                         1.0 / static_cast<double>(k)));
        }
    }
    if (h >= rest) return rest;
    return h > 0.5 * rest ? std::max(0.5 * rest, std::min(h, options_.minimum_step)) : h;
}

/// One order more where the tolerance limits the step, one less where the end of an interval does.
template <std::size_t N, std::size_t D, class C>
void parametric_flow<N, D, C>::adapt_order(mask moved, C const& h, bool clamped) {
    if (!clamped) {
        order_ = std::min(options_.order, order_ + 1);
        return;
    }
    if (order_ <= 2) return;
    C power = h;
    for (std::size_t k = 1; k < order_; ++k) power *= h;
    for (std::size_t i = 0; i < set_.centre.size(); ++i) {
        auto const large = centre_.state(i, order_).norm() * power > allowed(i) * 0.05;
        if (side_by_side::any(moved & large)) return;
    }
    --order_;
}

/// \f$ \sum_{from \le k < order} h^k \|V_k\| \f$, componentwise, rounded up.
template <std::size_t N, std::size_t D, class C>
void parametric_flow<N, D, C>::sizes(C const& h, std::size_t order, std::size_t from,
                                     square& result) const {
    auto const n = flow_->states();
    result.assign(n * n, C(0.0));
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t c = 0; c < n; ++c) {
            if (!flow_->sensitive(i, c)) continue;
            C sum{};
            for (std::size_t k = order; k-- > from;) {
                sum = sum * h + derivative_.variation(i, c, k).norm();
            }
            for (std::size_t k = 0; k < from; ++k) sum *= h;
            result[i * n + c] = sum * up + polynomial::tiny;
        }
    }
}

template <std::size_t N, std::size_t D, class C>
typename parametric_flow<N, D, C>::mask
parametric_flow<N, D, C>::bound_flow(square const& base, square const& last, mask pending,
                                     square& w) const {
    auto const n = flow_->states();
    auto const image = [&](square const& x, square& y) { // (base + last (1 + x)) rounded up
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t c = 0; c < n; ++c) {
                C sum = base[i * n + c] + last[i * n + c];
                for (std::size_t l = 0; l < n; ++l) sum += last[i * n + l] * x[l * n + c];
                y[i * n + c] = sum * up;
            }
        }
    };
    square guess(n * n), inside(n * n);
    for (std::size_t k = 0; k < n * n; ++k) guess[k] = base[k] + last[k];
    mask found{};
    w.assign(n * n, C(0.0));
    for (int round = 0; round < 8; ++round) {
        image(guess, inside);
        for (std::size_t k = 0; k < n * n; ++k) guess[k] = inside[k] * 1.1 + 1e-300;
        image(guess, inside);
        mask good = pending & !found;
        for (std::size_t k = 0; k < n * n; ++k) good = good & (inside[k] < guess[k]);
        if (side_by_side::any(good)) {
            for (std::size_t k = 0; k < n * n; ++k) w[k] = side_by_side::select(good, guess[k], w[k]);
            found = found | good;
        }
        if (!side_by_side::any(pending & !found)) break;
    }
    return found;
}

/// The lanes whose sets still say enough; the others fail.
template <std::size_t N, std::size_t D, class C>
typename parametric_flow<N, D, C>::mask parametric_flow<N, D, C>::useful(mask lanes) {
    for (std::size_t i = 0; i < set_.centre.size(); ++i) {
        double const limit = flow_->model().about.states[i].limit;
        C const spread = set_.centre[i].spread();
        C const lost = set_.reach[i];
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
            why.help = advice::smaller_box;
            fail(l, why);
            lanes = lanes & !side_by_side::only(l);
        }
    }
    return lanes;
}

template <std::size_t N, std::size_t D, class C>
void parametric_flow<N, D, C>::reject(mask lanes, failure_reason reason, C const& shorten) {
    for (std::size_t l = 0; l < width; ++l) {
        if (!side_by_side::test(lanes, l)) continue;
        lanes_[l].why.reason = reason;
        lanes_[l].why.help = advice::smaller_box;
        lanes_[l].next *= side_by_side::get(shorten, l);
    }
}

template <std::size_t N, std::size_t D, class C>
typename parametric_flow<N, D, C>::mask parametric_flow<N, D, C>::advance(C const& limit) {
    mask trying = running_ & (set_.time < limit);
    for (std::size_t l = 0; l < width; ++l) {
        if (!side_by_side::test(trying, l)) continue;
        if (lanes_[l].attempts == 0 && lanes_[l].steps >= options_.maximum_steps) {
            enclosure_failure why;
            why.reason = failure_reason::step_limit;
            why.help = advice::more_steps;
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
    flow_order_ = std::min(flow_order_, std::max<std::size_t>(order_, 1));
    std::size_t const flow_order = smooth ? flow_order_ : 1;
    if (stale_ || smooth != smooth_) expand(order, flow_order);

    mask const undefined = trying & (centre_.undefined() | derivative_.undefined());
    for (std::size_t l = 0; l < width && side_by_side::any(undefined); ++l) {
        if (!side_by_side::test(undefined, l)) continue;
        enclosure_failure why;
        why.reason = failure_reason::undefined;
        why.help = advice::smaller_box;
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
            lane.proposed = lane.next = propose(l, rest);
            lane.free = lane.next < 0.5 * rest;
            lane.why = enclosure_failure{};
            lane.why.reason = failure_reason::minimum_step;
            lane.why.help = advice::smaller_box;
        }
        double const target = lane.next >= rest ? end : from + lane.next;
        if (++lane.attempts > 60 || !(target > from) ||
            (lane.next < options_.minimum_step && target < end)) {
            fail(l, lane.why);
            trying = trying & !side_by_side::only(l);
            continue;
        }
        side_by_side::put(to, l, target);
    }
    if (!side_by_side::any(trying)) return mask{};

    square w;
    mask jumps{};
    mask const moved = attempt(trying, to, order, flow_order, w, jumps);
    for (std::size_t l = 0; l < width; ++l) {
        if (!side_by_side::test(trying, l)) continue;
        auto& lane = lanes_[l];
        if (!side_by_side::test(moved, l)) {
            if (!smooth) lane.rough = false; // a shorter step may miss the kink
            continue;
        }
        if (lane.next < lane.proposed || lane.free) {
            // Aim at a tenth of the allowed truncation; what is too long costs a whole attempt.
            double const ratio = side_by_side::get(ratio_, l);
            double const exponent = 1 / static_cast<double>(order + 1);
            double const better =
                ratio > 0 ? std::clamp(std::pow(0.1 / ratio, exponent), 0.8, 1.1) : 1.1;
            lane.learned =
                std::clamp(lane.learned * lane.next / lane.proposed * better, 0.05, 4.0);
        }
        lane.attempts = 0;
        lane.rough = false;
        ++lane.steps;
    }
    if (side_by_side::any(moved)) accept(moved, to, order, flow_order, w, jumps);
    return moved;
}

/// The tube's middle: the Taylor polynomials over s = h (1 + tau)/2, in q and tau.
template <std::size_t N, std::size_t D, class C>
void parametric_flow<N, D, C>::guess_tube(C const& h, std::size_t order) {
    for (std::size_t i = 0; i < path_.size(); ++i) {
        path_[i] = polynomial_in_time_of<tube_degree, N, D, C>(
            [&](std::size_t k) -> polynomial const& { return centre_.state(i, k); }, order, h);
    }
}

template <std::size_t N, std::size_t D, class C>
typename parametric_flow<N, D, C>::mask
parametric_flow<N, D, C>::attempt(mask trying, C const& to, std::size_t order,
                                  std::size_t flow_order, square& w, mask& jumps) {
    auto const n = flow_->states();
    std::size_t const K = order;
    std::size_t const L = flow_order;
    C const half = C(0.5);
    if (K > 0) {
        mask const kinked = trying & (centre_.kinked() | derivative_.kinked());
        for (std::size_t l = 0; l < width; ++l) {
            if (side_by_side::test(kinked, l)) lanes_[l].rough = true;
        }
        trying = trying & !kinked;
        if (!side_by_side::any(trying)) return mask{};
    }
    C const h = (to - set_.time) * (1 + 4 * polynomial::unit); // not less than the length
    C power = h;                                               // h^(K+1), h^L, rounded up
    C flow_power = h;
    for (std::size_t k = 1; k < K + 1; ++k) power *= h;
    for (std::size_t k = 1; k < L; ++k) flow_power *= h;
    power *= up;
    flow_power *= up;
    auto const s = tube_entry::variable(N, h * 0.5, h * 0.5);
    auto const times = tube_entry::constant(set_.time) + s;
    // What the reach becomes during the step, as far as the series knows.
    square all, base, last;
    sizes(h, L, 0, all);
    sizes(h, L, 1, base);
    std::vector<C> carried(n), spread(n);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t c = 0; c < n; ++c) carried[i] += all[i * n + c] * set_.reach[c];
    }
    guess_tube(h, K);
    C const before = power / h;
    for (std::size_t i = 0; i < n; ++i) {
        C const next = K > 0 ? centre_.state(i, K).norm() * before : centre_.state(i, 1).norm() * h;
        room_[i] = carried[i] * 1.2 + next + allowed(i) * 0.1;
    }
    auto const shortest = h <= C(4 * options_.minimum_step);
    mask proved{};
    for (int round = 0; round < 3; ++round) {
        for (std::size_t i = 0; i < n; ++i) tube_box_[i] = widened(path_[i], room_[i]);
        tube_.expand(set_.time, times, tube_box_, K + 1);
        mask undefined = trying & tube_.undefined();
        if (side_by_side::any(undefined)) {
            reject(undefined, failure_reason::undefined, half);
            trying = trying & !undefined;
        }
        mask const kinked = trying & tube_.kinked();
        if (side_by_side::any(kinked)) {
            for (std::size_t l = 0; l < width; ++l) {
                if (side_by_side::test(kinked, l)) lanes_[l].rough = true;
            }
            trying = trying & !kinked;
        }
        // Without series terms x(h) = x(0) + h f(b) holds for every member, jumps or not. With them
        // no sign varies here (it would be a kink), and V carries the members as usual.
        jumps = K == 0 ? trying & tube_.jumped() : mask{};
        C ratio{}; // of the truncation to what is allowed
        for (std::size_t i = 0; i < n; ++i) {
            auto const& lagrange = tube_.state(i, K + 1);
            truncation_[i] = lagrange.norm() * power * up;
            C const scale = allowed(i) * (K > 0 ? 10.0 : 1e4);
            C const share = (lagrange.spread() + lagrange.r) * power / scale;
            // NaN counts as too large.
            auto const more = !(share <= ratio);
            ratio = side_by_side::select(more, share, ratio);
            if (!side_by_side::any(trying & more)) continue;
            for (std::size_t l = 0; l < width; ++l) {
                if (side_by_side::test(more, l)) lanes_[l].why.component = i;
            }
        }
        mask const enough = shortest | (K > 0 ? mask{} : mask(h <= C(1e-4)));
        ratio_ = ratio;
        mask const too_long = trying & !(ratio <= C(1.0)) & !enough;
        if (side_by_side::any(too_long)) {
            auto const shorten = each_lane<C>([&](std::size_t l) {
                double const x = side_by_side::get(ratio, l);
                if (!std::isfinite(x)) return 0.5;
                return std::clamp(0.9 * std::pow(x, -1.0 / static_cast<double>(K + 1)), 0.3, 0.9);
            });
            reject(too_long, failure_reason::minimum_step, shorten);
            trying = trying & !too_long;
        }
        if (!side_by_side::any(trying)) return mask{};
        last.assign(n * n, C(0.0));
        w.assign(n * n, C(0.0));
        for (std::size_t i = 0; i < n; ++i) spread[i] = set_.reach[i];
        if (side_by_side::any(trying & !jumps)) {
            tube_.add_variations(L);
            undefined = trying & !jumps & tube_.undefined();
            if (L > 1) {
                mask const late = trying & !jumps & tube_.kinked();
                for (std::size_t l = 0; l < width; ++l) {
                    if (side_by_side::test(late, l)) lanes_[l].rough = true;
                }
                trying = trying & !late;
            }
            if (side_by_side::any(undefined)) {
                reject(undefined, failure_reason::undefined, half);
                trying = trying & !undefined;
            }
            for (std::size_t i = 0; i < n; ++i) {
                for (std::size_t c = 0; c < n; ++c) {
                    if (!flow_->sensitive(i, c)) continue;
                    last[i * n + c] = tube_.variation(i, c, L).norm() * flow_power * up;
                }
            }
            mask const bounded = bound_flow(base, last, trying & !jumps, w);
            mask const unbounded = trying & !jumps & !bounded;
            if (side_by_side::any(unbounded)) {
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
        for (std::size_t i = 0; i < n; ++i) {
            C const image = (truncation_[i] + spread[i]) * up;
            auto const inside = image < room_[i];
            proved = proved & inside;
            if (side_by_side::all(inside | !trying)) continue;
            for (std::size_t l = 0; l < width; ++l) {
                if (!side_by_side::test(inside, l)) lanes_[l].why.component = i;
            }
        }
        mask const open = trying & !proved;
        if (!side_by_side::any(open) || round == 2) {
            reject(open, failure_reason::minimum_step, C(0.7));
            return proved;
        }
        // Rooms of lanes that are proved stay, so that the next round finds the same there.
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

template <std::size_t N, std::size_t D, class C>
void parametric_flow<N, D, C>::accept(mask moved, C const& to, std::size_t order,
                                      std::size_t flow_order, square const& w, mask jumps) {
    auto const n = flow_->states();
    C const length = to - set_.time; // off by less than a unit
    std::vector<C> lost(n);
    std::vector<polynomial> next(n);
    for (std::size_t i = 0; i < n; ++i) {
        auto const last = without_last_variable<N, D>(tube_.state(i, order + 1));
        next[i] = at_time<polynomial>(
            [&](std::size_t k) -> polynomial const& {
                return k <= order ? centre_.state(i, k) : last;
            },
            order + 1, length);
        lost[i] = side_by_side::select(moved, next[i].r, C(0.0));
        next[i].r = 0.0;
    }
    // The order of V follows the size of its Lagrange term.
    C tail{};
    C flow_power = length;
    for (std::size_t k = 1; k < flow_order; ++k) flow_power *= length;
    if (!side_by_side::all(jumps | !moved)) {
        for (std::size_t i = 0; i < n; ++i) {
            C row{};
            for (std::size_t c = 0; c < n; ++c) {
                if (!flow_->sensitive(i, c)) continue;
                row += tube_.variation(i, c, flow_order).norm();
            }
            tail = side_by_side::max(tail, row * flow_power);
        }
    }
    if (!side_by_side::all(jumps | !moved) && !set_.columns.empty()) {
        std::vector<column_entry> j(n * n);
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t c = 0; c < n; ++c) {
                if (!flow_->sensitive(i, c)) continue;
                auto last = without_last_variable<N, column_degree>(
                    tube_.variation(i, c, flow_order));
                C spread{}; // |J_L(b)| W
                for (std::size_t l = 0; l < n; ++l) {
                    if (!flow_->sensitive(i, l)) continue;
                    spread += tube_.variation(i, l, flow_order).norm() * w[l * n + c];
                }
                last = widened(last, spread * up);
                auto const sum = at_time<column_entry>(
                    [&](std::size_t k) -> column_entry const& {
                        return k < flow_order ? derivative_.variation(i, c, k) : last;
                    },
                    flow_order, length);
                // Lanes that stay, or jump, keep their generators.
                j[i * n + c] = select(moved & !jumps, sum,
                                      column_entry::constant(C(i == c ? 1.0 : 0.0)));
            }
        }
        for (auto& g : set_.columns) {
            typename set_type::column image(n);
            for (std::size_t i = 0; i < n; ++i) {
                product_sum<N, column_degree, C> sum;
                for (std::size_t l = 0; l < n; ++l) {
                    if (!flow_->sensitive(i, l) || side_by_side::all(g[l].norm() == C(0.0))) continue;
                    sum.add(j[i * n + l], g[l]);
                }
                image[i] = select(moved & !jumps, sum.result(), g[i]);
                lost[i] += image[i].r;
                image[i].r = 0.0;
            }
            g = std::move(image);
        }
    }
    for (auto& x : lost) x *= up;
    bool clamped = true;
    for (std::size_t l = 0; l < width; ++l) {
        if (!side_by_side::test(moved, l)) continue;
        double const h = side_by_side::get(length, l);
        clamped = clamped && (side_by_side::get(to, l) >= flow_->next_knot(time(l)) ||
                              h >= options_.maximum_step);
    }
    if (order > 0) {
        if (side_by_side::any(moved & (tail > C(1e-3)))) {
            flow_order_ = std::min(flow_order + 1, options_.order);
        } else if (side_by_side::all((tail < C(1e-6)) | !moved) && flow_order > 2) {
            flow_order_ = flow_order - 1;
        }
        adapt_order(moved, length, clamped);
    } else {
        flow_order_ = 3;
    }
    for (std::size_t i = 0; i < n; ++i) {
        set_.centre[i] = select(moved, next[i], set_.centre[i]);
        swept_[i] = select(moved, tube_box_[i], swept_[i]);
    }
    set_.time = side_by_side::select(moved, to, set_.time);
    set_.append(lost);
    set_.reduce(10 * n, running_);
    set_.measure();
    stale_ = true;
}

} // namespace sivid

#endif
