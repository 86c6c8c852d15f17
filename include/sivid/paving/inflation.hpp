// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_INFLATION_HPP
#define SIVID_PAVING_INFLATION_HPP

#include <sivid/compiled.hpp>
#include <sivid/paving/dependence.hpp>
#include <sivid/paving/identify.hpp>
#include <sivid/paving/inflation_search.hpp>
#include <sivid/paving/minimax_fit.hpp>
#include <sivid/paving/misfit.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

struct inflation_options {
    double relative_width = 0.05; ///< stop when upper - lower is at most this share of upper
    double seconds = 3;
    /// Stop after so many integrations of an experiment over a box and boxes bounded, together:
    /// unlike the time, the same on every machine.
    std::size_t work = std::numeric_limits<std::size_t>::max();
    /// So many in all where it is open then whether the inflation is above 1, or where the bounds
    /// have come near each other but are more than a tenth apart.
    std::size_t further_work = 0;
    bool only_verdict = false;        ///< stop as soon as lower > 1 or upper <= 1
    std::function<bool()> keep_going; ///< false stops the search with what is proved until then
    data_test_options test;
};

/// What was proved about the inflation of a problem.
struct inflation_bound {
    interval value{0.0, detail::infinity}; ///< contains it
    /// Attains `value.upper()`; none while that is infinite.
    std::optional<verified_witness> witness;
    /// Contains every parameter whose inflation is at most `value.upper()`.
    box hull;
    std::size_t boxes = 0;
    std::size_t integrations = 0;
    double seconds = 0;
};

/// Encloses the inflation at one point by validated runs: for each experiment the (q+1)-th largest
/// misfit, and the largest of these. Infinite where a run fails. The runs are those of the recorded
/// inputs: where inputs have error bounds, others may do better, and nothing is known from below.
/// @param test    of the same problem without limits of outliers
/// @param starts  one point, or next to a point, per experiment
/// @param what    receives the violated measurements
[[nodiscard]] inline interval inflation_at(data_test& test, identification_problem const& problem,
                                           box const& parameters, std::vector<box> const& starts,
                                           verified_witness& what) {
    double least = 0;
    double most = 0;
    what = {mid(parameters), {}, {}};
    for (std::size_t s = 0; s < problem.experiments.size(); ++s) {
        what.starts.push_back(mid(starts[s]));
        auto const answer = test.run_finely(s, starts[s], parameters);
        auto const values = output_ranges(*answer, parameters);
        std::vector<double> low(answer->measurements, 0.0);
        std::vector<double> high(answer->measurements, detail::infinity);
        auto& violated = what.violated.emplace_back(answer->measurements, true);
        for (std::size_t y = 0; y < values.size(); ++y) {
            auto const ratio = misfit(values[y], answer->bounds[y]);
            low[y] = ratio.lower();
            high[y] = ratio.upper();
            violated[y] = !subset(values[y], answer->bounds[y]);
        }
        auto const q = problem.experiments[s].outliers;
        if (!any_uncertain(problem.experiments[s].inputs)) {
            least = std::max(least, largest_after(std::move(low), q));
        }
        most = std::max(most, largest_after(std::move(high), q));
    }
    return interval_traits<interval>::bounds(least, most);
}

/// The problem with those measurements only for which keep(experiment index, measurement) holds;
/// experiments without any are left out.
template <class Keep>
[[nodiscard]] identification_problem restricted_to(identification_problem problem,
                                                   Keep const& keep) {
    std::vector<experiment> kept;
    for (std::size_t s = 0; s < problem.experiments.size(); ++s) {
        auto e = std::move(problem.experiments[s]);
        record measurements;
        for (auto const& m : e.measurements) {
            if (keep(s, m)) measurements.push_back(m);
        }
        e.measurements = std::move(measurements);
        if (!e.measurements.empty()) kept.push_back(std::move(e));
    }
    problem.experiments = std::move(kept);
    return problem;
}

namespace paving_detail {

/// One bounding of the inflation of one problem.
class inflation_work {
public:
    inflation_work(identification_problem const& problem, inflation_options const& options)
        : problem_(&problem),
          options_(&options),
          everything_(box_explorer::without_limit(problem)),
          points_(everything_, options.test),
          map_(reduction::find(problem, dependence_of(problem))),
          search_(working(), options.test),
          fit_(working()) {}

