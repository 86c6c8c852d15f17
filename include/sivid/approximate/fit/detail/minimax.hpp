// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_FIT_DETAIL_MINIMAX_HPP
#define SIVID_APPROXIMATE_FIT_DETAIL_MINIMAX_HPP

#include <sivid/approximate/fit/detail/descent.hpp>
#include <sivid/space/linear_program/minimax_lp.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace sivid {

/// How far and how sharply Chebyshev steps go on.
struct minimax_options {
    int rounds = 10;
    double radius = 0.1;      ///< of the first trust region
    double least = 1e-4;      ///< share of the inflation that a step has to promise
    double enough = 2e-3;     ///< ends when a round gains a smaller share
    double reached = 0;       ///< ends at this inflation
    int attempts = 4;         ///< at ever smaller steps
    double gap = 5e-4;        ///< of interior points
    bool to_vertices = false; ///< solve the programmes of few variables to a vertex
    /// As far as doubles go: to the kink where a least inflation lies.
    [[nodiscard]] static minimax_options sharp() { return {60, 0.25, 1e-5, 0, 0, 15, 1e-6, true}; }
};

/// Minimises the inflation itself: Chebyshev steps of the linearised residuals within a trust
/// region, each a linear programme
///   min t,  |r + J d| <= t over the residuals that count,  low <= d <= high.
/// Nearly solved by a primal-dual interior point method on the arrow-shaped normal equations, which
/// many variables (places that may be wrong) allow, and whose points away from kinks make good
/// steps far from a minimum; or, near one, by exchanges to the kink where the least t lies.
class minimax {
public:
    explicit minimax(approximate_campaign& c) : campaign_(&c), descent_(c) {}

    /// @param unit  per variable: the radius of a trust region of size 1
    void run(descent_point& here, arrow_vector const& unit, minimax_options const& options = {}) {
        double radius = options.radius;
        gap_ = options.gap;
        to_vertices_ = options.to_vertices;
        for (int round = 0; round < options.rounds && here.inflation > options.reached; ++round) {
            residual_lists r;
            if (campaign_->cancelled() || !campaign_->linearise(here.at, r)) return;
            auto const kept = kept_of(here.residuals, campaign_->outliers());
            double const before = here.inflation;
            for (int attempt = 0; attempt < options.attempts; ++attempt) {
                arrow_vector step;
                double const predicted = solve(here, kept, unit, radius, step);
                if (!(predicted < before * (1 - options.least))) return;
                auto z = here.at;
                z.for_each([](double& v, double s) { v += s; }, step);
                descent_point trial;
                bool const possible = descent_.evaluate(std::move(z), trial);
                double const hoped = before - predicted;
                double const gained = possible ? before - trial.inflation : -hoped;
                radius *= gained > 0.75 * hoped ? 2 : gained > 0.25 * hoped ? 1 : 0.25;
                if (!(gained > 0)) continue;
                here = std::move(trial);
                break;
            }
            if (!(before - here.inflation > options.enough * before)) return;
        }
    }

private:
    /// As many unknowns as exchanges are quick for.
    static constexpr std::size_t few = 64;

    /// @returns the optimum t of the linear programme, nearly
    [[nodiscard]] double solve(descent_point const& here, residual_lists const& kept,
                               arrow_vector const& unit, double radius, arrow_vector& step) {
        auto low = here.at;
        auto high = here.at;
        low.for_each([&](double& v, double lo, double u) { v = std::max(lo - v, -radius * u); },
                     campaign_->lower(), unit);
        high.for_each([&](double& v, double hi, double u) { v = std::min(hi - v, radius * u); },
                      campaign_->upper(), unit);
        step = arrow_vector::like(here.at, 0);
        return to_vertices_ && size_of(step) <= few
                   ? by_exchanges(here, kept, low, high, step)
                   : by_interior_points(here, kept, low, high, step);
    }

    [[nodiscard]] double by_exchanges(descent_point const& here, residual_lists const& kept,
                                      arrow_vector const& low, arrow_vector const& high,
                                      arrow_vector& step) {
        auto const globals = step.global.size();
        auto first = static_cast<std::size_t>(globals); // of the experiment's own unknowns
        blocks_.clear();
        for (std::size_t e = 0; e < here.residuals.size(); ++e) {
            auto const slopes = campaign_->derivatives(e);
            auto const own = step.local[e].size();
            auto& b = blocks_.emplace_back();
            b.offset = here.residuals[e];
            for (double const weight : kept[e]) {
                b.margin.push_back(weight > 0 ? 0 : std::numeric_limits<double>::infinity());
            }
            auto const add = [&](Eigen::Index column, std::size_t unknown, double from, double to) {
                b.variable.push_back(unknown);
                for (Eigen::Index y = 0; y < slopes.rows(); ++y) {
                    double const slope = slopes(y, column);
                    b.slope.push_back(slope * 0.5 * (to - from));
                    b.offset[static_cast<std::size_t>(y)] += slope * 0.5 * (from + to);
                }
            };
            for (Eigen::Index k = 0; k < globals; ++k) {
                add(k, static_cast<std::size_t>(k), low.global[k], high.global[k]);
            }
            for (Eigen::Index k = 0; k < own; ++k) {
                add(globals + k, first + static_cast<std::size_t>(k), low.local[e][k],
                    high.local[e][k]);
            }
            first += static_cast<std::size_t>(own);
        }
        auto const solved = minimax_solver(first, blocks_)();
        std::size_t k = 0;
        step.for_each([&](double& s, double lo,
                          double hi) { s = 0.5 * (lo + hi) + 0.5 * (hi - lo) * solved.point[k++]; },
                      low, high);
        return solved.value;
    }

