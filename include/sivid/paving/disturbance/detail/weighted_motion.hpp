// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_DISTURBANCE_DETAIL_WEIGHTED_MOTION_HPP
#define SIVID_PAVING_DISTURBANCE_DETAIL_WEIGHTED_MOTION_HPP

#include <sivid/model/disturbance.hpp>
#include <sivid/number/interval_traits.hpp>
#include <sivid/paving/disturbance/detail/disturbed_motion.hpp>
#include <sivid/paving/disturbance/detail/plain_motion.hpp>
#include <sivid/space/box.hpp>
#include <sivid/work_clock.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace sivid::paving_detail {

/// What weighted measurements prove of the size of disturbances.
struct weighted_bound {
    double lower = 0;              ///< proved: no smaller size explains the measurements
    std::vector<double> influence; ///< per parameter: how much its width moves, an estimate
};

/// Bounds the size of disturbances from below by a weighted sum of measurements. With any weights
/// a(t) of the states, along straight lines in each cell, integration by parts of a z says
///   \f[ \sum_k (a_k^- - a_k^+) z_k - \sum_c \int (a' + J^T a) z + a F \pi + a c + a r \, dt
///       = \int a \, d \, dt , \f]
/// an identity for every motion with its own J, F in the ranges of the cells: nothing is left out.
/// Jumps at measurements are \f$ \lambda_i H_i \f$, so that the first sum is \f$ \sum_i \lambda_i
/// (y_i - g_i - G_i \pi) \f$ up to what the ranges leave open. The right side is at most
/// \f$ W (\sum_q s_q \int |a_q| + \sum_i |\lambda_i| s_i) \f$.
///   Weights backward by the middles of J make a' + J^T a small; any others prove, too.
/// @param parameters  the box for which the motions are
/// @guarantee  for every parameter of it no disturbances below `lower` explain the measurements, if
///             the motions are for a size of at least `lower`
/// @cost  O(cells n (n + parameters))
class weighted_motion {
    using traits = interval_traits<interval>;

public:
    weighted_motion(disturbance_set const& set, box const& parameters)
        : set_(&set), sums_(parameters.size(), traits::point(0.0)) {
        bound_.influence.assign(parameters.size(), 0.0);
        for (auto const& p : parameters) away_.push_back(traits::sub(p, traits::point(mid(p))));
    }

