// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_FIT_HPP
#define SIVID_PAVING_FIT_HPP

#include <sivid/paving/approximate_fit.hpp>
#include <sivid/paving/campaign.hpp>
#include <sivid/paving/descent.hpp>
#include <sivid/paving/minimax.hpp>
#include <sivid/paving/problem.hpp>
#include <sivid/paving/suspect_samples.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace sivid {

/// What a descent came to, simulated once more with care; only infinite figures where it came to
/// nothing.
[[nodiscard]] inline approximate_fit fit_at(campaign& c, descent_point here) {
    approximate_fit result;
    if (!std::isfinite(here.inflation)) return result;
    c.set_accuracy(1e-3);
    residual_lists fine;
    if (c.residuals(here.at, fine)) here.residuals = std::move(fine);
    c.set_accuracy(1);
    result.inflation = inflation_of(here.residuals, c.outliers());
    result.parameters = c.parameters(here.at);
    for (std::size_t e = 0; e < c.experiments(); ++e) {
        result.starts.push_back(c.start(e, here.at));
    }
    result.residuals = std::move(here.residuals);
    return result;
}

/// Minimises the inflation: least squares that leave out what looks like an outlier, then a higher
/// power, then Chebyshev steps on the largest residuals, without the q largest of each experiment.
/// Models with delays are welcome. All in plain doubles.
/// @cost  about twenty simulations with sensitivities
class fitter {
public:
    explicit fitter(identification_problem const& problem)
        : campaign_(std::make_unique<campaign>(problem)) {}

    /// From the centre of the prior and, when that fails, from a few points spread over it.
    [[nodiscard]] approximate_fit operator()() {
        descent_point best;
        int agreeing = 0;
        for (std::size_t k = 0; k < 8 && best.inflation > 0.98 && agreeing < 1; ++k) {
            // Two descents that end far away from an explanation say that there is none.
            if (k >= 2 && best.inflation > hopeless_inflation) break;
            auto const found = from(start_point(k));
            // Two descents that end at the same height have found the bottom.
            if (std::abs(found.inflation - best.inflation) < 0.02 * best.inflation) ++agreeing;
            if (found.inflation < best.inflation) best = found;
        }
        return finished(std::move(best));
    }

    /// From a point given for the parameters.
    [[nodiscard]] approximate_fit operator()(std::vector<double> const& parameters) {
        auto z = start_point(0);
        auto const& free = campaign_->free_parameters();
        for (std::size_t k = 0; k < free.size(); ++k) {
            if (free[k] < parameters.size()) {
                z.global[static_cast<Eigen::Index>(k)] = parameters[free[k]];
            }
        }
        return finished(from(std::move(z)));
    }

    /// Minimises the sum of squared residuals instead, without the q largest of each experiment.
    /// @param parameters  where to begin; empty: at the centre of the prior
    [[nodiscard]] approximate_fit least_squares(std::vector<double> const& parameters = {}) {
        auto z = start_point(0);
        auto const& free = campaign_->free_parameters();
        for (std::size_t k = 0; k < free.size(); ++k) {
            if (free[k] < parameters.size()) {
                z.global[static_cast<Eigen::Index>(k)] = parameters[free[k]];
            }
        }
        descent down(*campaign_);
        descent_point here;
        if (!down.evaluate(std::move(z), here)) return {};
        down.run(here, 2, {}, {40, 1e-6});
        squares_ = squares_of(here);
        return finished(std::move(here));
    }

    /// The residuals at a point, without any descent.
    [[nodiscard]] approximate_fit at(std::vector<double> const& parameters,
                                     std::vector<std::vector<double>> const& starts) {
        descent_point here;
        if (!descent(*campaign_).evaluate(campaign_->variables(parameters, starts), here)) {
            return {};
        }
        return finished(std::move(here));
    }

private:
    static constexpr double hopeless_inflation = 4;

    /// The centre, then points of a low-discrepancy sequence.
    [[nodiscard]] arrow_vector start_point(std::size_t k) const {
        auto z = campaign_->lower();
        std::size_t i = 0;
        z.for_each(
            [&](double& v, double hi) {
                double const golden = std::fmod(
                    0.5 + static_cast<double>(k) * std::sqrt(static_cast<double>(2 + 3 * i++)),
                    1.0);
                v += golden * (hi - v);
            },
            campaign_->upper());
        return z;
    }

    [[nodiscard]] descent_point from(arrow_vector z) {
        descent down(*campaign_);
        descent_point here;
        if (!down.evaluate(std::move(z), here)) return here;
        auto best = here;
        auto const& outliers = campaign_->outliers();
        if (std::any_of(outliers.begin(), outliers.end(), [](auto q) { return q > 0; })) {
            auto const kept = without_suspects(*campaign_);
            down.run(here, 1.2, kept, {12, 1e-3}, &best);
        }
        down.run(here, 2, {}, {20, 1e-3}, &best);
        squares_ = std::min(squares_, squares_of(here));
        if (best.inflation < 0.7) return best;
        down.run(here, 8, {}, {6, 1e-2}, &best);
        auto unit = campaign_->upper();
        unit.for_each([](double& u, double lo) { u = std::max(u - lo, 1e-12); },
                      campaign_->lower());
        minimax(*campaign_).run(best, unit);
        return best;
    }

    /// Once more, with care.
    [[nodiscard]] double squares_of(descent_point const& here) const {
        auto const kept = kept_of(here.residuals, campaign_->outliers());
        double sum = 0;
        for (std::size_t e = 0; e < kept.size(); ++e) {
            for (std::size_t k = 0; k < kept[e].size(); ++k) {
                sum += kept[e][k] * here.residuals[e][k] * here.residuals[e][k];
            }
        }
        return sum;
    }

    [[nodiscard]] approximate_fit finished(descent_point here) {
        auto result = fit_at(*campaign_, std::move(here));
        result.squares = squares_;
        return result;
    }

    std::unique_ptr<campaign> campaign_;
    double squares_ = std::numeric_limits<double>::infinity();
};

} // namespace sivid

#endif