    [[nodiscard]] double by_interior_points(descent_point const& here, residual_lists const& kept,
                                            arrow_vector const& low, arrow_vector const& high,
                                            arrow_vector& step) {
        auto const g = here.at.global.size();
        auto free = arrow_vector::like(here.at, 0);
        free.for_each([](double& f, double lo, double hi) { f = hi - lo > 1e-300 ? 1 : 0; }, low,
                      high);
        // A strictly feasible start.
        step.for_each(
            [](double& s, double lo, double hi) {
                s = std::clamp(0.0, lo + 0.01 * (hi - lo), hi - 0.01 * (hi - lo));
            },
            low, high);
        linear_residuals(here, step);
        double t = 0;
        std::size_t rows = 0;
        for (std::size_t e = 0; e < lines_.size(); ++e) {
            for (std::size_t k = 0; k < kept[e].size(); ++k) {
                if (!(kept[e][k] > 0)) continue;
                t = std::max(t, std::abs(lines_[e][static_cast<Eigen::Index>(k)]));
                ++rows;
            }
        }
        t = 1.1 * t + 1e-12;
        double const count = 2 * static_cast<double>(rows) + 2 * static_cast<double>(size_of(step));
        auto below = arrow_vector::like(step, 1);
        auto above = below;
        std::vector<Eigen::VectorXd> plus;
        std::vector<Eigen::VectorXd> minus;
        double const even = 1 / (2 * static_cast<double>(std::max<std::size_t>(rows, 1)));
        for (auto const& l : lines_) {
            plus.emplace_back(Eigen::VectorXd::Constant(l.size(), even));
            minus.push_back(plus.back());
        }
        below.for_each(
            [&](double& b, double s, double lo) { b = even * t / std::max(s - lo, 1e-300); }, step,
            low);
        above.for_each(
            [&](double& b, double s, double hi) { b = even * t / std::max(hi - s, 1e-300); }, step,
            high);
        for (int round = 0; round < 40 && !campaign_->cancelled(); ++round) {
            double gap = 0;
            for (std::size_t e = 0; e < lines_.size(); ++e) {
                for (Eigen::Index k = 0; k < lines_[e].size(); ++k) {
                    if (!(kept[e][static_cast<std::size_t>(k)] > 0)) continue;
                    gap += plus[e][k] * (t - lines_[e][k]) + minus[e][k] * (t + lines_[e][k]);
                }
            }
            auto product = below;
            product.for_each(
                [&](double& b, double s, double lo, double f) { gap += f * b * (s - lo); }, step,
                low, free);
            product = above;
            product.for_each(
                [&](double& b, double s, double hi, double f) { gap += f * b * (hi - s); }, step,
                high, free);
            if (gap < gap_ * t || !std::isfinite(gap)) break;
            double const mu = 0.15 * gap / count;
            // Normal equations over (t, globals, locals).
            std::vector<Eigen::Index> locals = campaign_->local_sizes();
            system_.reset(1 + g, locals);
            auto const held = held_of(free);
            for (std::size_t e = 0; e < lines_.size(); ++e)
                assemble(e, t, mu, kept[e], plus[e], minus[e]);
            system_.side(0)[0] -= 1;
            add_box(g, mu, step, low, high, below, above, free);
            arrow_vector move;
            if (!system_.solve(0, held, move)) break;
            double const dt = move.global[0];
            arrow_vector d = step;
            d.global = move.global.tail(g);
            d.local = move.local;
            // Steps to the boundary.
            double primal = 1;
            double dual = 1;
            auto const shorten = [](double& length, double value, double change) {
                if (change < 0) length = std::min(length, -0.99 * value / change);
            };
            std::vector<Eigen::VectorXd> dplus = plus;
            std::vector<Eigen::VectorXd> dminus = minus;
            std::vector<Eigen::VectorXd> slopes;
            for (std::size_t e = 0; e < lines_.size(); ++e) {
                auto const j = campaign_->derivatives(e);
                Eigen::VectorXd own(g + d.local[e].size());
                own << d.global, d.local[e];
                slopes.emplace_back(j * own);
                for (Eigen::Index k = 0; k < lines_[e].size(); ++k) {
                    if (!(kept[e][static_cast<std::size_t>(k)] > 0)) continue;
                    double const s1 = t - lines_[e][k];
                    double const s2 = t + lines_[e][k];
                    double const ds1 = dt - slopes[e][k];
                    double const ds2 = dt + slopes[e][k];
                    dplus[e][k] = (mu - plus[e][k] * ds1) / s1 - plus[e][k];
                    dminus[e][k] = (mu - minus[e][k] * ds2) / s2 - minus[e][k];
                    shorten(primal, s1, ds1);
                    shorten(primal, s2, ds2);
                    shorten(dual, plus[e][k], dplus[e][k]);
                    shorten(dual, minus[e][k], dminus[e][k]);
                }
            }
            auto dbelow = below;
            auto dabove = above;
            dbelow.for_each(
                [&](double& b, double s, double lo, double v, double f) {
                    if (f == 0) return void(b = 0);
                    double const own = b;
                    b = (mu - own * v) / (s - lo) - own;
                    shorten(primal, s - lo, v);
                    shorten(dual, own, b);
                },
                step, low, d, free);
            dabove.for_each(
                [&](double& b, double s, double hi, double v, double f) {
                    if (f == 0) return void(b = 0);
                    double const own = b;
                    b = (mu + own * v) / (hi - s) - own;
                    shorten(primal, hi - s, -v);
                    shorten(dual, own, b);
                },
                step, high, d, free);
            step.for_each([&](double& s, double v, double f) { s += f * primal * v; }, d, free);
            t += primal * dt;
            for (std::size_t e = 0; e < lines_.size(); ++e) {
                lines_[e] += primal * slopes[e];
                plus[e] += dual * (dplus[e]);
                minus[e] += dual * (dminus[e]);
            }
            below.for_each([&](double& b, double v) { b += dual * v; }, dbelow);
            above.for_each([&](double& b, double v) { b += dual * v; }, dabove);
        }
        return t;
    }

