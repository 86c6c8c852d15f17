// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_FIT_DETAIL_DESCENT_HPP
#define SIVID_APPROXIMATE_FIT_DETAIL_DESCENT_HPP

#include <sivid/approximate/approximate_fit.hpp>
#include <sivid/approximate/fit/detail/approximate_campaign.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace sivid {

/// Where a descent stands.
struct descent_point {
    arrow_vector at;
    residual_lists residuals;
    double inflation = std::numeric_limits<double>::infinity();
};

/// A quadratic term on the experiments' own variables: z' R z, R lower triangle.
using regularisation = std::vector<Eigen::MatrixXd>;

struct descent_options {
    int rounds = 20;
    double enough = 1e-4; ///< ends when a round gains a smaller share of the cost
};

/// Minimises sum w |r|^p (+ z' R z) over the box of the variables by damped Gauss-Newton steps.
class descent {
public:
    explicit descent(approximate_campaign& c, regularisation smooth = {})
        : campaign_(&c), smooth_(std::move(smooth)) {}

    [[nodiscard]] bool evaluate(arrow_vector z, descent_point& point) {
        clamp(z);
        if (!campaign_->residuals(z, point.residuals)) return false;
        point.at = std::move(z);
        point.inflation = inflation_of(point.residuals, campaign_->outliers());
        return true;
    }

    /// @param kept  per measurement: its weight; empty when the largest of each experiment that the
    ///              outlier budgets allow are left out, chosen anew in each round
    /// @param best  takes over every better point by its inflation
    void run(descent_point& here, double power, residual_lists const& kept, descent_options options,
             descent_point* best = nullptr) {
        double damping = power > 2 ? 1e-4 : 1e-3;
        balance_ = balance(here, kept, power);
        for (int round = 0; round < options.rounds; ++round) {
            auto const weight =
                kept.empty() ? kept_of(here.residuals, campaign_->outliers()) : kept;
            double const scale = std::max(largest(here.residuals, weight), 1e-12);
            double const before = cost(here, weight, power, scale);
            residual_lists r;
            if (!campaign_->linearise(here.at, r)) return;
            assemble(here, weight, power, scale);
            auto const held = held_at_bounds(here.at);
            bool improved = false;
            double after = before;
            for (int attempt = 0; attempt < 7 && !improved && !campaign_->cancelled();
                 ++attempt, damping *= 8) {
                arrow_vector step;
                if (!system_.solve(damping, held, step)) continue;
                auto z = here.at;
                z.for_each([](double& v, double s) { v -= s; }, step);
                descent_point trial;
                if (!evaluate(std::move(z), trial)) continue;
                after = cost(trial, weight, power, scale);
                if (!(after < before)) continue;
                improved = true;
                here = std::move(trial);
                if (best != nullptr && here.inflation < best->inflation) *best = here;
                damping = std::max(damping / 100, 1e-12);
            }
            if (!improved || before - after < options.enough * before) return;
        }
    }
    /// The linear system of the last round; for variances.
    [[nodiscard]] arrow_system& system() { return system_; }
    /// Assembles the unweighted normal equations at a point.
    [[nodiscard]] bool assemble_plain(descent_point const& here, residual_lists const& weight) {
        residual_lists r;
        if (!campaign_->linearise(here.at, r)) return false;
        balance_ = 1;
        assemble(here, weight, 2, 1);
        return true;
    }