    /// @returns  the node before which nothing counts: where no measurement is weighted before it
    ///           and the weights of the states have nearly died away
    std::size_t add(disturbed_motion const& motion, plain_motion const& plain,
                    std::vector<double> const& weights) {
        auto const n = static_cast<Eigen::Index>(motion.beside.front().size());
        std::vector<std::size_t> order;
        for (std::size_t i = 0; i < weights.size(); ++i)
            if (weights[i] != 0) order.push_back(i);
        if (order.empty()) return 0;
        work_clock::count(motion.cells.size() * static_cast<std::size_t>(n * (2 * n + 4)),
                          work_clock::interval);
        Eigen::VectorXd after = Eigen::VectorXd::Zero(n); // behind the node
        auto next = order.size();
        for (auto k = motion.samples[order.back()].node + 1; k-- > 0;) {
            Eigen::VectorXd before = after;
            std::vector<interval> jump(static_cast<std::size_t>(n), traits::point(0.0));
            while (next > 0 && motion.samples[order[next - 1]].node == k) {
                auto const i = order[--next];
                add_sample(motion.samples[i], weights[i], before, jump);
            }
            bool const first =
                k == 0 || (next == 0 && charge(before, motion.beside[k]) < 1e-3 * mig(left_));
            if (first) before.setZero();
            for (Eigen::Index j = 0; j < n; ++j) {
                auto const i = static_cast<std::size_t>(j);
                auto const step = traits::sub(traits::point(before[j]), traits::point(after[j]));
                left_ = traits::add(left_,
                                    traits::mul(traits::sub(step, jump[i]), motion.beside[k][i]));
            }
            if (first) return k;
            Eigen::VectorXd const begin = plain.cells[k - 1].step.transpose() * before;
            add_cell(motion.cells[k - 1], begin, before);
            after = begin;
        }
        return 0;
    }
    [[nodiscard]] weighted_bound proved() {
        auto const sum = total();
        double const gap = mig(sum);
        bool undefined = false;
        if (is_empty(sum) || !(gap > 0)) return bound_;
        bound_.lower =
            most_ > 0 ? traits::div(traits::point(gap), traits::point(most_), undefined).lower()
                      : detail::infinity;
        if (!(bound_.lower > 0)) bound_.lower = 0;
        return bound_;
    }

private:
    [[nodiscard]] static double charge(Eigen::VectorXd const& a, box const& z) {
        double sum = 0;
        for (Eigen::Index j = 0; j < a.size(); ++j)
            if (a[j] != 0) sum += std::abs(a[j]) * mag(z[static_cast<std::size_t>(j)]);
        return sum;
    }
    [[nodiscard]] interval total() const {
        auto sum = left_;
        for (std::size_t j = 0; j < away_.size(); ++j)
            sum = traits::sub(sum, traits::mul(sums_[j], away_[j]));
        return sum;
    }
    void add_sample(disturbed_sample const& s, double weight, Eigen::VectorXd& before,
                    std::vector<interval>& jump) {
        auto const w = traits::point(weight);
        left_ = traits::add(left_, traits::mul(w, s.rest));
        for (std::size_t j = 0; j < sums_.size(); ++j)
            sums_[j] = traits::add(sums_[j], traits::mul(w, s.by_parameter[j]));
        for (std::size_t i = 0; i < jump.size(); ++i) {
            jump[i] = traits::add(jump[i], traits::mul(w, s.by_state[i]));
            before[static_cast<Eigen::Index>(i)] += weight * mid(s.by_state[i]);
        }
        for (auto const& q : set_->channels)
            if (q.index == s.channel)
                most_ = detail::add_up(most_, detail::mul_up(std::abs(weight), q.scale));
    }
    /// @param a, b  the weights at the begin and the end of the cell
    void add_cell(disturbed_cell const& c, Eigen::VectorXd const& a, Eigen::VectorXd const& b) {
        auto const n = c.defect.size();
        auto const at = [](double v) { return traits::point(v); };
        auto const half = traits::mul(at(0.5), c.length);
        std::vector<interval> mean, turn;
        bool undefined = false;
        for (std::size_t i = 0; i < n; ++i) {
            auto const k = static_cast<Eigen::Index>(i);
            mean.push_back(traits::mul(half, traits::add(at(a[k]), at(b[k])))); // int a
            auto const rise = traits::sub(at(b[k]), at(a[k]));
            turn.push_back(traits::div(rise, c.length, undefined)); // a'
            double const apart =
                traits::mul(traits::mul(at(0.5), half), traits::mul(at(mag(rise)), at(c.swing[i])))
                    .upper();
            left_ = traits::sub(left_, traits::add(traits::mul(mean[i], c.defect[i]),
                                                   traits::bounds(-apart, apart)));
            auto const sizes = traits::add(at(std::abs(a[k])), at(std::abs(b[k])));
            auto const most = traits::mul(half, sizes); // of int |a|
            auto const rough = traits::mul(traits::hull(most, traits::neg(most)), c.rough[i]);
            left_ = traits::sub(left_, rough);
            for (auto const& q : set_->equations)
                if (q.index == i)
                    most_ = detail::add_up(most_, traits::mul(most, at(q.scale)).upper());
        }
        for (std::size_t j = 0; j < sums_.size(); ++j) {
            for (std::size_t i = 0; i < n; ++i) {
                auto const& slope = c.by_parameter[i * sums_.size() + j];
                if (slope.lower() == 0 && slope.upper() == 0) continue;
                auto const part = weighed(slope, a[static_cast<Eigen::Index>(i)],
                                          b[static_cast<Eigen::Index>(i)], half);
                sums_[j] = traits::add(sums_[j], part);
                bound_.influence[j] += mag(part) * mag(away_[j]);
            }
        }
        for (std::size_t j = 0; j < n; ++j) add_turn(c, j, a, b, turn[j], half);
    }
    /// \f$ \int a F \f$ for an F(t) in a range, a along a line: F at the ends of it.
    [[nodiscard]] static interval weighed(interval const& range, double a, double b,
                                          interval const& half) {
        auto const ends =
            traits::add(traits::mul(range, traits::point(a)), traits::mul(range, traits::point(b)));
        return traits::mul(half, ends);
    }
    /// What \f$ \int (a' + J^T a)_j z_j \f$ is at most: along the line its size is at most that of
    /// the line between its sizes at the ends.
    void add_turn(disturbed_cell const& c, std::size_t j, Eigen::VectorXd const& a,
                  Eigen::VectorXd const& b, interval const& turn, interval const& half) {
        auto const n = c.defect.size();
        auto first = turn, last = turn;
        for (std::size_t i = 0; i < n; ++i) {
            auto const& slope = c.by_state[i * n + j];
            auto const k = static_cast<Eigen::Index>(i);
            first = traits::add(first, traits::mul(slope, traits::point(a[k])));
            last = traits::add(last, traits::mul(slope, traits::point(b[k])));
        }
        auto const sizes = traits::add(traits::point(mag(first)), traits::point(mag(last)));
        if (sizes.upper() == 0) return;
        auto const z = is_bounded(c.beside[j]) ? traits::point(mag(c.beside[j])) : traits::entire();
        double const most = traits::mul(traits::mul(half, sizes), z).upper();
        left_ = traits::add(left_,
                            std::isfinite(most) ? traits::bounds(-most, most) : traits::entire());
    }

    disturbance_set const* set_;
    std::vector<interval> away_, sums_; ///< of parameters: from the middle; \f$ \int a F + ... \f$
    interval left_{0.0};                ///< the left side without parameters
    double most_ = 0;                   ///< of the right side for W = 1
    weighted_bound bound_;
};

} // namespace sivid::paving_detail

#endif
