// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_FIT_DETAIL_MINIMAX_SEARCH_HPP
#define SIVID_APPROXIMATE_FIT_DETAIL_MINIMAX_SEARCH_HPP

#include <sivid/approximate/fit/campaign.hpp>
#include <sivid/approximate/fit/descent.hpp>
#include <sivid/approximate/fit/detail/fit_at.hpp>
#include <sivid/approximate/fit/suspect_samples.hpp>
#include <sivid/compiled.hpp>
#include <sivid/space/minimax_lp.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace sivid {

namespace approximate_detail {

/// The work of a `minimax_fitter`.
class minimax_search {
public:
    explicit minimax_search(identification_problem const& problem) : campaign_(problem) {}

    [[nodiscard]] approximate_fit operator()(std::vector<double> const& parameters,
                                             std::vector<std::vector<double>> const& starts,
                                             std::function<bool()> const& go_on) {
        campaign_.set_accuracy(1e-3); // as what it ends with is judged
        campaign_.set_keep_going(go_on);
        descent down(campaign_);
        descent_point best;
        if (!down.evaluate(campaign_.variables(parameters, starts), best)) return {};
        auto const& spare = campaign_.outliers();
        if (std::any_of(spare.begin(), spare.end(), [](auto q) { return q > 0; })) {
            // Which samples are left out is a matter of where one stands: nearer first.
            auto nearer = best;
            down.run(nearer, 1.2, without_suspects(campaign_), {12, 1e-3}, &best);
        }
        double reach = 0.25; // of the sides
        for (int step = 0; step < 60 && reach > 1e-9 && (!go_on || go_on()); ++step) {
            residual_lists r;
            if (!campaign_.linearise(best.at, r)) break;
            auto const range = around(best.at, reach);
            auto const solved = minimax_solver(range.unknowns, program(best, range))();
            std::size_t k = 0;
            auto z = best.at;
            z.for_each([&](double& v, double middle,
                           double radius) { v = middle + radius * solved.point[k++]; },
                       range.middle, range.radius);
            double const foretold = best.inflation - solved.value;
            descent_point trial;
            double const gained =
                down.evaluate(std::move(z), trial) ? best.inflation - trial.inflation : -HUGE_VAL;
            bool const relaxed = !(foretold > 1e-5 * best.inflation);
            if (gained > 0) best = std::move(trial);
            if (gained > 0.7 * foretold) {
                reach = std::min(2 * reach, 1.0);
            } else if (!(gained > 0.2 * foretold)) {
                reach /= 4;
            }
            if (relaxed) break;
        }
        return fit_at(campaign_, std::move(best));
    }

private:
    /// Where the variables may go in one step.
    struct trust_box {
        arrow_vector middle, radius;
        std::size_t unknowns = 0;
    };
    [[nodiscard]] trust_box around(arrow_vector const& z, double reach) const {
        trust_box result{z, z, 0};
        result.middle.for_each(
            [&](double& m, double& r, double lo, double hi) {
                double const way = reach * (hi - lo);
                double const from = std::max(m - way, lo), to = std::min(m + way, hi);
                m = 0.5 * (from + to);
                r = 0.5 * (to - from);
                ++result.unknowns;
            },
            result.radius, campaign_.lower(), campaign_.upper());
        return result;
    }

    /// The linearised residuals over a box; the unknowns in the order of `arrow_vector::for_each`.
    [[nodiscard]] std::vector<minimax_block> const& program(descent_point const& here,
                                                            trust_box const& range) {
        auto const kept = kept_of(here.residuals, campaign_.outliers());
        auto const globals = here.at.global.size();
        std::size_t first = static_cast<std::size_t>(globals); // of the experiment's own unknowns
        blocks_.clear();
        for (std::size_t e = 0; e < here.residuals.size(); ++e) {
            auto const slopes = campaign_.derivatives(e);
            auto const own = here.at.local[e].size();
            auto& b = blocks_.emplace_back();
            b.offset = here.residuals[e];
            for (double const weight : kept[e]) {
                b.margin.push_back(weight > 0 ? 0 : std::numeric_limits<double>::infinity());
            }
            auto const add = [&](Eigen::Index column, std::size_t unknown, double at, double middle,
                                 double radius) {
                b.variable.push_back(unknown);
                for (Eigen::Index y = 0; y < slopes.rows(); ++y) {
                    double const slope = slopes(y, column);
                    b.slope.push_back(slope * radius);
                    b.offset[static_cast<std::size_t>(y)] += slope * (middle - at);
                }
            };
            for (Eigen::Index k = 0; k < globals; ++k) {
                add(k, static_cast<std::size_t>(k), here.at.global[k], range.middle.global[k],
                    range.radius.global[k]);
            }
            for (Eigen::Index k = 0; k < own; ++k) {
                add(globals + k, first + static_cast<std::size_t>(k), here.at.local[e][k],
                    range.middle.local[e][k], range.radius.local[e][k]);
            }
            first += static_cast<std::size_t>(own);
        }
        return blocks_;
    }

    campaign campaign_;
    std::vector<minimax_block> blocks_;
};

} // namespace approximate_detail

SIVID_ENTRY minimax_fitter::minimax_fitter(identification_problem const& problem)
    : work_(std::make_unique<approximate_detail::minimax_search>(problem)) {}
SIVID_ENTRY minimax_fitter::~minimax_fitter() = default;
SIVID_ENTRY approximate_fit minimax_fitter::operator()(
    std::vector<double> const& parameters, std::vector<std::vector<double>> const& starts,
    std::function<bool()> const& go_on) {
    return (*work_)(parameters, starts, go_on);
}

} // namespace sivid

#endif
