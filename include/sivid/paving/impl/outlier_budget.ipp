// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_IMPL_OUTLIER_BUDGET_IPP
#define SIVID_PAVING_IMPL_OUTLIER_BUDGET_IPP

#include <sivid/paving/outlier_budget.hpp>

#include <sivid/approximate/fit/fit.hpp>
#include <sivid/compiled.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/identification.hpp>
#include <sivid/paving/judge/box_explorer.hpp>
#include <sivid/paving/judge/witness.hpp>
#include <sivid/paving/outliers/detail/outlier_count.hpp>
#include <sivid/paving/products/dependence.hpp>
#include <sivid/paving/products/reduction.hpp>
#include <sivid/paving/strategy/inquiry.hpp>
#include <sivid/paving/strategy/strategy.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

namespace paving_detail {

/// Finds parameters and starts that violate few measurements: proposed by fits, counted by
/// validated runs.
class few_violations {
public:
    /// @param keep_going  false ends what is tried; what was found stands
    few_violations(identification_problem const& problem, feasibility_test_options const& options,
                   std::function<bool()> keep_going)
        : problem_(problem),
          tolerant_(box_explorer::without_limit(problem)),
          keep_going_(std::move(keep_going)),
          test_(tolerant_, options) {
        for (auto const& e : problem.experiments) budgets_.push_back(e.measurements.size());
    }
    few_violations(few_violations const&) = delete; // the test refers to the problem
    few_violations& operator=(few_violations const&) = delete;

    [[nodiscard]] std::size_t total() const {
        return std::accumulate(budgets_.begin(), budgets_.end(), std::size_t{0});
    }
    [[nodiscard]] std::vector<std::size_t> const& budgets() const { return budgets_; }
    [[nodiscard]] std::optional<verified_witness> const& witness() const { return witness_; }
    [[nodiscard]] std::size_t integrations() const { return test_.integrations(); }

    /// From no outlier to as many as a third of the measurements, then down again.
    void search() {
        std::size_t most = 0;
        for (auto const& e : problem_.experiments) most = std::max(most, e.measurements.size());
        for (std::size_t q = 0; 3 * q <= most && keep_going_(); q = q == 0 ? 1 : 2 * q) {
            for (auto& e : problem_.experiments) {
                e.outliers = std::min(q, e.measurements.size() / 2);
            }
            auto const guess = approximate_fitter(problem_, keep_going_)();
            (void)propose(guess);
            if (guess.inflation <= 1) break;
        }
        if (witness_) decrease();
    }
    /// Fits in what is left of the problem for q outliers.
    void search_within(identification_problem rest, std::size_t q) {
        for (auto& e : rest.experiments) e.outliers = std::min(q, e.measurements.size() / 2);
        if (propose(approximate_fitter(rest, keep_going_)())) decrease();
    }
    /// Tries a parameter that may do with fewer than are known to suffice; with a fit from there,
    /// too, if the first does not suffice.
    void search_from(std::vector<double> const& parameters, bool with_fit) {
        std::vector<std::vector<double>> starts;
        for (auto const& e : problem_.experiments) starts.push_back(mid(e.initial));
        if (witness_) starts = witness_->starts;
        if (propose(parameters, std::move(starts)) || !with_fit) return;
        std::size_t const before = total();
        for (std::size_t e = 0; e < budgets_.size(); ++e) {
            problem_.experiments[e].outliers =
                std::min(budgets_[e], problem_.experiments[e].measurements.size() / 2);
        }
        if (propose(approximate_fitter(problem_, keep_going_)({parameters})) && total() < before)
            decrease();
    }

private:
    /// Fits with one outlier less in an experiment, as long as that works.
    void decrease() {
        for (bool better = true; better && keep_going_();) {
            better = false;
            for (std::size_t e = 0; e < budgets_.size() && !better; ++e) {
                if (budgets_[e] == 0) continue;
                for (std::size_t k = 0; k < budgets_.size(); ++k) {
                    problem_.experiments[k].outliers = budgets_[k] - (k == e ? 1 : 0);
                }
                better = propose(approximate_fitter(problem_, keep_going_)({witness_->parameters}));
            }
        }
    }
    /// @returns whether fewer are violated than before
    bool propose(approximate_fit const& guess) {
        return !guess.parameters.empty() && propose(guess.parameters, guess.starts);
    }
    bool propose(std::vector<double> const& parameters, std::vector<std::vector<double>> starts) {
        auto found = verify_witness(test_, tolerant_, parameters, starts);
        if (!found) return false;
        std::vector<std::size_t> violated;
        for (auto const& v : found->violated) {
            violated.push_back(static_cast<std::size_t>(std::count(v.begin(), v.end(), true)));
        }
        if (std::accumulate(violated.begin(), violated.end(), std::size_t{0}) >= total()) {
            return false;
        }
        budgets_ = std::move(violated);
        witness_ = std::move(found);
        return true;
    }

