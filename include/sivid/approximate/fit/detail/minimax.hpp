// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_FIT_DETAIL_MINIMAX_HPP
#define SIVID_APPROXIMATE_FIT_DETAIL_MINIMAX_HPP

#include <sivid/approximate/fit/detail/descent.hpp>
#include <sivid/approximate/fit/detail/interior_points.hpp>
#include <sivid/space/linear_program/minimax_lp.hpp>

#include <algorithm>
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
        if (to_vertices_ && step.size() <= few) return by_exchanges(here, kept, low, high, step);
        return interior_points(*campaign_, here, kept, low, high)(gap_, step);
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

    approximate_campaign* campaign_;
    descent descent_;
    std::vector<minimax_block> blocks_;
    double gap_ = 0;
    bool to_vertices_ = false;
};

} // namespace sivid

#endif
