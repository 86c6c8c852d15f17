// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_FIT_DETAIL_INTERIOR_POINTS_HPP
#define SIVID_APPROXIMATE_FIT_DETAIL_INTERIOR_POINTS_HPP

#include <sivid/approximate/fit/detail/descent.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace sivid {

/// Solves the linear programme of a Chebyshev step d,
///   min t,  |r + J d| <= t over the residuals that count,  low <= d <= high,
/// by a primal-dual interior point method, whose normal equations are arrow-shaped. Its multipliers
/// belong to r + J d <= t (plus), -(r + J d) <= t (minus), low <= d (below) and d <= high (above).
class interior_points {
    using vectors = std::vector<Eigen::VectorXd>; // by experiment

public:
    /// Starts strictly inside.
    /// @param c     linearised at `here`
    /// @param kept  weights of the residuals: those above 0 count
    interior_points(approximate_campaign& c, descent_point const& here, residual_lists const& kept,
                    arrow_vector const& low, arrow_vector const& high)
        : campaign_(&c), kept_(&kept), low_(&low), high_(&high) {
        free_ = arrow_vector::like(low, 0);
        free_.for_each([](double& f, double lo, double hi) { f = hi - lo > 1e-300 ? 1 : 0; }, low,
                       high);
        step_ = arrow_vector::like(low, 0);
        step_.for_each(
            [](double& s, double lo, double hi) {
                s = std::clamp(0.0, lo + 0.01 * (hi - lo), hi - 0.01 * (hi - lo));
            },
            low, high);
        linear_residuals(here);
        std::size_t rows = 0;
        for (std::size_t e = 0; e < lines_.size(); ++e) {
            for (Eigen::Index k = 0; k < lines_[e].size(); ++k) {
                if (!counts(e, k)) continue;
                t_ = std::max(t_, std::abs(lines_[e][k]));
                ++rows;
            }
        }
        t_ = 1.1 * t_ + 1e-12;
        start_multipliers(rows);
        constraints_ = 2 * static_cast<double>(rows) + 2 * static_cast<double>(step_.size());
    }

    /// @param share  of t, at which the duality gap ends the search
    /// @returns the optimum t, nearly
    [[nodiscard]] double operator()(double share, arrow_vector& step) {
        for (int round = 0; round < 40 && !campaign_->cancelled(); ++round) {
            double const gap = duality_gap();
            if (gap < share * t_ || !std::isfinite(gap)) break;
            double const mu = 0.15 * gap / constraints_;
            direction to;
            if (!find_step(mu, to)) break;
            find_multipliers(mu, to);
            find_box_multipliers(mu, to);
            follow(to);
        }
        step = step_;
        return t_;
    }

private:
    /// Where all unknowns go, and how far they may: to just before a boundary.
    struct direction {
        double t = 0;
        arrow_vector step;
        vectors lines; ///< J d
        vectors plus, minus;
        arrow_vector below, above;
        double primal = 1, dual = 1;
    };

    [[nodiscard]] bool counts(std::size_t e, Eigen::Index k) const {
        return (*kept_)[e][static_cast<std::size_t>(k)] > 0;
    }
    static void shorten(double& length, double value, double change) {
        if (change < 0) length = std::min(length, -0.99 * value / change);
    }