    void linear_residuals(descent_point const& here, arrow_vector const& step) {
        lines_.resize(here.residuals.size());
        for (std::size_t e = 0; e < lines_.size(); ++e) {
            auto const& r = here.residuals[e];
            Eigen::VectorXd own(step.global.size() + step.local[e].size());
            own << step.global, step.local[e];
            lines_[e] =
                Eigen::Map<Eigen::VectorXd const>(r.data(), static_cast<Eigen::Index>(r.size()));
            lines_[e] += campaign_->derivatives(e) * own;
        }
    }
    void assemble(std::size_t e, double t, double mu, std::vector<double> const& kept,
                  Eigen::VectorXd const& plus, Eigen::VectorXd const& minus) {
        auto const j = campaign_->derivatives(e);
        auto const n = j.cols();
        Eigen::VectorXd root(j.rows());
        Eigen::VectorXd skew(j.rows());
        Eigen::VectorXd force(j.rows());
        double weight = 0;
        double push = 0;
        for (Eigen::Index k = 0; k < j.rows(); ++k) {
            root[k] = skew[k] = force[k] = 0;
            if (!(kept[static_cast<std::size_t>(k)] > 0)) continue;
            double const s1 = t - lines_[e][k];
            double const s2 = t + lines_[e][k];
            double const d1 = plus[k] / s1;
            double const d2 = minus[k] / s2;
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
    void add_box(Eigen::Index g, double mu, arrow_vector const& step, arrow_vector const& low,
                 arrow_vector const& high, arrow_vector const& below, arrow_vector const& above,
                 arrow_vector const& free) {
        auto stiff = step;
        auto force = step;
        stiff.for_each([](double& v, double lo, double hi, double b, double a,
                          double f) { v = f == 0 ? 0 : b / (v - lo) + a / (hi - v); },
                       low, high, below, above, free);
        force.for_each([mu](double& v, double lo, double hi,
                            double f) { v = f == 0 ? 0 : mu / (v - lo) - mu / (hi - v); },
                       low, high, free);
        system_.matrix(0).diagonal().segment(1, g) += stiff.global;
        system_.side(0).segment(1, g) += force.global;
        for (std::size_t e = 0; e < step.local.size(); ++e) {
            auto const l = step.local[e].size();
            system_.matrix(e).diagonal().tail(l) += stiff.local[e];
            system_.side(e).tail(l) += force.local[e];
        }
    }
    [[nodiscard]] static arrow_vector held_of(arrow_vector const& free) {
        arrow_vector held;
        held.global.resize(free.global.size() + 1);
        held.global[0] = 0;
        held.global.tail(free.global.size()) = 1 - free.global.array();
        for (auto const& l : free.local) held.local.emplace_back((1 - l.array()).matrix());
        return held;
    }
    [[nodiscard]] static std::size_t size_of(arrow_vector const& z) {
        auto n = z.global.size();
        for (auto const& l : z.local) n += l.size();
        return static_cast<std::size_t>(n);
    }

    approximate_campaign* campaign_;
    descent descent_;
    arrow_system system_;
    std::vector<Eigen::VectorXd> lines_; ///< r + J d
    std::vector<minimax_block> blocks_;
    double gap_ = 0;
    bool to_vertices_ = false;
};

} // namespace sivid

#endif
