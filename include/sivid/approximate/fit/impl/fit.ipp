// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_FIT_IMPL_FIT_IPP
#define SIVID_APPROXIMATE_FIT_IMPL_FIT_IPP

#include <sivid/approximate/fit/fit.hpp>

#include <sivid/approximate/fit/detail/approximate_campaign.hpp>
#include <sivid/approximate/fit/detail/descent.hpp>
#include <sivid/approximate/fit/detail/minimax.hpp>
#include <sivid/approximate/fit/detail/suspect_samples.hpp>
#include <sivid/approximate/fit/detail/thinned.hpp>
#include <sivid/compiled.hpp>

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

/// The work of an `approximate_fitter`.
class fit_search {
public:
    fit_search(identification_problem const& problem, std::function<bool()> keep_going)
        : campaign_(problem) {
        if (measurement_count(problem) > 2 * many_measurements) {
            few_ = std::make_unique<identification_problem>(thinned(problem, many_measurements));
            by_few_ = std::make_unique<fit_search>(*few_, keep_going);
            each_of_few_ = static_cast<double>(measurement_count(problem)) /
                           static_cast<double>(measurement_count(*few_));
        }
        campaign_.set_keep_going(std::move(keep_going));
    }

    [[nodiscard]] approximate_fit operator()(fit_start const& start, fit_norm norm) {
        if (norm == fit_norm::squares) return least_squares(begin_at(start));
        if (!start.starts.empty()) return sharpened(begin_at(start));
        if (by_few_) return from_few(start);
        if (!start.parameters.empty()) return finished(from(begin_at(start)));
        return search();
    }

    [[nodiscard]] approximate_fit at(std::vector<double> const& parameters,
                                     std::vector<std::vector<double>> const& starts, bool roughly) {
        descent_point here;
        if (!descent(campaign_).evaluate(campaign_.variables(parameters, starts), here)) {
            return {};
        }
        return roughly ? as_descended(campaign_, std::move(here)) : finished(std::move(here));
    }

private:
    static constexpr double hopeless_inflation = 4;

    [[nodiscard]] approximate_fit search() {
        descent_point best;
        int agreeing = 0;
        for (std::size_t k = 0;
             k < 8 && best.inflation > 0.98 && agreeing < 1 && !campaign_.cancelled(); ++k) {
            // Two descents that end far away from an explanation say that there is none.
            if (k >= 2 && best.inflation > hopeless_inflation) break;
            auto const found = from(start_point(k));
            // Two descents that end at the same height have found the bottom.
            if (std::abs(found.inflation - best.inflation) < 0.02 * best.inflation) ++agreeing;
            if (found.inflation < best.inflation) best = found;
        }
        // A motion of many periods has many minima; those beside the right one drive parameters to
        // the ends of their ranges. Over a short time there is one.
        for (std::size_t k = 0;
             k < 4 && best.inflation > 1 && is_at_end(best) && !campaign_.cancelled(); ++k) {
            auto const found = over_growing_time(start_point(k));
            if (found.inflation < best.inflation) best = found;
        }
        return finished(std::move(best));
    }

    /// By a part of the samples first; where that is an explanation, or close, by all.
    [[nodiscard]] approximate_fit from_few(fit_start const& start) {
        auto const near = (*by_few_)(start, fit_norm::largest);
        if (near.parameters.empty()) return near;
        auto z = campaign_.variables(near.parameters, near.starts);
        if (near.inflation <= hopeless_inflation) return finished(from(std::move(z)));
        descent_point here;
        if (!descent(campaign_).evaluate(std::move(z), here)) return {};
        minimax(campaign_).run(here, sides(), {.rounds = 3});
        squares_ = near.squares * each_of_few_; // of the least squares, about
        return finished(std::move(here));
    }

    [[nodiscard]] approximate_fit least_squares(arrow_vector z) {
        descent down(campaign_);
        descent_point here;
        if (!down.evaluate(std::move(z), here)) return {};
        down.run(here, 2, {}, {40, 1e-6});
        squares_ = squares_of(here);
        return finished(std::move(here));
    }

    /// Stays near: nothing but what makes the inflation less, in simulations as they are judged.
    [[nodiscard]] approximate_fit sharpened(arrow_vector z) {
        campaign_.set_accuracy(judged_accuracy);
        descent down(campaign_);
        descent_point best;
        if (down.evaluate(std::move(z), best)) {
            if (any_outliers()) {
                // Which samples are left out is a matter of where one stands: nearer first.
                auto nearer = best;
                down.run(nearer, 1.2, without_suspects(campaign_), {12, 1e-3}, &best);
            }
            minimax(campaign_).run(best, sides(), minimax_options::sharp());
        }
        auto result = finished(std::move(best));
        campaign_.set_accuracy(1);
        return result;
    }

    /// The centre, then points of a low-discrepancy sequence.
    [[nodiscard]] arrow_vector start_point(std::size_t k) const {
        auto z = campaign_.lower();
        std::size_t i = 0;
        z.for_each(
            [&](double& v, double hi) {
                double const golden = std::fmod(
                    0.5 + static_cast<double>(k) * std::sqrt(static_cast<double>(2 + 3 * i++)),
                    1.0);
                v += golden * (hi - v);
            },
            campaign_.upper());
        return z;
    }