    void linear_residuals(descent_point const& here) {
        lines_.resize(here.residuals.size());
        for (std::size_t e = 0; e < lines_.size(); ++e) {
            auto const& r = here.residuals[e];
            lines_[e] =
                Eigen::Map<Eigen::VectorXd const>(r.data(), static_cast<Eigen::Index>(r.size()));
            lines_[e] += campaign_->derivatives(e) * own_part(e, step_);
        }
    }
    /// The variables on which an experiment's residuals depend.
    [[nodiscard]] static Eigen::VectorXd own_part(std::size_t e, arrow_vector const& d) {
        Eigen::VectorXd own(d.global.size() + d.local[e].size());
        own << d.global, d.local[e];
        return own;
    }
    void start_multipliers(std::size_t rows) {
        double const even = 1 / (2 * static_cast<double>(std::max<std::size_t>(rows, 1)));
        for (auto const& l : lines_) {
            plus_.emplace_back(Eigen::VectorXd::Constant(l.size(), even));
            minus_.push_back(plus_.back());
        }
        below_ = above_ = arrow_vector::like(step_, 1);
        below_.for_each(
            [&](double& b, double s, double lo) { b = even * t_ / std::max(s - lo, 1e-300); },
            step_, *low_);
        above_.for_each(
            [&](double& b, double s, double hi) { b = even * t_ / std::max(hi - s, 1e-300); },
            step_, *high_);
    }

    /// The sum of multiplier times slack.
    [[nodiscard]] double duality_gap() {
        double gap = 0;
        for (std::size_t e = 0; e < lines_.size(); ++e) {
            for (Eigen::Index k = 0; k < lines_[e].size(); ++k) {
                if (!counts(e, k)) continue;
                gap += plus_[e][k] * (t_ - lines_[e][k]) + minus_[e][k] * (t_ + lines_[e][k]);
            }
        }
        below_.for_each([&](double b, double s, double lo, double f) { gap += f * b * (s - lo); },
                        step_, *low_, free_);
        above_.for_each([&](double b, double s, double hi, double f) { gap += f * b * (hi - s); },
                        step_, *high_, free_);
        return gap;
    }

    /// By the normal equations over (t, globals, locals), multipliers eliminated.
    /// @returns false when a pivot is not positive
    [[nodiscard]] bool find_step(double mu, direction& to) {
        auto const g = step_.global.size();
        system_.reset(1 + g, campaign_->local_sizes());
        for (std::size_t e = 0; e < lines_.size(); ++e) add_residuals(e, mu);
        system_.side(0)[0] -= 1;
        add_box(mu);
        arrow_vector move;
        if (!system_.solve(0, held(), move)) return false;
        to.t = move.global[0];
        to.step.global = move.global.tail(g);
        to.step.local = move.local;
        return true;
    }
    void add_residuals(std::size_t e, double mu) {
        auto const j = campaign_->derivatives(e);
        auto const n = j.cols();
        Eigen::VectorXd root(j.rows());
        Eigen::VectorXd skew(j.rows());
        Eigen::VectorXd force(j.rows());
        double weight = 0;
        double push = 0;
        for (Eigen::Index k = 0; k < j.rows(); ++k) {
            root[k] = skew[k] = force[k] = 0;
            if (!counts(e, k)) continue;
            double const s1 = t_ - lines_[e][k];
            double const s2 = t_ + lines_[e][k];
            double const d1 = plus_[e][k] / s1;
            double const d2 = minus_[e][k] / s2;
            root[k] = std::sqrt(d1 + d2);
            skew[k] = d2 - d1;
            force[k] = mu / s2 - mu / s1;
            weight += d1 + d2;
            push += mu / s1 + mu / s2;
        }
        auto& m = system_.matrix(e);
        campaign_->add_gram(e, root, m.bottomRightCorner(n, n));
        m.col(0).tail(n) += j.transpose() * skew;
        m(0, 0) += weight;
        system_.side(e).tail(n) += j.transpose() * force;
        system_.side(e)[0] += push;
    }
    void add_box(double mu) {
        auto stiff = step_;
        auto force = step_;
        stiff.for_each([](double& v, double lo, double hi, double b, double a,
                          double f) { v = f == 0 ? 0 : b / (v - lo) + a / (hi - v); },
                       *low_, *high_, below_, above_, free_);
        force.for_each([mu](double& v, double lo, double hi,
                            double f) { v = f == 0 ? 0 : mu / (v - lo) - mu / (hi - v); },
                       *low_, *high_, free_);
        auto const g = step_.global.size();
        system_.matrix(0).diagonal().segment(1, g) += stiff.global;
        system_.side(0).segment(1, g) += force.global;
        for (std::size_t e = 0; e < step_.local.size(); ++e) {
            auto const l = step_.local[e].size();
            system_.matrix(e).diagonal().tail(l) += stiff.local[e];
            system_.side(e).tail(l) += force.local[e];
        }
    }
    /// The unknowns of the normal equations that have no room.
    [[nodiscard]] arrow_vector held() const {
        arrow_vector held;
        held.global.resize(free_.global.size() + 1);
        held.global[0] = 0;
        held.global.tail(free_.global.size()) = 1 - free_.global.array();
        for (auto const& l : free_.local) held.local.emplace_back((1 - l.array()).matrix());
        return held;
    }