    void clamp(arrow_vector& z) const {
        z.for_each([](double& v, double lo, double hi) { v = std::min(std::max(v, lo), hi); },
                   campaign_->lower(), campaign_->upper());
    }

private:
    [[nodiscard]] static double largest(residual_lists const& r, residual_lists const& weight) {
        double result = 0;
        for (std::size_t e = 0; e < r.size(); ++e) {
            for (std::size_t k = 0; k < r[e].size(); ++k) {
                if (weight[e][k] > 0) result = std::max(result, std::abs(r[e][k]));
            }
        }
        return result;
    }
    /// Keeps the regularisation as strong, beside higher powers, as it is beside squares.
    [[nodiscard]] double balance(descent_point const& here, residual_lists const& kept,
                                 double power) const {
        if (smooth_.empty() || power == 2) return 1;
        auto const weight = kept.empty() ? kept_of(here.residuals, campaign_->outliers()) : kept;
        double const scale = std::max(largest(here.residuals, weight), 1e-12);
        double squares = 1e-12;
        double powers = 0;
        for (std::size_t e = 0; e < weight.size(); ++e) {
            for (std::size_t k = 0; k < weight[e].size(); ++k) {
                double const size = std::abs(here.residuals[e][k]) / scale;
                squares += weight[e][k] * size * size;
                powers += weight[e][k] * std::pow(size, power);
            }
        }
        return powers / squares;
    }
    [[nodiscard]] double smoothness(std::size_t e, arrow_vector const& z) const {
        if (smooth_.empty() || z.local[e].size() == 0) return 0;
        return z.local[e].dot(smooth_[e].selfadjointView<Eigen::Lower>() * z.local[e]);
    }
    /// In units of scale^2, so that powers can be compared with the regularisation.
    [[nodiscard]] double cost(descent_point const& here, residual_lists const& weight, double power,
                              double scale) const {
        double sum = 0;
        for (std::size_t e = 0; e < here.residuals.size(); ++e) {
            for (std::size_t k = 0; k < here.residuals[e].size(); ++k) {
                if (!(weight[e][k] > 0)) continue;
                double const size = std::abs(here.residuals[e][k]) / scale;
                sum += weight[e][k] * (power == 2 ? size * size : std::pow(size, power));
            }
            sum += balance_ * smoothness(e, here.at) / (scale * scale);
        }
        return sum;
    }
    /// Newton's matrix of the p-norm with r linear: p (p - 1) |r|^(p-2); p |r|^(p-2) below p = 2.
    void assemble(descent_point const& here, residual_lists const& weight, double power,
                  double scale) {
        auto const g = campaign_->lower().global.size();
        system_.reset(g, campaign_->local_sizes());
        double const curvature = power > 2 ? power - 1 : 1;
        for (std::size_t e = 0; e < here.residuals.size(); ++e) {
            auto const& r = here.residuals[e];
            auto const j = campaign_->derivatives(e);
            Eigen::VectorXd root(j.rows());
            Eigen::VectorXd force(j.rows());
            for (Eigen::Index k = 0; k < j.rows(); ++k) {
                auto const i = static_cast<std::size_t>(k);
                double const size = std::max(std::abs(r[i]) / scale, 1e-3);
                double const w = weight[e][i] * 0.5 * power *
                                 (power == 2 ? 1 : std::pow(size, power - 2)) / (scale * scale);
                root[k] = std::sqrt(w * curvature);
                force[k] = w * r[i];
            }
            auto& n = system_.matrix(e);
            campaign_->add_gram(e, root, n);
            system_.side(e) = j.transpose() * force;
            if (smooth_.empty()) continue;
            auto const l = n.rows() - g;
            if (l == 0) continue; // Eigen takes the address of the first entry
            double const share = balance_ / (scale * scale);
            n.bottomRightCorner(l, l).triangularView<Eigen::Lower>() += share * smooth_[e];
            system_.side(e).tail(l) +=
                share * (smooth_[e].selfadjointView<Eigen::Lower>() * here.at.local[e]);
        }
    }
    /// Variables at a bound that the descent would push outward.
    [[nodiscard]] arrow_vector held_at_bounds(arrow_vector const& z) {
        auto slope = arrow_vector::like(z, 0);
        auto const g = z.global.size();
        for (std::size_t e = 0; e < system_.experiments(); ++e) {
            slope.global += system_.side(e).head(g);
            slope.local[e] = system_.side(e).tail(slope.local[e].size());
        }
        slope.for_each([](double& s, double v, double lo,
                          double hi) { s = (v <= lo && s > 0) || (v >= hi && s < 0) ? 1 : 0; },
                       z, campaign_->lower(), campaign_->upper());
        return slope;
    }

    approximate_campaign* campaign_;
    regularisation smooth_;
    double balance_ = 1;
    arrow_system system_;
};

/// Share of the descents' tolerances with which their results are simulated.
inline constexpr double judged_accuracy = 1e-3;

/// What a descent came to, by its own simulation; only infinite figures where it came to nothing.
[[nodiscard]] inline approximate_fit as_descended(approximate_campaign const& c,
                                                  descent_point here) {
    approximate_fit result;
    if (!std::isfinite(here.inflation)) return result;
    result.inflation = inflation_of(here.residuals, c.outliers());
    result.parameters = c.parameters(here.at);
    for (std::size_t e = 0; e < c.experiments(); ++e) {
        result.starts.push_back(c.start(e, here.at));
    }
    result.residuals = std::move(here.residuals);
    return result;
}

/// The same, simulated once more with care.
[[nodiscard]] inline approximate_fit fit_at(approximate_campaign& c, descent_point here) {
    if (!std::isfinite(here.inflation)) return {};
    c.set_accuracy(judged_accuracy);
    residual_lists fine;
    if (c.residuals(here.at, fine)) here.residuals = std::move(fine);
    c.set_accuracy(1);
    return as_descended(c, std::move(here));
}

} // namespace sivid

#endif