    /// The centre, but for what is given.
    [[nodiscard]] arrow_vector begin_at(fit_start const& start) const {
        auto z = start_point(0);
        if (!start.starts.empty()) z = campaign_.variables(campaign_.parameters(z), start.starts);
        auto const& free = campaign_.free_parameters();
        for (std::size_t k = 0; k < free.size(); ++k) {
            if (free[k] < start.parameters.size()) {
                z.global[static_cast<Eigen::Index>(k)] = start.parameters[free[k]];
            }
        }
        return z;
    }
    [[nodiscard]] bool any_outliers() const {
        auto const& q = campaign_.outliers();
        return std::any_of(q.begin(), q.end(), [](auto most) { return most > 0; });
    }
    /// Of the box of the variables.
    [[nodiscard]] arrow_vector sides() const {
        auto unit = campaign_.upper();
        unit.for_each([](double& u, double lo) { u -= lo; }, campaign_.lower());
        return unit;
    }

    /// Whether a parameter sits at an end of its range, but for an end of 0.
    [[nodiscard]] bool is_at_end(descent_point const& here) const {
        auto const& z = here.at.global;
        for (Eigen::Index k = 0; k < z.size(); ++k) {
            double const lo = campaign_.lower().global[k], hi = campaign_.upper().global[k];
            double const near = 1e-3 * (hi - lo);
            auto const at = [&](double end) {
                return std::abs(end) > near && !(std::abs(z[k] - end) > near);
            };
            if (at(lo) || at(hi)) return true;
        }
        return false;
    }
    /// Descends on the first samples of each experiment, then on more and more of them.
    [[nodiscard]] descent_point over_growing_time(arrow_vector z) {
        descent down(campaign_);
        descent_point here;
        if (!down.evaluate(std::move(z), here)) return here;
        for (double const share : {0.04, 0.08, 0.16, 0.32, 0.64}) {
            residual_lists kept;
            for (std::size_t e = 0; e < campaign_.experiments(); ++e) {
                auto const& requests = campaign_.requests(e);
                double const first = requests.empty() ? 0 : requests.front().time;
                double const end = requests.empty() ? 0 : requests.back().time;
                auto& own = kept.emplace_back();
                for (auto const& r : requests) {
                    own.push_back(r.time <= first + share * (end - first) ? 1 : 0);
                }
            }
            down.run(here, 2, kept, {12, 1e-3});
        }
        return from(std::move(here.at));
    }
    [[nodiscard]] descent_point from(arrow_vector z) {
        descent down(campaign_);
        descent_point here;
        if (!down.evaluate(std::move(z), here)) return here;
        auto best = here;
        if (any_outliers()) {
            auto const kept = without_suspects(campaign_);
            down.run(here, 1.2, kept, {12, 1e-3}, &best);
        }
        down.run(here, 2, {}, {20, 1e-3}, &best);
        squares_ = std::min(squares_, squares_of(here));
        if (best.inflation < 0.7) return best;
        // Far from an explanation Chebyshev steps alone come as far.
        if (best.inflation <= hopeless_inflation) down.run(here, 8, {}, {6, 1e-2}, &best);
        minimax(campaign_).run(best, sides());
        return best;
    }

    [[nodiscard]] double squares_of(descent_point const& here) const {
        auto const kept = kept_of(here.residuals, campaign_.outliers());
        double sum = 0;
        for (std::size_t e = 0; e < kept.size(); ++e) {
            for (std::size_t k = 0; k < kept[e].size(); ++k) {
                sum += kept[e][k] * here.residuals[e][k] * here.residuals[e][k];
            }
        }
        return sum;
    }

    [[nodiscard]] approximate_fit finished(descent_point here) {
        // The steps towards the largest may go on from where those of the squares have ended badly.
        double const squares = std::min(squares_, squares_of(here));
        auto result = fit_at(campaign_, std::move(here));
        result.squares = squares;
        return result;
    }

    approximate_campaign campaign_;
    std::unique_ptr<identification_problem> few_; ///< of the measurements, where there are many
    std::unique_ptr<fit_search> by_few_;
    double each_of_few_ = 1; ///< so many measurements stand for each of them
    double squares_ = std::numeric_limits<double>::infinity();
};

} // namespace approximate_detail

SIVID_DECL approximate_fitter::approximate_fitter(identification_problem const& problem,
                                                  std::function<bool()> keep_going)
    : work_(std::make_unique<approximate_detail::fit_search>(problem, std::move(keep_going))) {}
SIVID_DECL approximate_fitter::approximate_fitter(approximate_fitter&&) noexcept = default;
SIVID_DECL approximate_fitter&
approximate_fitter::operator=(approximate_fitter&&) noexcept = default;
SIVID_DECL approximate_fitter::~approximate_fitter() = default;
SIVID_DECL approximate_fit approximate_fitter::operator()(fit_start const& start, fit_norm norm) {
    return (*work_)(start, norm);
}
SIVID_DECL approximate_fit approximate_fitter::at(std::vector<double> const& parameters,
                                                  std::vector<std::vector<double>> const& starts) {
    return work_->at(parameters, starts, false);
}
SIVID_DECL approximate_fit approximate_fitter::roughly_at(
    std::vector<double> const& parameters, std::vector<std::vector<double>> const& starts) {
    return work_->at(parameters, starts, true);
}

} // namespace sivid

#endif