    identification_problem problem_;  ///< with the budgets of the next fit
    identification_problem tolerant_; ///< any number of outliers allowed
    std::function<bool()> keep_going_;
    feasibility_test test_;
    std::vector<std::size_t> budgets_;
    std::optional<verified_witness> witness_;
};

/// The problem with what contractors leave for those that violate fewer than `most`; nothing where
/// none do.
inline std::optional<identification_problem> left_for_fewer(identification_problem const& problem,
                                                            std::size_t most,
                                                            outlier_search_options const& options,
                                                            smallest_budget& spent) {
    auto posed = problem;
    for (auto& e : posed.experiments) e.outliers = std::min(most - 1, e.measurements.size());
    work_limit const own(0.2 * options.seconds, options.keep_going);
    inquiry asked(std::move(posed), limited(options.test, own), {}, own);
    contract(options.strategy, asked);
    spent.integrations += asked.integrations();
    if (asked.empty()) return std::nullopt;
    return asked.left_of(problem);
}

/// Where no fit has found parameters: what contractors leave for no outlier, for one, for two, ...
/// is searched for some. @returns so many outliers are needed at the least
inline std::size_t first_level_left(identification_problem const& problem, few_violations& few,
                                    outlier_search_options const& options, smallest_budget& spent) {
    std::size_t least = 0;
    auto const most = few.total();
    for (std::size_t q = 0; q < most && !few.witness() && options.keep_going(); ++q) {
        auto rest = left_for_fewer(problem, q + 1, options, spent);
        if (!rest)
            least = q + 1;
        else if (relative_volume(rest->prior, problem.prior).upper() < 1)
            few.search_within(*std::move(rest), q);
        else
            break; // nothing is known of so many, nor of more
    }
    return least;
}

/// Bounds from below what `few` bounds from above.
inline proved_count least_violations(identification_problem const& whole, few_violations& few,
                                     std::vector<std::size_t> const& least,
                                     outlier_search_options const& options,
                                     smallest_budget& spent) {
    auto const refuted = first_level_left(whole, few, options, spent);
    auto const left =
        few.total() > 0 ? left_for_fewer(whole, few.total(), options, spent) : std::optional{whole};
    if (!left) {
        spent.reason = stop_reason::decided;
        return {few.total(), few.total()};
    }
    auto const& problem = *left;
    auto const map = reduction::find(problem, dependence_of(problem));
    outlier_count_search search(map ? map->problem() : problem, least, options);
    std::size_t attempts = 0;
    auto const found = search(few.total(), [&](std::vector<double> const& middle) {
        if (++attempts <= 200) {
            few.search_from(map ? map->approximate_preimage(problem.prior, middle) : middle,
                            attempts <= 12);
        }
        return few.total();
    });
    auto const bound = std::max(found, refuted);
    spent.boxes += search.boxes();
    spent.integrations += search.integrations();
    spent.reason = bound < few.total() ? search.reason() : stop_reason::decided;
    return {std::min(bound, few.total()), few.total()};
}

} // namespace paving_detail

SIVID_DECL smallest_budget smallest_outlier_budget(identification_problem const& problem,
                                                   outlier_search_options const& asked) {
    problem.require_data();
    work_limit const limit(asked.seconds, asked.keep_going);
    auto options = asked;
    options.keep_going = limit;
    options.test = limited(std::move(options.test), limit);
    smallest_budget result;
    paving_detail::few_violations few(problem, options.test, limit);
    few.search();
    auto const count = problem.experiments.size();
    std::vector<std::size_t> least(count, 0);
    auto share = options;
    if (count > 1) {
        for (std::size_t e = 0; e < count; ++e) {
            auto const together = few.budgets()[e];
            if (together == 0) {
                result.alone.push_back({0, 0});
                continue;
            }
            auto one = problem;
            one.experiments = {problem.experiments[e]};
            paving_detail::few_violations own(one, options.test, limit);
            own.search();
            share.seconds = std::max(0.0, 0.5 * (options.seconds - limit.spent()) /
                                              static_cast<double>(count - e));
            auto found = paving_detail::least_violations(one, own, {}, share, result);
            found.most = std::min(found.most, few.witness() ? together : found.most);
            result.integrations += own.integrations();
            least[e] = found.least;
            result.alone.push_back(found);
        }
    }
    share.seconds = std::max(0.0, options.seconds - limit.spent());
    result.total = paving_detail::least_violations(problem, few, least, share, result);
    // What is asked there knows the time, too.
    if (result.reason == stop_reason::cancelled && (!asked.keep_going || asked.keep_going()))
        result.reason = stop_reason::time_budget;
    if (count == 1) result.alone = {result.total};
    result.budgets = few.budgets();
    result.witness = few.witness();
    result.integrations += few.integrations();
    result.seconds = limit.spent();
    return result;
}

} // namespace sivid

#endif
