// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_MINIMAX_FIT_HPP
#define SIVID_PAVING_MINIMAX_FIT_HPP

#include <sivid/enclosure/simulate.hpp>
#include <sivid/paving/fit.hpp>
#include <sivid/paving/minimax_lp.hpp>
#include <sivid/paving/misfit.hpp>
#include <sivid/paving/problem.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <exception>
#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace sivid {

/// Descends to a local minimum of the inflation: successive linear programs over a box around the
/// present point, which grows while they foretell well and shrinks otherwise. The q measurements of
/// an experiment that are worst at the present point are left out of its program.
///   Faster than the squares of `fitter`, and exact at kinks, where the least inflation lies.
/// @guarantee  none; the point lies in the prior, the starts in their boxes
/// @cost  one simulation per unknown and step; some ten steps
class minimax_fitter {
public:
    explicit minimax_fitter(identification_problem const& problem) : problem_(&problem) {
        auto unknown = problem.prior.size();
        for (auto const& e : problem.experiments) {
            flows_.push_back(std::make_unique<flow>(problem.model, problem.choice, e.inputs));
            simulators_.emplace_back(*flows_.back());
            records_.push_back(sorted(e.measurements));
            auto& times = times_.emplace_back();
            for (auto const& m : records_.back()) {
                if (times.empty() || times.back() < m.time) times.push_back(m.time);
            }
            first_start_.push_back(unknown);
            unknown += e.initial.size();
        }
        for (auto const& side : problem.prior) sides_.push_back(side);
        for (auto const& e : problem.experiments) {
            for (auto const& side : e.initial) sides_.push_back(side);
        }
    }

    /// @param go_on  false ends the descent with the best point so far
    [[nodiscard]] approximate_fit operator()(std::vector<double> const& parameters,
                                             std::vector<std::vector<double>> const& starts,
                                             std::function<bool()> const& go_on = {}) {
        auto z = joined(parameters, starts);
        approximate_fit best;
        if (!look(z, best)) return best;
        double reach = 0.25; // of the sides
        for (int step = 0; step < 60 && reach > 1e-9 && (!go_on || go_on()); ++step) {
            auto const solved = program(z, best.residuals, reach);
            if (solved.point.empty()) return best;
            auto trial = z;
            for (std::size_t k = 0; k < z.size(); ++k) {
                auto const range = around(z, k, reach);
                trial[k] = std::clamp(mid(range) + rad(range) * solved.point[k], range.lower(),
                                      range.upper());
            }
            double const foretold = best.inflation - solved.value;
            approximate_fit next;
            double const gained = look(trial, next) ? best.inflation - next.inflation : -HUGE_VAL;
            bool const relaxed = !(foretold > 1e-5 * best.inflation);
            if (gained > 0) {
                z = std::move(trial);
                best = std::move(next);
            }
            if (gained > 0.7 * foretold) {
                reach = std::min(2 * reach, 1.0);
            } else if (!(gained > 0.2 * foretold)) {
                reach /= 4;
            }
            if (relaxed) break;
        }
        return best;
    }

private:
    [[nodiscard]] std::vector<double> joined(std::vector<double> z,
                                             std::vector<std::vector<double>> const& starts) const {
        for (auto const& x0 : starts) z.insert(z.end(), x0.begin(), x0.end());
        for (std::size_t k = 0; k < z.size(); ++k) {
            z[k] = std::clamp(z[k], sides_[k].lower(), sides_[k].upper());
        }
        return z;
    }
    [[nodiscard]] std::vector<double> start_of(std::size_t e, std::vector<double> const& z) const {
        auto const from = z.begin() + static_cast<std::ptrdiff_t>(first_start_[e]);
        return {from, from + static_cast<std::ptrdiff_t>(problem_->experiments[e].initial.size())};
    }
    /// Where an unknown may go in one step.
    [[nodiscard]] interval around(std::vector<double> const& z, std::size_t k, double reach) const {
        double const way = reach * width(sides_[k]);
        return interval_traits<interval>::bounds(std::max(z[k] - way, sides_[k].lower()),
                                                 std::min(z[k] + way, sides_[k].upper()));
    }

