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
#include <sivid/paving/strategy/inquiry.hpp>
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
        begin_search(working());
        while (search_->next() != nullptr && !finished()) {
            step();
            if (in_the_dark() && !finished()) ask_contractors();
        }
        return report();
    }

private:
    /// The problem with the fewest parameters that has the same trajectories.
    [[nodiscard]] identification_problem const& working() const {
        return map_ ? map_->problem() : *problem_;
    }
    void begin_search(identification_problem const& problem) {
        if (search_) {
            integrated_ += search_->integrations();
            tested_ += search_->tested();
        }
        search_.emplace(problem, test_within_time());
        search_->policy().above = upper_;
        search_->policy().propose = [this](inflation_relaxation const& found, bool complete) {
            consider(found, complete);
        };
    }
    void step() {
        search_->policy().target = target();
        search_->step([this] { return within_time(); });
        if (!promise_) return;
        improve(promise_->point, promise_->starts);
        promise_.reset();
    }
    /// Runs end early and bound nothing, and contractors have not been asked of the witness, or of
    /// one that was more than twice as bad.
    [[nodiscard]] bool in_the_dark() const {
        auto const* const next = search_->next();
        return next != nullptr && !next->is_complete() && !(search_->lower() > 0) &&
               !(asked_at_ && upper_ >= 0.5 * *asked_at_);
    }
    /// Asks contractors of bounds that have grown. Where they leave nothing at a level, the
    /// inflation is larger; a witness is sought in what they leave at the next one. What does no
    /// worse than it is in what they leave at its own: that is searched.
    void ask_contractors() {
        work_limit const own(0.3 * limit_.seconds(), [this] { return within_time(); });
        double level = asked_at_ ? upper_ : std::nextafter(1.0, 2.0);
        for (bool sought = false; level < upper_ && !sought && own() && within_limits();) {
            auto const left = left_at(level, own);
            sought = left && std::isfinite(improve_within(*left));
            if (left && !narrowed(*left)) break;
            if (!left) refuted_ = level;
            if (!left && options_->only_verdict) return;
            level = std::isfinite(upper_) ? std::sqrt(level * upper_) : 4 * level;
        }
        asked_at_ = upper_;
        if (!std::isfinite(upper_) || finished()) return;
        auto const left = left_at(upper_, own);
        if (!left || !narrowed(*left)) return;
        begin_search(*left);
        improve_within(*left);
    }
    /// The problem with what contractors leave of its prior and starts at a level of the inflation.
    [[nodiscard]] std::optional<identification_problem> left_at(double level,
                                                                work_limit const& within) {
        work_limit const own(0.5 * within.seconds(), within);
        inquiry asked(with_bounds_grown(working(), level), limited(options_->test, own), {}, own);
        contract(options_->strategy, asked);
        integrated_ += asked.integrations();
        if (asked.empty()) return std::nullopt;
        return asked.left_of(working());
    }
    [[nodiscard]] bool narrowed(identification_problem const& rest) const {
        bool same = subset(working().prior, rest.prior);
        for (std::size_t e = 0; e < rest.experiments.size(); ++e)
            same = same && subset(working().experiments[e].initial, rest.experiments[e].initial);
        return !same;
    }
    /// Proved.
    [[nodiscard]] double lower() const { return std::max(search_->lower(), refuted_); }
    [[nodiscard]] std::size_t work() const { return tested_ + search_->tested() + integrations(); }
    [[nodiscard]] std::size_t integrations() const {
        return integrated_ + search_->integrations() + points_.integrations();
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
        return work() < most_work_ && search_->bytes() <= options_->memory && within_time();
    }
    [[nodiscard]] bool finished() {
        double const lower = this->lower(); // meaningless within a step
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
        return std::isfinite(enough) ? enough : std::max(1.0, 2 * lower());
    }

    /// Keeps the best promise of a step, if it promises enough to be worth validated runs. Where
    /// outputs are missing it is worth little.
    void consider(inflation_relaxation const& found, bool complete) {
        double const enough = (1 - 0.2 * options_->relative_width) * upper_;
        if (found.point.empty() || !(found.approximate_value < enough)) return;
        if (!complete && witness_ && 30 * descents_ > search_->tested()) return;
        if (promise_ && !(found.approximate_value < promise_->approximate_value)) return;
        promise_ = found;
    }
    /// Descends from a point of the working problem and verifies where that leads.
    void improve(std::vector<double> const& point, std::vector<std::vector<double>> const& starts) {
        improve(fit_, point, starts);
    }
    /// Descends within what is left of the working problem.
    /// @returns  the least inflation of a witness until now
    double improve_within(identification_problem const& left) {
        std::vector<std::vector<double>> starts;
        for (auto const& e : left.experiments) starts.push_back(mid(e.initial));
        approximate_fitter fit(left, [this] { return within_time(); });
        improve(fit, mid(left.prior), starts);
        return upper_;
    }
    void improve(approximate_fitter& fit, std::vector<double> const& point,
                 std::vector<std::vector<double>> const& starts) {
        ++descents_;
        auto const better = fit({point, starts});
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
            if (search_) search_->policy().above = upper_;
        }
    }
    [[nodiscard]] inflation_bound report() {
        inflation_bound result;
        result.value = interval_traits<interval>::bounds(std::min(lower(), upper_), upper_);
        result.witness = std::move(witness_);
        box around;
        for (auto const& b : search_->cover()) around = around.size() == 0 ? b : hull(around, b);
        if (around.size() == 0) around = map_ ? map_->forward(problem_->prior) : problem_->prior;
        result.hull = map_ ? map_->backward(problem_->prior, around) : around;
        result.boxes = tested_ + search_->tested();
        result.integrations = integrations();
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
    std::optional<inflation_search> search_;
    approximate_fitter fit_;
    double upper_ = detail::infinity;
    std::optional<double> asked_at_;          ///< `upper_`, when contractors were asked
    double refuted_ = 0;                      ///< level at which contractors left nothing
    std::size_t integrated_ = 0, tested_ = 0; ///< by contractors, and searches that are over
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
