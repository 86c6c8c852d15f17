// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_PARAMETRIC_FLOW_HPP
#define SIVID_ENCLOSURE_PARAMETRIC_FLOW_HPP

#include <sivid/enclosure/detail/parametric_flow_class.hpp>

namespace sivid {

/// Step length from the last coefficients; a preference, no proof rests on it.
template <std::size_t N, std::size_t D>
double parametric_flow<N, D>::propose(double rest) const {
    double h = std::min(options_.maximum_step, rest);
    for (std::size_t k = std::max<std::size_t>(order_, 2) - 1; k <= order_; ++k) {
        for (std::size_t i = 0; i < set_.centre.size(); ++i) {
            double const c = centre_.state(i, k).norm();
            if (!(c > 0) || !std::isfinite(c)) continue;
            h = std::min(h, learned_ * std::pow(allowed(i) / c, 1.0 / static_cast<double>(k)));
        }
    }
    if (h >= rest) return rest;
    return h > 0.5 * rest ? std::max(0.5 * rest, std::min(h, options_.minimum_step)) : h;
}

/// One order more where the tolerance limits the step, one less where the end of an interval does.
template <std::size_t N, std::size_t D>
void parametric_flow<N, D>::adapt_order(double h, bool clamped) {
    if (!clamped) {
        order_ = std::min(options_.order, order_ + 1);
        return;
    }
    if (order_ <= 2) return;
    for (std::size_t i = 0; i < set_.centre.size(); ++i) {
        double const c = centre_.state(i, order_).norm();
        if (c * std::pow(h, static_cast<double>(order_)) > 0.05 * allowed(i)) return;
    }
    --order_;
}

/// \f$ \sum_{from \le k < L} h^k \|V_k\| \f$, componentwise, rounded up.
template <std::size_t N, std::size_t D>
Eigen::MatrixXd parametric_flow<N, D>::sizes(double h, std::size_t from) const {
    auto const n = flow_->states();
    Eigen::MatrixXd result =
        Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t c = 0; c < n; ++c) {
            if (!flow_->sensitive(i, c)) continue;
            double sum = 0;
            for (std::size_t k = flow_order_; k-- > from;) {
                sum = sum * h + derivative_.variation(i, c, k).norm();
            }
            for (std::size_t k = 0; k < from; ++k) sum *= h;
            result(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c)) = sum * up + polynomial::tiny;
        }
    }
    return result;
}

template <std::size_t N, std::size_t D>
bool parametric_flow<N, D>::bound_flow(double h, Eigen::MatrixXd const& last,
                                       Eigen::MatrixXd& w) const {
    auto const base = sizes(h, 1);
    auto const one = Eigen::MatrixXd::Identity(base.rows(), base.cols());
    auto const image = [&](Eigen::MatrixXd const& x) -> Eigen::MatrixXd {
        return (base + last * (one + x)) * up;
    };
    Eigen::MatrixXd guess = base + last;
    for (int round = 0; round < 8; ++round) {
        guess = 1.1 * image(guess);
        guess.array() += 1e-300;
        if (!guess.allFinite()) return false;
        if ((image(guess).array() < guess.array()).all()) {
            w = guess;
            return true;
        }
    }
    return false;
}

template <std::size_t N, std::size_t D>
bool parametric_flow<N, D>::useful(enclosure_failure& why) const {
    for (std::size_t i = 0; i < set_.centre.size(); ++i) {
        double const limit = flow_->model().about.states[i].limit;
        double const spread = set_.centre[i].spread();
        double const lost = set_.reach[i];
        bool const hopeless = lost > options_.remainder_share * std::max(spread, 0.02 * limit);
        if (spread + lost <= options_.widest * limit && !hopeless) continue;
        why.component = i;
        why.reason =
            std::isfinite(lost + spread) ? failure_reason::too_wide : failure_reason::not_finite;
        why.help = advice::smaller_box;
        return false;
    }
    return true;
}