    /// (output - middle) / half width for all measurements of an experiment; false when its
    /// simulation fails.
    [[nodiscard]] bool residuals(std::size_t e, std::vector<double> const& z,
                                 std::vector<double>& out) {
        auto const n = static_cast<std::ptrdiff_t>(problem_->prior.size());
        approximate_trajectory run;
        try {
            run = simulators_[e](start_of(e, z), {z.begin(), z.begin() + n},
                                 problem_->experiments[e].begin, times_[e]);
        } catch (std::exception const&) {
            return false;
        }
        out.clear();
        std::size_t row = 0;
        for (auto const& m : records_[e]) {
            while (times_[e][row] < m.time) ++row;
            double const y = run.outputs[row][m.channel];
            if (!std::isfinite(y)) return false;
            double const size = 0.5 * width(m.bound);
            out.push_back(std::isfinite(size) ? (y - mid(m.bound)) / std::max(size, 1e-100) : 0);
        }
        return true;
    }
    [[nodiscard]] bool look(std::vector<double> const& z, approximate_fit& found) {
        auto const n = static_cast<std::ptrdiff_t>(problem_->prior.size());
        found.residuals.resize(flows_.size());
        double worst = 0;
        for (std::size_t e = 0; e < flows_.size(); ++e) {
            if (!residuals(e, z, found.residuals[e])) return false;
            worst = std::max(worst, limit_of(e, found.residuals[e]));
            found.starts.push_back(start_of(e, z));
        }
        found.parameters.assign(z.begin(), z.begin() + n);
        found.inflation = worst;
        return true;
    }
    /// The inflation of one experiment.
    [[nodiscard]] double limit_of(std::size_t e, std::vector<double> const& r) const {
        std::vector<double> size;
        for (double const v : r) size.push_back(std::abs(v));
        return largest_after(std::move(size), problem_->experiments[e].outliers);
    }

    /// The linear program over the box around a point; no point when a simulation fails.
    [[nodiscard]] approximate_minimax program(std::vector<double> const& z,
                                              std::vector<std::vector<double>> const& now,
                                              double reach) {
        std::vector<minimax_block> blocks;
        std::vector<double> moved;
        for (std::size_t e = 0; e < flows_.size(); ++e) {
            minimax_block b;
            b.offset = now[e];
            b.margin.assign(now[e].size(), 0.0);
            double const limit = limit_of(e, now[e]);
            for (std::size_t y = 0; y < now[e].size(); ++y) {
                if (problem_->experiments[e].outliers > 0 && std::abs(now[e][y]) > limit) {
                    b.margin[y] = std::numeric_limits<double>::infinity();
                }
            }
            for (std::size_t k = 0; k < z.size(); ++k) {
                auto const own = k - first_start_[e];
                bool const is_mine =
                    k < problem_->prior.size() ||
                    (k >= first_start_[e] && own < problem_->experiments[e].initial.size());
                if (!is_mine || !(rad(around(z, k, reach)) > 0)) continue;
                double const d = 1e-5 * width(sides_[k]);
                auto other = z;
                other[k] += z[k] + d < sides_[k].upper() ? d : -d;
                if (!residuals(e, other, moved)) return {};
                auto const range = around(z, k, reach);
                b.variable.push_back(k);
                for (std::size_t y = 0; y < moved.size(); ++y) {
                    double const slope = (moved[y] - now[e][y]) / (other[k] - z[k]);
                    b.slope.push_back(slope * rad(range));
                    b.offset[y] += slope * (mid(range) - z[k]);
                }
            }
            blocks.push_back(std::move(b));
        }
        return minimax_solver(z.size(), blocks)();
    }

    identification_problem const* problem_;
    std::vector<std::unique_ptr<flow>> flows_;
    std::vector<approximate_simulator> simulators_;
    std::vector<record> records_;
    std::vector<std::vector<double>> times_;
    std::vector<std::size_t> first_start_; ///< per experiment: where its start begins among all
    std::vector<interval> sides_;          ///< of all unknowns
};

} // namespace sivid

#endif