    [[nodiscard]] inflation_bound operator()(approximate_fit const* guess) {
        std::vector<std::vector<double>> starts;
        for (auto const& e : problem_->experiments) starts.push_back(mid(e.initial));
        if (guess != nullptr && guess->parameters.size() == problem_->prior.size() &&
            guess->starts.size() == starts.size()) {
            auto const& p = guess->parameters;
            improve(map_ ? mid(map_->forward(point_box(p))) : p, guess->starts);
            // Where the way back from the reduced problem ends beside the prior, the guess may do
            // better than what its descent came to.
            if (upper_ > 1.001 * guess->inflation) try_witness(p, guess->starts);
        }
        if (!witness_) improve(mid(working().prior), starts);
        auto const propose = [this](inflation_relaxation const& found, bool complete) {
            consider(found, complete);
        };
        while (!search_.exhausted() && !finished()) {
            search_.aim_at(target());
            search_.step(propose, [this] { return within_limits(); });
            if (promise_) {
                improve(promise_->point, promise_->starts);
                promise_.reset();
            }
        }
        return report();
    }

private:
    /// The problem with the fewest parameters that has the same trajectories.
    [[nodiscard]] identification_problem const& working() const {
        return map_ ? map_->problem() : *problem_;
    }
    [[nodiscard]] double elapsed() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    }
    [[nodiscard]] std::size_t work() const {
        return search_.integrations() + search_.tested() + points_.integrations();
    }
    [[nodiscard]] bool within_limits() const {
        return work() < most_work_ && elapsed() < options_->seconds &&
               (!options_->keep_going || options_->keep_going());
    }
    [[nodiscard]] bool finished() {
        double const lower = search_.lower(); // meaningless within a step
        most_work_ = options_->work;
        bool const open = upper_ > 1 && !(lower > 1);
        bool const near = lower > 0.6 * upper_ && lower < 0.9 * upper_;
        if (open || near) most_work_ = std::max(most_work_, options_->further_work);
        if (options_->only_verdict && (lower > 1 || upper_ <= 1)) return true;
        return lower >= (1 - options_->relative_width) * upper_ || !within_limits();
    }
    [[nodiscard]] double target() const {
        double const enough = (1 - options_->relative_width) * upper_;
        if (options_->only_verdict && enough > 1) return std::nextafter(1.0, 2.0);
        return std::isfinite(enough) ? enough : std::max(1.0, 2 * search_.lower());
    }

    /// Keeps the best promise of a step, if it promises enough to be worth validated runs. Where
    /// outputs are missing it is worth little.
    void consider(inflation_relaxation const& found, bool complete) {
        double const enough = (1 - 0.2 * options_->relative_width) * upper_;
        if (found.point.empty() || !(found.approximate_value < enough)) return;
        if (!complete && witness_ && 10 * descents_ > search_.tested()) return;
        if (promise_ && !(found.approximate_value < promise_->approximate_value)) return;
        promise_ = found;
    }
    /// Descends from a point of the working problem and verifies where that leads.
    void improve(std::vector<double> const& point, std::vector<std::vector<double>> const& starts) {
        ++descents_;
        auto const better = fit_(point, starts, [this] { return within_limits(); });
        if (better.parameters.empty()) {
            verify(point, starts);
        } else if (better.inflation < upper_) {
            verify(better.parameters, better.starts);
        }
    }
    void verify(std::vector<double> const& point, std::vector<std::vector<double>> const& starts) {
        try_witness(map_ ? map_->approximate_preimage(problem_->prior, point) : point, starts);
    }
    /// @param point  of the problem itself
    void try_witness(std::vector<double> const& point,
                     std::vector<std::vector<double>> const& starts) {
        verified_witness candidate;
        std::vector<box> from;
        for (std::size_t s = 0; s < starts.size(); ++s) {
            from.push_back(point_within(problem_->experiments[s].initial, starts[s]));
        }
        auto const parameters = point_within(problem_->prior, point);
        auto const value = inflation_at(points_, *problem_, parameters, from, candidate);
        if (value.upper() < upper_) {
            upper_ = value.upper();
            witness_ = std::move(candidate);
            search_.drop_above(upper_);
        }
    }
    [[nodiscard]] inflation_bound report() {
        inflation_bound result;
        result.value = interval_traits<interval>::bounds(std::min(search_.lower(), upper_), upper_);
        result.witness = std::move(witness_);
        box around;
        for (auto const& b : search_.cover()) around = around.size() == 0 ? b : hull(around, b);
        if (around.size() == 0) around = map_ ? map_->forward(problem_->prior) : problem_->prior;
        result.hull = map_ ? map_->backward(problem_->prior, around) : around;
        result.boxes = search_.tested();
        result.integrations = search_.integrations() + points_.integrations();
        result.seconds = elapsed();
        return result;
    }

    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
    identification_problem const* problem_;
    inflation_options const* options_;
    identification_problem everything_;
    data_test points_;
    std::optional<reduction> map_;
    inflation_search search_;
    minimax_fitter fit_;
    double upper_ = detail::infinity;
    std::size_t descents_ = 0;
    std::size_t most_work_ = std::max(options_->work, options_->further_work);
    std::optional<inflation_relaxation> promise_;
    std::optional<verified_witness> witness_;
};

} // namespace paving_detail

/// Bounds the factor by which all measured bounds must grow until some parameter of the prior
/// explains the data,
///   \f$ \lambda^* = \min_p \max_s \min_{x_{0s}} (q_s+1)\text{-th largest } |y_i - m_i|/e_i \f$;
/// the boxes of the initial states and the error bounds of inputs do not grow; where inputs have
/// such bounds, the least is over them, too. lower > 1 proves that no parameter explains the
/// data, upper <= 1 that one does.
/// @param guess  where the upper bound may start; without it the search proposes points itself
/// @guarantee  `value` contains the inflation whenever the search ends
/// @cost  dominated by integrations over boxes; some tens for a few parameters that the data fix
[[nodiscard]] SIVID_ENTRY inflation_bound bound_inflation(identification_problem const& problem,
                                                          approximate_fit const* guess = nullptr,
                                                          inflation_options const& options = {});

#if !defined(SIVID_COMPILED) || defined(SIVID_COMPILE_BOUND_INFLATION)
SIVID_ENTRY inflation_bound bound_inflation(identification_problem const& problem,
                                            approximate_fit const* guess,
                                            inflation_options const& options) {
    require_sound_environment();
    problem.require_valid();
    return paving_detail::inflation_work(problem, options)(guess);
}
#endif

} // namespace sivid

#endif