template <std::size_t N, std::size_t D>
bool parametric_flow<N, D>::step(double limit) {
    if (failure_) return false;
    if (!(limit > set_.time)) throw std::invalid_argument("parametric_flow: a step must go forward");
    enclosure_failure why;
    if (steps_ >= options_.maximum_steps) {
        why.reason = failure_reason::step_limit;
        why.help = advice::more_steps;
        return fail(why);
    }
    if (!useful(why)) return fail(why);
    limit = std::min(limit, flow_->next_knot(set_.time));
    double const from = set_.time;
    double const rest = limit - from;
    smooth_ = true;
    jumps_ = false;
    auto const expand = [&] {
        centre_.expand(from, polynomial::constant(from), set_.centre,
                       std::max<std::size_t>(order_, 1));
        std::vector<column_entry> around;
        for (std::size_t i = 0; i < set_.centre.size(); ++i) {
            around.push_back(widened(converted<N, column_degree>(set_.centre[i]), set_.reach[i]));
        }
        flow_order_ = std::min(flow_order_, std::max<std::size_t>(order_, 1));
        derivative_.expand_with_variations(from, column_entry::constant(from), around,
                                           flow_order_ - 1);
    };
    expand();
    if (centre_.undefined() || derivative_.undefined()) {
        why.reason = failure_reason::undefined;
        why.help = advice::smaller_box;
        return fail(why);
    }
    double h = propose(rest);
    double const proposed = h;
    for (int attempt = 0; attempt < 40; ++attempt) {
        double const to = h >= rest ? limit : from + h;
        if (!(to > from) || (h < options_.minimum_step && to < limit)) break;
        bool const was_smooth = smooth_;
        auto const order = order_;
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
        if (was_smooth && !smooth_) { // a kink: first order, same length
            order_ = 0;
            flow_order_ = 1;
            expand();
            bool const done = try_step(to, shorten, why);
            order_ = order;
            if (done) {
                ++steps_;
                flow_order_ = 3;
                return true;
            }
            smooth_ = true;
            flow_order_ = 3;
            expand();
        }
        h *= shorten;
    }
    return fail(why);
}

template <std::size_t N, std::size_t D>
bool parametric_flow<N, D>::try_step(double to, double& shorten, enclosure_failure& why) {
    using traits = interval_traits<interval>;
    auto const n = flow_->states();
    double const from = set_.time;
    auto const length = traits::sub(traits::point(to), traits::point(from));
    double const h = length.upper();
    std::size_t const K = order_;
    std::size_t const L = flow_order_;
    if (K > 0 && (centre_.kinked() || derivative_.kinked())) {
        smooth_ = false;
        return false;
    }
    // Time within the step: s = h/2 (1 + tau).
    auto const s = tube_entry::variable(N, 0.5 * h, 0.5 * h);
    auto const times = tube_entry::constant(from) + s;
    // What the reach becomes during the step, as far as the series knows.
    Eigen::VectorXd reach(static_cast<Eigen::Index>(n));
    for (std::size_t i = 0; i < n; ++i) reach[static_cast<Eigen::Index>(i)] = set_.reach[i];
    Eigen::VectorXd const carried = sizes(h, 0) * reach;
    std::vector<tube_entry> path;
    std::vector<double> room;
    bool never = false;
    double const power = traits::pown(length, static_cast<int>(K + 1), never).upper();
    double const flow_power = traits::pown(length, static_cast<int>(L), never).upper();
    for (std::size_t i = 0; i < n; ++i) {
        auto b = converted<N + 1, tube_degree>(centre_.state(i, K));
        for (std::size_t k = K; k-- > 0;) {
            b = b * s + converted<N + 1, tube_degree>(centre_.state(i, k));
        }
        path.push_back(b);
        double const next =
            K > 0 ? centre_.state(i, K).norm() * power / h : centre_.state(i, 1).norm() * h;
        room.push_back(1.2 * carried[static_cast<Eigen::Index>(i)] + next + 0.1 * allowed(i));
    }
    why.reason = failure_reason::minimum_step;
    why.help = advice::smaller_box;
    for (int round = 0; round < 3; ++round) {
        tube_box_.clear();
        for (std::size_t i = 0; i < n; ++i) tube_box_.push_back(widened(path[i], room[i]));
        tube_.expand(from, times, tube_box_, K + 1);
        if (tube_.undefined()) {
            why.reason = failure_reason::undefined;
            return false;
        }
        if (tube_.kinked()) {
            smooth_ = false;
            return false;
        }
        // Without series terms x(h) = x(0) + h f(b) holds for every member, jumps or not. With them no
        // sign varies here (it would be a kink), and V carries the members as usual.
        jumps_ = tube_.jumped() && K == 0;
        lagrange_.clear();
        std::vector<double> truncation;
        double ratio = 0;
        for (std::size_t i = 0; i < n; ++i) {
            lagrange_.push_back(tube_.state(i, K + 1));
            truncation.push_back(lagrange_.back().norm() * power * up);
            double const rough = lagrange_.back().spread() + lagrange_.back().r;
            double const share = rough * power / (smooth_ ? 10 * allowed(i) : 1e4 * allowed(i));
            if (!(share <= ratio)) {
                ratio = share;
                why.component = i;
            }
        }
        bool const shortest = h <= 4 * options_.minimum_step || (!smooth_ && h <= 1e-4);
        if (!(ratio <= 1) && !shortest) {
            shorten =
                std::isfinite(ratio)
                    ? std::clamp(0.9 * std::pow(ratio, -1.0 / static_cast<double>(K + 1)), 0.3, 0.9)
                    : 0.5;
            return false;
        }
        Eigen::MatrixXd last =
            Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
        Eigen::MatrixXd w = last;
        Eigen::VectorXd spread = reach;
        if (!jumps_) {
            tube_.expand_with_variations(from, times, tube_box_, L);
            if (tube_.undefined() || (L > 1 && tube_.kinked())) {
                smooth_ = smooth_ && !tube_.kinked();
                return false;
            }
            for (std::size_t i = 0; i < n; ++i) {
                for (std::size_t c = 0; c < n; ++c) {
                    if (!flow_->sensitive(i, c)) continue;
                    last(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c)) =
                        tube_.variation(i, c, L).norm() * flow_power * up;
                }
            }
            if (!bound_flow(h, last, w)) {
                shorten = 0.5;
                return false;
            }
            auto const one = Eigen::MatrixXd::Identity(w.rows(), w.cols());
            spread = (carried + last * ((one + w) * reach)) * up;
        }
        bool proved = true;
        for (std::size_t i = 0; i < n; ++i) {
            double const image = (truncation[i] + spread[static_cast<Eigen::Index>(i)]) * up;
            if (image < room[i]) continue;
            proved = false;
            why.component = i;
            room[i] = 1.3 * image;
        }
        if (!std::all_of(room.begin(), room.end(), [](double x) { return std::isfinite(x); })) {
            return false;
        }
        if (!proved) continue;
        // The order of V follows the size of its Lagrange term.
        double const tail = last.lpNorm<Eigen::Infinity>();
        auto const used = flow_order_;
        accept(to, length, w);
        if (smooth_) {
            if (tail > 1e-3) flow_order_ = std::min(used + 1, options_.order);
            if (tail < 1e-6 && used > 2) flow_order_ = used - 1;
            adapt_order(h, to >= flow_->next_knot(from) || h >= options_.maximum_step);
        }
        return true;
    }
    shorten = 0.7;
    return false;
}

