// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_IMPL_INFLATION_IPP
#define SIVID_PAVING_IMPL_INFLATION_IPP

#include <sivid/paving/inflation.hpp>

#include <sivid/approximate/fit/fit.hpp>
#include <sivid/compiled.hpp>
#include <sivid/model/change/added_start.hpp>
#include <sivid/number/guard.hpp>
#include <sivid/paving/inflation/detail/inflation_search.hpp>
#include <sivid/paving/judge/witness.hpp>
#include <sivid/paving/products/dependence.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

namespace paving_detail {

/// One bounding of the inflation of one problem.
class inflation_work {
public:
    inflation_work(identification_problem const& problem, inflation_options const& options)
        : limit_(options.seconds, options.test.keep_going),
          problem_(&problem),
          options_(&options),
          everything_(box_explorer::without_limit(problem)),
          points_(everything_, test_within_time()),
          map_(reduction::find(problem, dependence_of(problem))),
          search_(working(), test_within_time()),
          fit_(working(), [this] { return within_time(); }) {}

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
        search_.policy().propose = [this](inflation_relaxation const& found, bool complete) {
            consider(found, complete);
        };
        while (search_.next() != nullptr && !finished()) {
            search_.policy().target = target();
            search_.step([this] { return within_time(); });
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
    [[nodiscard]] std::size_t work() const {
        return search_.integrations() + search_.tested() + points_.integrations();
    }
    [[nodiscard]] bool within_time() const {
        return limit_() && (!options_->keep_going || options_->keep_going());
    }
    /// Within runs, too: one of a long record takes seconds.
    [[nodiscard]] feasibility_test_options test_within_time() const {
        return limited(options_->test, limit_);
    }
    /// Asked between steps: a step that work cut short would have worked in vain, and where it was
    /// cut would depend on the threads.
    [[nodiscard]] bool within_limits() const {
        return work() < most_work_ && search_.bytes() <= options_->memory && within_time();
    }
    [[nodiscard]] bool finished() {
        double const lower = search_.lower(); // meaningless within a step
        most_work_ = options_->boxes;
        bool const open = upper_ > 1 && !(lower > 1);
        bool const near = lower > 0.6 * upper_ && lower < 0.9 * upper_;
        if (open || near) most_work_ = std::max(most_work_, options_->further_boxes);
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
        if (!complete && witness_ && 30 * descents_ > search_.tested()) return;
        if (promise_ && !(found.approximate_value < promise_->approximate_value)) return;
        promise_ = found;
    }
    /// Descends from a point of the working problem and verifies where that leads.
    void improve(std::vector<double> const& point, std::vector<std::vector<double>> const& starts) {
        ++descents_;
        auto const better = fit_({point, starts});
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
        auto const parameters = point_within(problem_->prior, point);
        std::vector<box> from;
        for (std::size_t s = 0; s < starts.size(); ++s) {
            auto start =
                start_that_follows(*problem_, s, parameters,
                                   point_within(problem_->experiments[s].initial, starts[s]));
            if (!start) return;
            from.push_back(std::move(*start));
        }
        auto const value = inflation_at(points_, *problem_, parameters, from, candidate);
        if (value.upper() < upper_) {
            upper_ = value.upper();
            witness_ = std::move(candidate);
            search_.policy().above = upper_;
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
        result.seconds = clock_.spent();
        return result;
    }

    stopwatch clock_;
    work_limit limit_;
    identification_problem const* problem_;
    inflation_options const* options_;
    identification_problem everything_;
    feasibility_test points_;
    std::optional<reduction> map_;
    inflation_search search_;
    approximate_fitter fit_;
    double upper_ = detail::infinity;
    std::size_t descents_ = 0;
    std::size_t most_work_ = std::max(options_->boxes, options_->further_boxes);
    std::optional<inflation_relaxation> promise_;
    std::optional<verified_witness> witness_;
};

} // namespace paving_detail

SIVID_DECL inflation_bound bound_inflation(identification_problem const& problem,
                                           approximate_fit const* guess,
                                           inflation_options const& options) {
    require_sound_environment();
    problem.require_data();
    return paving_detail::inflation_work(problem, options)(guess);
}

} // namespace sivid

#endif