    /// Each multiplier goes where its product with its slack, moved to first order, is mu.
    void find_multipliers(double mu, direction& to) const {
        to.plus = plus_;
        to.minus = minus_;
        for (std::size_t e = 0; e < lines_.size(); ++e) {
            auto const j = campaign_->derivatives(e);
            auto const& slopes = to.lines.emplace_back(j * own_part(e, to.step));
            for (Eigen::Index k = 0; k < lines_[e].size(); ++k) {
                if (!counts(e, k)) continue;
                double const s1 = t_ - lines_[e][k];
                double const s2 = t_ + lines_[e][k];
                double const ds1 = to.t - slopes[k];
                double const ds2 = to.t + slopes[k];
                to.plus[e][k] = (mu - plus_[e][k] * ds1) / s1 - plus_[e][k];
                to.minus[e][k] = (mu - minus_[e][k] * ds2) / s2 - minus_[e][k];
                shorten(to.primal, s1, ds1);
                shorten(to.primal, s2, ds2);
                shorten(to.dual, plus_[e][k], to.plus[e][k]);
                shorten(to.dual, minus_[e][k], to.minus[e][k]);
            }
        }
    }
    void find_box_multipliers(double mu, direction& to) const {
        to.below = below_;
        to.above = above_;
        to.below.for_each(
            [&](double& b, double s, double lo, double v, double f) {
                if (f == 0) return void(b = 0);
                double const own = b;
                b = (mu - own * v) / (s - lo) - own;
                shorten(to.primal, s - lo, v);
                shorten(to.dual, own, b);
            },
            step_, *low_, to.step, free_);
        to.above.for_each(
            [&](double& b, double s, double hi, double v, double f) {
                if (f == 0) return void(b = 0);
                double const own = b;
                b = (mu + own * v) / (hi - s) - own;
                shorten(to.primal, hi - s, -v);
                shorten(to.dual, own, b);
            },
            step_, *high_, to.step, free_);
    }

    void follow(direction const& to) {
        double const primal = to.primal, dual = to.dual;
        step_.for_each([&](double& s, double v, double f) { s += f * primal * v; }, to.step, free_);
        t_ += primal * to.t;
        for (std::size_t e = 0; e < lines_.size(); ++e) {
            lines_[e] += primal * to.lines[e];
            plus_[e] += dual * to.plus[e];
            minus_[e] += dual * to.minus[e];
        }
        below_.for_each([&](double& b, double v) { b += dual * v; }, to.below);
        above_.for_each([&](double& b, double v) { b += dual * v; }, to.above);
    }

    approximate_campaign* campaign_;
    residual_lists const* kept_;
    arrow_vector const* low_;
    arrow_vector const* high_;
    double t_ = 0;
    double constraints_ = 0; ///< how many, of bounds as of residuals
    arrow_vector step_;      ///< d
    arrow_vector free_;      ///< 1, or 0 where the bounds leave no room
    vectors lines_;          ///< r + J d
    vectors plus_, minus_;
    arrow_vector below_, above_;
    arrow_system system_;
};

} // namespace sivid

#endif
