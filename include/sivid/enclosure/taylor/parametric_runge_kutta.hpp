// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_TAYLOR_PARAMETRIC_RUNGE_KUTTA_HPP
#define SIVID_ENCLOSURE_TAYLOR_PARAMETRIC_RUNGE_KUTTA_HPP

#include <sivid/enclosure/taylor/detail/parametric_runge_kutta_class.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sivid {

template <class Model>
void parametric_runge_kutta<Model>::begin(double time, box const& initial, box const& parameters) {
    require_sound_environment();
    if (initial.size() != flow_->states() || parameters.size() != flow_->parameters()) {
        throw std::invalid_argument("parametric_runge_kutta: the boxes do not have the model's "
                                    "sizes");
    }
    for (auto const* x : {&initial, &parameters}) {
        for (auto const& side : *x) {
            if (!std::isfinite(mag(side))) {
                throw std::invalid_argument("parametric_runge_kutta: empty or unbounded box");
            }
        }
    }
    normalised_unknowns unknowns(initial, parameters);
    if (unknowns.variables > shape_->variables) {
        throw std::invalid_argument("parametric_runge_kutta: too many unknowns");
    }
    unknowns_ = std::move(unknowns);
    auto const p = parameter_models(*shape_);
    auto const wide = parameter_models(*tube_shape_);
    centre_.set_parameters(p);
    derivative_.set_parameters(parameter_models(*column_shape_));
    tube_.set_parameters(wide);
    if (explicit_value_) {
        explicit_value_->set_parameters(p);
        explicit_next_->set_parameters(wide);
    } else {
        implicit_value_->set_parameters(p);
        implicit_next_->set_parameters(wide);
    }
    if (perturbed_) perturbed_->set_parameters(wide);
    disturbed_.assign(flow_->states(), 0.0);
    set_ = set_type(flow_->states(), *shape_);
    set_.begin(0, time, *unknowns_);
    swept_.clear();
    failure_.reset();
    steps_ = 0;
    learned_ = 1;
}

template <class Model>
double parametric_runge_kutta<Model>::propose(double rest) const {
    double const h = std::min({options_.longest_step(), rest, learned_ * estimate().first});
    if (h >= rest) return rest;
    return h > 0.5 * rest ? std::max(0.5 * rest, std::min(h, options_.minimum_step)) : h;
}

template <class Model>
bool parametric_runge_kutta<Model>::useful(enclosure_failure& why) const {
    for (std::size_t i = 0; i < set_.centre.size(); ++i) {
        double const limit = flow_->model().about.states[i].limit;
        double const spread = set_.centre[i].spread() + disturbed_[i];
        double const lost = set_.reach[i] - disturbed_[i];
        bool const hopeless = lost > options_.remainder_share * std::max(spread, 0.02 * limit);
        if (spread + lost <= options_.widest * limit && !hopeless) continue;
        why.component = i;
        why.reason =
            std::isfinite(lost + spread) ? failure_reason::too_wide : failure_reason::not_finite;
        return false;
    }
    return true;
}

template <class Model>
bool parametric_runge_kutta<Model>::step(double limit) {
    if (failure_) return false;
    if (!(limit > set_.time)) {
        throw std::invalid_argument("parametric_runge_kutta: a step must go forward");
    }
    enclosure_failure why;
    if (steps_ >= options_.maximum_steps) {
        why.reason = failure_reason::step_limit;
        return fail(why);
    }
    if (options_.cancelled()) {
        why.reason = failure_reason::cancelled;
        return fail(why);
    }
    if (!useful(why)) return fail(why);
    limit = std::min(limit, flow_->next_knot(set_.time));
    double const from = set_.time;
    double const rest = limit - from;
    centre_.expand(from, polynomial::constant(from), set_.centre, order_);
    std::vector<polynomial> around;
    for (std::size_t i = 0; i < set_.centre.size(); ++i) {
        around.push_back(widened(converted(set_.centre[i], *column_shape_), set_.reach[i]));
    }
    derivative_.expand_with_variations(from, polynomial::constant(from), around, flow_order_ - 1);
    if (centre_.undefined() || derivative_.undefined()) {
        why.reason = failure_reason::undefined;
        why.note(edge(*column_shape_, polynomial::constant(from), around));
        return fail(why);
    }
    double h = propose(rest);
    double const proposed = h;
    for (int attempt = 0; attempt < 40; ++attempt) {
        double const to = h >= rest ? limit : from + h;
        if (!(to > from) || (h < options_.minimum_step && to < limit)) break;
        why.until = to;
        double shorten = 0.5;
        if (try_step(to, shorten, why)) {
            ++steps_;
            if (h < proposed) {
                learned_ = std::max(0.05, learned_ * h / proposed);
            } else if (h < 0.5 * rest) {
                learned_ = std::min(4.0, 1.08 * learned_);
            }
            return true;
        }
        h *= shorten;
    }
    if (!(why.until > from)) why.component = estimate().second; // too short to be tried
    if (why.reason == failure_reason::undefined) {
        double const half = 0.5 * (why.until - from);
        why.note(edge(*tube_shape_, polynomial::constant(from) + within_step(half), tube_box_));
    }
    return fail(why);
}

