// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_STEP_DETAIL_STEPPER_HPP
#define SIVID_ENCLOSURE_STEP_DETAIL_STEPPER_HPP

#include <sivid/enclosure/step/detail/stepper_class.hpp>

namespace sivid {

/// The step length at which a coefficient of the centre reaches what is allowed, and its state.
template <class I>
std::pair<double, std::size_t> stepper<I>::estimate(basic_box<I> const& x) const {
    std::pair<double, std::size_t> least{HUGE_VAL, 0};
    std::size_t const top = options_.method ? options_.method->order + 1 : options_.order;
    for (std::size_t k = top > 1 ? top - 1 : 1; k <= top; ++k) {
        for (std::size_t i = 0; i < x.size(); ++i) {
            double const c = traits::mag(centre_.state(i, k));
            if (!(c > 0) || !std::isfinite(c)) continue;
            // The remainder's half-width is a fraction of the coefficient times h^k.
            double const h = enclosure_detail::length_for(allowed(x, i), c, k);
            if (h < least.first) least = {h, i};
        }
    }
    return least;
}

/// Step length from the growth of the centre's coefficients; a preference, no proof rests on it.
template <class I>
double stepper<I>::propose(double limit, double from, basic_box<I> const& x) const {
    double const rest = limit - from;
    double const h = std::min({options_.longest_step(), rest, learned_ * estimate(x).first});
    if (h >= rest) return rest;
    return h > 0.5 * rest ? 0.5 * rest : h; // no tiny last step
}

/// The lowest order whose truncation stays within the tolerance for a step of length h.
template <class I>
std::size_t stepper<I>::choose_order(double h, basic_box<I> const& x) const {
    if (options_.method) return options_.method->order + 1;
    for (std::size_t order = 2; order < options_.order; ++order) {
        bool enough = true;
        for (std::size_t k = order; k <= order + 1 && enough; ++k) {
            for (std::size_t i = 0; i < x.size() && enough; ++i) {
                double const c = traits::mag(centre_.state(i, k));
                enough = c * enclosure_detail::power_of(h, k) <= 0.1 * allowed(x, i);
            }
        }
        if (enough) return std::min(options_.order, order + extra_order_);
    }
    return options_.order;
}

template <class I>
std::optional<tube_step<I>> stepper<I>::prove(doubleton<I> const& set, double limit,
                                              enclosure_failure& why) {
    auto const n = flow_->states();
    double const from = set.time;
    auto const x = set.hull_and_centre();
    size_ = set.largest;
    for (std::size_t i = 0; i < n; ++i) size_[i] = std::max(size_[i], flow_->small(i));
    I const begin = traits::point(from);
    why.time = from;
    if (long_) {
        if (auto step = prove_long(set, limit)) return step;
    }
    centre_.expand(from, begin, point_box<I>(set.centre),
                   options_.method ? options_.method->order + 1 : options_.order);
    if (centre_.undefined()) {
        return refuse(why, failure_reason::undefined, set, from, point_box<I>(set.centre));
    }
    double h = propose(limit, from, x);
    if (h < enclosure_detail::resting_step(options_)) {
        // Where the set touches a root of 0, the centre's coefficients say nothing of a step.
        start_.expand_with_variations(from, begin, x, 1);
        if (start_.steep()) h = std::min(options_.longest_step(), limit - from);
    }
    bool cut = near_ < h; // by a kink: the length says nothing about smooth steps
    if (cut) h = near_;
    double const proposed = h;
    bool const resting = crossing_ >= enclosure_detail::crossing_steps;
    bool root = false; // the set touches one of 0
    auto const least = [&] { return enclosure_detail::shortest_step(options_, cut && !resting); };
    auto const enough = [&] { return root ? enclosure_detail::step_off_root(options_) : least(); };
    bool smooth = true;
    bool undefined = false;
    bool unsolved = false;
    basic_box<I> tried = x; // where a function was not defined
    double until = from;
    std::size_t start_order = 0;
    for (int attempt = 0; attempt < 60; ++attempt) {
        double const to = h >= limit - from ? limit : from + h;
        if (!(to > from)) break;
        if (h < least() && to < limit) break;
        until = to;
        tube_step<I> step;
        step.from = from;
        step.to = to;
        step.order = smooth ? choose_order(h, x) : 1;
        step.variational_order =
            std::min(step.order, !smooth                          ? 1
                                 : options_.variational_order > 0 ? options_.variational_order
                                 : perturbed_ ? step.order // wide sets even from points
                                              : std::max<std::size_t>(2, (step.order + 1) / 2));
        auto const q = step.variational_order;
        step.smooth = smooth;
        if (start_order != step.variational_order) {
            start_order = step.variational_order;
            start_.expand_with_variations(from, begin, x, start_order);
        }
        if (start_.undefined() && !start_.steep())
            return refuse(why, failure_reason::undefined, set, from, x);
        root = start_.steep();
        bool became_rough = smooth && root;
        I const length = span(from, to);
        I const range = traits::bounds(0.0, traits::upper(length));
        I const times = traits::bounds(from, to);
        // Guess B from the series at X, then let the test widen it.
        auto b = sum(start_, range, q, coefficients(start_, q));
        for (std::size_t i = 0; i < n; ++i) {
            double const room = 0.05 * traits::width(b[i]) + allowed(x, i);
            b[i] = traits::add(b[i], traits::bounds(-room, room));
        }
        bool proved = false;
        undefined = false;
        for (int round = 0; round < 4 && !proved && !became_rough; ++round) {
            tube_.expand(from, times, b, step.order);
            undefined = tube_.undefined();
            if (undefined) {
                tried = b;
                break;
            }
            if (smooth && step.order > 1 && tube_.kinked()) {
                became_rough = true;
                break;
            }
            lagrange_ = coefficients(tube_, step.order);
            tube_lagrange_ = coefficients(tube_, q);
            auto const image = sum(start_, range, q, tube_lagrange_);
            proved = true;
            double worst = 0;
            for (std::size_t i = 0; i < n; ++i) {
                if (!(traits::mag(image[i]) < std::numeric_limits<double>::max())) {
                    proved = false;
                    why.component = i;
                    round = 4;
                    break;
                }
                if (!traits::subset(image[i], b[i])) {
                    proved = false;
                    double const excess = traits::width(image[i]) / traits::width(b[i]);
                    if (excess > worst) {
                        worst = excess;
                        why.component = i;
                    }
                    double const room = 0.3 * traits::width(image[i]);
                    b[i] = traits::hull(b[i], traits::add(image[i], traits::bounds(-room, room)));
                }
            }
            if (proved) step.swept = intersect(image, b);
        }
        if (proved && !smooth) { // what the room for the proof adds to a rate, as of a root at 0
            for (int round = 0; round < 2; ++round) {
                b = step.swept;
                tube_.expand(from, times, b, step.order);
                lagrange_ = tube_lagrange_ = coefficients(tube_, step.order);
                step.swept = intersect(sum(start_, range, q, tube_lagrange_), b);
            }
        }
        if (became_rough) { // a kink lies in the tube: a set-valued step of first order
            smooth = false;
            cut = true;
            start_order = 0;
            h = std::min(h, options_.longest_step());
            continue;
        }
        if (!proved) {
            h *= reject_factor;
            smooth = true;
            continue;
        }
        // Truncation within the tolerance? At kinks the first-order error is what it is: there the
        // step only has to be short against the change of the set.
        double ratio = 0;
        step.jumps = tube_.jumped();
        bool const crosses = !smooth && !resting;
        std::vector<double> crossing(crosses ? n : 0); // what such a step may lose
        if (crosses) {
            tube_.add_variations(q);
            step.jumps = step.jumps || tube_.steep();
            for (std::size_t i = 0; i < n; ++i) crossing[i] = allowed_at_kink(x, i);
            for (auto const& e : flow_->entries()) {
                if (step.jumps || e.column >= n) continue;
                crossing[e.row] += 0.25 * traits::upper(length) * traits::mag(tube_.jacobian(e)) *
                                   traits::width(x[e.column]);
            }
        }
        for (std::size_t i = 0; i < n; ++i) {
            double const error = scaled_radius(lagrange_[i], traits::upper(length), step.order);
            double const limit_i = smooth    ? allowed(x, i)
                                   : resting ? 1e3 * allowed(x, i)
                                             : crossing[i];
            if (error / limit_i > ratio) {
                ratio = error / limit_i;
                why.component = i;
            }
        }
        bool const shortest = h <= 4 * enough() ||
                              (!smooth && resting && h <= enclosure_detail::resting_step(options_));
        if (ratio > 1 && !shortest) {
            if (smooth && !options_.method && step.order < options_.order && ratio < 1e4) {
                extra_order_ += 2;
                continue;
            }
            double const power = 1.0 / static_cast<double>(step.order);
            // At a kink the loss may be in proportion to the length, and stay too large.
            double const shorter =
                h * std::clamp(0.9 * std::pow(1 / ratio, power), 0.1, smooth ? 0.8 : 0.4);
            h = smooth ? shorter : std::max(shorter, std::min(h, enough()));
            if (crosses) { // a shorter step may miss the kink
                smooth = true;
                start_order = 0;
            }
            continue;
        }
        formula_.reset();
        if (smooth && implicit_) {
            formula_ = apply_method(from, set.centre, length);
            unsolved = !formula_;
            if (unsolved) {
                why.component = steepest_rate();
                h *= reject_factor;
                continue;
            }
        }
        if (!crosses) tube_.expand_with_variations(from, times, b, q);
        bool const steep = tube_.steep();
        step.jumps = step.jumps || steep;
        undefined = tube_.undefined() && !steep;
        if (undefined || (smooth && (steep || (q > 1 && tube_.kinked())))) {
            smooth = undefined;
            cut = cut || !undefined;
            if (undefined) tried = b;
            if (undefined) h *= reject_factor;
            start_order = 0;
            continue;
        }
        auto variation =
            steep ? unbounded_variation() : bound_variation(*flow_, tube_, traits::upper(length));
        if (!variation) {
            why.component = steepest_rate();
            h *= reject_factor;
            continue;
        }
        step.variation = std::move(*variation);
        step.start = set;
        step.tube = std::move(b);
        if (!perturb(step)) {
            h *= reject_factor;
            continue;
        }
        crossing_ = smooth ? 0 : crossing_ + 1;
        near_ = cut ? 4 * h : HUGE_VAL;
        // A step that the end of the interval or a kink cut short teaches nothing.
        if (cut) return step;
        if (h < proposed) {
            learned_ = std::max(0.05, learned_ * h / proposed);
        } else if (h < 0.5 * (limit - from)) {
            learned_ = std::min(4.0, 1.08 * learned_);
        }
        return step;
    }
    if (!(until > from)) why.component = estimate(x).second; // too short to be tried
    return refuse(why,
                  undefined  ? failure_reason::undefined
                  : unsolved ? failure_reason::unsolved_stages
                             : failure_reason::minimum_step,
                  set, until, tried);
}

/// Says why, in which state, and what is likely to help.
template <class I>
std::nullopt_t stepper<I>::refuse(enclosure_failure& why, failure_reason reason,
                                  doubleton<I> const& set, double until,
                                  basic_box<I> const& tried) const {
    why.reason = reason;
    why.until = until;
    if (reason == failure_reason::undefined) {
        why.note(find_domain_edge<I>(*flow_, set.time, traits::bounds(set.time, until), tried,
                                     ensemble_->parameters));
    }
    complete(why, set, *ensemble_);
    return std::nullopt;
}

/// The state whose rate has the steepest slopes on the set.
template <class I>
std::size_t stepper<I>::steepest_rate() const {
    std::vector<double> slope(flow_->states(), 0.0);
    for (auto const& e : flow_->entries()) {
        if (e.column >= slope.size()) continue;
        double const size = traits::mag(start_.jacobian(e));
        slope[e.row] += size >= 0 ? size : HUGE_VAL; // NaN: nothing is known
    }
    return static_cast<std::size_t>(std::max_element(slope.begin(), slope.end()) - slope.begin());
}

template <class I>
std::optional<tube_step<I>> stepper<I>::prove_long(doubleton<I> const& set, double limit) {
    static constexpr double shortest = 2; // in time constants: below, the series do better
    long_map_.reset();
    if (long_pause_ > 0) {
        --long_pause_;
        return std::nullopt;
    }
    auto const n = flow_->states();
    auto const x = set.hull_and_centre();
    double const rest = limit - set.time;
    double const constant = 1 / long_->stiffness(set.time, x);
    std::vector<double> margin(n);
    for (std::size_t i = 0; i < n; ++i) margin[i] = allowed(x, i);
    double h = std::min({rest, options_.longest_step(), long_length_});
    if (h < rest && h > 0.5 * rest) h = 0.5 * rest;
    double const proposed = h;
    for (int attempt = 0; attempt < 12 && h > shortest * constant; ++attempt) {
        double const to = h >= rest ? limit : set.time + h;
        if (h < options_.shortest_step() || !(to > set.time)) break;
        auto tube = long_->enclose(set.time, to, x, set.centre, margin);
        auto map = tube ? long_->map(set.time, to, set.centre, *tube) : std::nullopt;
        double ratio = map ? 0 : HUGE_VAL;
        for (std::size_t i = 0; map && i < n; ++i) {
            auto const row = static_cast<Eigen::Index>(i);
            ratio = std::max(ratio, map->error[row] / margin[i]);
            double spread = 0; // of the derivative, on this set
            for (std::size_t c = 0; c < ensemble_->deviation.size(); ++c) {
                double const size =
                    c < n ? traits::mag(traits::sub(x[c], traits::point(set.centre[c])))
                          : traits::mag(ensemble_->deviation[c]);
                spread += map->slack(row, static_cast<Eigen::Index>(c)) * size;
            }
            ratio = std::max(ratio, spread / (margin[i] + 0.01 * traits::width(x[i])));
        }
        if (!(ratio <= 1)) {
            double const power = 1.0 / static_cast<double>(long_->order());
            h *= std::isfinite(ratio) ? std::clamp(0.9 * std::pow(ratio, -power), 0.1, 0.8) : 0.5;
            continue;
        }
        long_length_ = h < proposed ? 1.1 * h : std::max(long_length_, 1.5 * h);
        tube_step<I> step;
        step.from = set.time;
        step.to = to;
        step.start = set;
        step.order = long_->order();
        step.dissipative = true;
        step.swept = *tube;
        step.tube = std::move(*tube);
        step.variation = *unbounded_variation();
        if (!perturb(step)) break;
        long_map_ = std::move(map);
        return step;
    }
    long_length_ = 4 * h;
    long_pause_ = 8;
    return std::nullopt;
}

template <class I>
bool stepper<I>::perturb(tube_step<I>& step) {
    if (!perturbed_) return true;
    I const times = traits::bounds(step.from, step.to);
    if (!perturbed_->prove(step.from, step.to, times, step.tube, true)) return false;
    step.perturbation = perturbed_->law();
    auto const& away = perturbed_->largest();
    for (std::size_t i = 0; i < away.size(); ++i) {
        step.swept[i] = traits::add(step.swept[i], traits::bounds(-away[i], away[i]));
    }
    return true;
}

} // namespace sivid

#include <sivid/enclosure/step/detail/stepper_image.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#endif