template <std::size_t N, std::size_t D>
void parametric_flow<N, D>::accept(double to, interval const& h, Eigen::MatrixXd const& w) {
    using traits = interval_traits<interval>;
    auto const n = flow_->states();
    std::size_t const K = order_;
    std::size_t const L = flow_order_;
    bool never = false;
    auto const centre_power = traits::pown(h, static_cast<int>(K + 1), never);
    auto const flow_power = traits::pown(h, static_cast<int>(L), never);
    std::vector<double> lost(n);
    std::vector<polynomial> next(n);
    for (std::size_t i = 0; i < n; ++i) {
        auto p = scaled(without_last_variable<N, D>(lagrange_[i]), centre_power);
        auto sum = centre_.state(i, K);
        for (std::size_t k = K; k-- > 0;) sum = scaled(sum, h) + centre_.state(i, k);
        p = p + sum;
        lost[i] = p.r;
        p.r = 0;
        next[i] = p;
    }
    if (!jumps_ && !set_.columns.empty()) {
        std::vector<column_entry> j(n * n);
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t c = 0; c < n; ++c) {
                if (!flow_->sensitive(i, c)) continue;
                auto last = without_last_variable<N, column_degree>(tube_.variation(i, c, L));
                double spread = 0; // |J_L(b)| W
                for (std::size_t l = 0; l < n; ++l) {
                    if (!flow_->sensitive(i, l)) continue;
                    spread += tube_.variation(i, l, L).norm() *
                              w(static_cast<Eigen::Index>(l), static_cast<Eigen::Index>(c));
                }
                last = scaled(widened(last, spread * up), flow_power);
                auto sum = derivative_.variation(i, c, L - 1);
                for (std::size_t k = L - 1; k-- > 0;) {
                    sum = scaled(sum, h) + derivative_.variation(i, c, k);
                }
                j[i * n + c] = last + sum;
            }
        }
        for (auto& g : set_.columns) {
            typename set_type::column image(n);
            for (std::size_t i = 0; i < n; ++i) {
                product_sum<N, column_degree> sum;
                for (std::size_t l = 0; l < n; ++l) {
                    if (flow_->sensitive(i, l) && g[l].norm() != 0) sum.add(j[i * n + l], g[l]);
                }
                image[i] = sum.result();
                lost[i] += image[i].r;
                image[i].r = 0;
            }
            g = std::move(image);
        }
    }
    for (auto& x : lost) x *= up;
    set_.time = to;
    swept_ = tube_box_;
    set_.centre = std::move(next);
    set_.append(lost);
    set_.reduce(10 * n);
    set_.measure();
}

} // namespace sivid

#endif