template <class Model>
bool parametric_runge_kutta<Model>::apply_method(interval const& h) {
    double const from = set_.time;
    auto const length = polynomial::constant(h);
    // All times of the step: s = h/2 (1 + tau).
    auto const s = within_step(0.5 * h.upper());
    std::vector<polynomial> start;
    for (auto const& p : set_.centre) start.push_back(converted(p, *tube_shape_));
    if (explicit_value_) {
        bool undefined = false;
        value_ = explicit_value_->coefficient(from, set_.centre, length, 0, undefined);
        bool const rough = explicit_value_->kinked();
        next_ = explicit_next_->coefficient(from, start, s, order_ + 1, undefined);
        return !undefined && !rough && !explicit_next_->kinked();
    }
    auto const last = implicit_value_->stages().prove(from, set_.centre, length);
    if (!last) return false;
    value_ = implicit_value_->value(set_.centre, length, *last);
    // One region of uniqueness for the whole step, which holds the stages at its begin and those
    // that make the value: they are on one branch.
    std::vector<polynomial> there;
    for (auto const& k : last->value) there.push_back(converted(k, *tube_shape_));
    auto const zero = std::vector<polynomial>(there.size());
    auto const first = implicit_next_->stages().apply(from, start, polynomial::constant(0.0), zero);
    if (!first) return false;
    auto const all = implicit_next_->stages().prove(from, start, s, {*first, there});
    if (!all || !all->holds(*first) || !all->holds(there)) return false;
    auto next = implicit_next_->coefficient(from, start, s, *all, order_ + 1);
    if (!next) return false;
    next_ = std::move(*next);
    return true;
}

template <class Model>
bool parametric_runge_kutta<Model>::try_step(double to, double& shorten, enclosure_failure& why) {
    using namespace enclosure_detail;
    using traits = interval_traits<interval>;
    auto const n = flow_->states();
    double const from = set_.time;
    auto const length = traits::sub(traits::point(to), traits::point(from));
    double const h = length.upper();
    std::size_t const K = order_;
    std::size_t const L = flow_order_;
    why.reason = failure_reason::minimum_step;
    if (centre_.kinked() || derivative_.kinked()) return false;
    auto const s = within_step(0.5 * h);
    auto const times = polynomial::constant(from) + s;
    auto const base = variation_sizes(*flow_, derivative_, n, h, L, 1);
    auto const all = variation_sizes(*flow_, derivative_, n, h, L, 0);
    std::vector<double> carried(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t c = 0; c < n; ++c) carried[i] += all[i * n + c] * set_.reach[c];
    }
    bool never = false;
    double const power = traits::pown(length, static_cast<int>(K + 1), never).upper();
    double const flow_power = traits::pown(length, static_cast<int>(L), never).upper();
    std::vector<polynomial> path;
    std::vector<double> room;
    for (std::size_t i = 0; i < n; ++i) {
        auto b = converted(centre_.state(i, K), *tube_shape_);
        for (std::size_t k = K; k-- > 0;) {
            b = b * s + converted(centre_.state(i, k), *tube_shape_);
        }
        path.push_back(b);
        room.push_back(1.2 * carried[i] + centre_.state(i, K).norm() * power / h +
                       0.1 * allowed(i));
    }
    for (int round = 0; round < 3; ++round) {
        tube_box_.clear();
        for (std::size_t i = 0; i < n; ++i) tube_box_.push_back(widened(path[i], room[i]));
        tube_.expand(from, times, tube_box_, K + 1);
        if (tube_.undefined()) {
            why.reason = failure_reason::undefined;
            return false;
        }
        if (tube_.kinked() || tube_.jumped()) return false;
        std::vector<double> truncation;
        double ratio = 0;
        for (std::size_t i = 0; i < n; ++i) {
            auto const& last = tube_.state(i, K + 1);
            truncation.push_back(last.norm() * power * up);
            double const share = (last.spread() + last.r()) * power / (10 * allowed(i));
            if (!(share <= ratio)) {
                ratio = share;
                why.component = i;
            }
        }
        if (!(ratio <= 1) && h > 4 * options_.minimum_step) {
            shorten =
                std::isfinite(ratio)
                    ? std::clamp(0.9 * std::pow(ratio, -1.0 / static_cast<double>(K + 1)), 0.3, 0.9)
                    : 0.5;
            return false;
        }
        tube_.expand_with_variations(from, times, tube_box_, L);
        if (tube_.undefined()) why.reason = failure_reason::undefined;
        if (tube_.undefined() || tube_.kinked()) return false;
        auto const last = last_variation_sizes(*flow_, tube_, n, flow_power, L);
        std::vector<double> w;
        // What acts through a chain of states takes a round for each of them to arrive.
        if (!bound_variations(base, last, n, 8 + n, true, w)) {
            why.component = steepest(base, last);
            return false;
        }
        std::vector<double> spread(n); // carried + last (1 + w) reach
        for (std::size_t i = 0; i < n; ++i) {
            double sum = carried[i];
            for (std::size_t l = 0; l < n; ++l) {
                double inner = set_.reach[l];
                for (std::size_t c = 0; c < n; ++c) inner += w[l * n + c] * set_.reach[c];
                sum += last[i * n + l] * inner;
            }
            spread[i] = sum * up;
        }
        bool proved = true;
        double worst = 0;
        for (std::size_t i = 0; i < n; ++i) {
            double const image = (truncation[i] + spread[i]) * up;
            if (image < room[i]) continue;
            proved = false;
            if (!(image / room[i] <= worst)) {
                worst = image / room[i];
                why.component = i;
            }
            room[i] = 1.3 * image;
        }
        if (!std::all_of(room.begin(), room.end(), [](double x) { return std::isfinite(x); })) {
            return false;
        }
        if (!proved) continue;
        if (!apply_method(length)) {
            if (implicit_value_) {
                why.reason = failure_reason::unsolved_stages;
                why.component = steepest(base, last);
            }
            return false;
        }
        // What of the local error does not depend on the time within the step goes into the centre.
        for (std::size_t i = 0; i < n && h > 4 * options_.minimum_step; ++i) {
            if ((next_[i].spread() + next_[i].r()) * power <= 20 * allowed(i)) continue;
            shorten = 0.7;
            why.component = i;
            return false;
        }
        if (perturbed_ && !perturbed_->prove(from, to, times, tube_box_, true)) {
            shorten = 0.5;
            return false;
        }
        accept(to, length, w);
        return true;
    }
    shorten = 0.7;
    return false;
}

template <class Model>
void parametric_runge_kutta<Model>::accept(double to, interval const& h,
                                           std::vector<double> const& w) {
    using namespace enclosure_detail;
    using traits = interval_traits<interval>;
    auto const n = flow_->states();
    std::size_t const L = flow_order_;
    bool never = false;
    auto const power = traits::pown(h, static_cast<int>(order_ + 1), never);
    std::vector<double> lost(n);
    std::vector<polynomial> next(n);
    for (std::size_t i = 0; i < n; ++i) {
        auto const error = tube_.state(i, order_ + 1) - next_[i];
        next[i] = value_[i] + scaled(without_last_variable(error, *shape_), power);
        lost[i] = next[i].r();
        next[i].r() = 0;
    }
    std::vector<polynomial> j(n * n);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t c = 0; c < n; ++c) {
            if (!flow_->sensitive(i, c)) continue;
            auto const last = last_variation(*flow_, tube_, w, i, c, L, *column_shape_);
            j[i * n + c] =
                variation_at_end(derivative_, last, i, c, L, *column_shape_, to - set_.time);
        }
    }
    for (auto& g : set_.columns) {
        typename set_type::column image(n);
        for (std::size_t i = 0; i < n; ++i) {
            product_sum<> sum;
            for (std::size_t l = 0; l < n; ++l) {
                if (flow_->sensitive(i, l) && g[l].norm() != 0) sum.add(j[i * n + l], g[l]);
            }
            image[i] = sum.result();
            lost[i] += image[i].r();
            image[i].r() = 0;
        }
        g = std::move(image);
    }
    if (perturbed_) {
        auto const all = variation_sizes(*flow_, derivative_, n, h.upper(), L, 0);
        std::vector<double> disturbed(perturbed_->at_end());
        for (std::size_t i = 0; i < n; ++i) {
            lost[i] += perturbed_->at_end()[i];
            tube_box_[i] = widened(tube_box_[i], perturbed_->largest()[i]);
            for (std::size_t c = 0; c < n; ++c) disturbed[i] += all[i * n + c] * disturbed_[c];
        }
        disturbed_ = std::move(disturbed);
    }
    for (auto& x : lost) x *= up;
    set_.time = to;
    swept_ = tube_box_;
    set_.centre = std::move(next);
    set_.reduce(13 * n, lost);
    set_.append(lost);
    set_.measure();
    for (std::size_t i = 0; i < n; ++i) disturbed_[i] = std::min(disturbed_[i], set_.reach[i]);
}

} // namespace sivid

#endif
