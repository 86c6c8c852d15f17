// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STRATEGY_INQUIRY_HPP
#define SIVID_PAVING_STRATEGY_INQUIRY_HPP

#include <sivid/approximate/approximate_fit.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/inversion_options.hpp>
#include <sivid/paving/judge/feasibility_test.hpp>
#include <sivid/paving/strategy/contractor.hpp>
#include <sivid/space/box.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid {

/// A problem that is being worked on: what is left of it, and what contractors and a search share.
/// Runs are made when they are asked for, and dropped when less is left.
class inquiry {
public:
    /// @param search  how parts are searched, where a contractor does so
    /// @param limit   of all that comes before the search
    inquiry(identification_problem problem, feasibility_test_options test, inversion_options search,
            work_limit limit)
        : whole_(std::move(problem)),
          problem_(whole_),
          options_(std::move(test)),
          search_(std::move(search)),
          limit_(std::move(limit)) {}
    inquiry(inquiry const&) = delete;
    inquiry& operator=(inquiry const&) = delete;

    /// With what is left as prior and as starts.
    [[nodiscard]] identification_problem const& problem() const { return problem_; }
    [[nodiscard]] feasibility_test_options const& options() const { return options_; }
    [[nodiscard]] inversion_options const& search() const { return search_; }
    [[nodiscard]] work_limit const& limit() const { return limit_; }
    [[nodiscard]] bool empty() const { return is_empty(problem_.prior); }

    [[nodiscard]] leftover left() const {
        leftover result{problem_.prior};
        for (auto const& e : problem_.experiments) result.starts.push_back(e.initial);
        return result;
    }
    /// A problem with the same sides, of which this is left.
    [[nodiscard]] identification_problem left_of(identification_problem other) const {
        other.prior = problem_.prior;
        for (std::size_t e = 0; e < other.experiments.size(); ++e)
            other.experiments[e].initial = problem_.experiments[e].initial;
        return other;
    }
    /// Whether less is left than there was.
    [[nodiscard]] bool narrowed() const { return narrowed_; }
    /// Intersects what is left with what a contractor leaves. @returns whether that is less
    /// @throws std::invalid_argument  where it is of another problem
    bool narrow(leftover const& found) {
        auto const& own = problem_.experiments;
        bool const fits = found.parameters.size() == problem_.prior.size() &&
                          (found.starts.empty() || found.starts.size() == own.size());
        if (!fits) refuse();
        for (std::size_t e = 0; e < found.starts.size(); ++e)
            if (found.starts[e].size() != own[e].initial.size()) refuse();
        std::vector<std::pair<box*, box>> less;
        bool none = false;
        auto const compare = [&](box& mine, box const& other) {
            auto part = intersect(mine, other);
            none = none || is_empty(part);
            if (!subset(mine, part)) less.emplace_back(&mine, std::move(part));
        };
        compare(problem_.prior, found.parameters);
        for (std::size_t e = 0; e < found.starts.size(); ++e)
            compare(problem_.experiments[e].initial, found.starts[e]);
        if (!none && less.empty()) return false;
        drop_runs();
        narrowed_ = true;
        if (none) {
            problem_.prior = empty_box(problem_.prior.size());
            return true;
        }
        for (auto& [mine, part] : less) *mine = std::move(part);
        return true;
    }

    /// Of `problem()`.
    [[nodiscard]] feasibility_test& test() {
        if (!test_) test_.emplace(problem_, options_);
        return *test_;
    }
    /// The share of the measurements that runs over all that is left reach, from all starts.
    [[nodiscard]] double reach() {
        if (!reach_) reach_ = test().reached(problem_.prior);
        return *reach_;
    }
    /// Whether the starts of all experiments are known, but for rounding.
    [[nodiscard]] bool starts_known() const {
        return std::ranges::all_of(problem_.experiments, [](experiment const& e) {
            return normalised_unknowns(e.initial, {}).variables == 0;
        });
    }

    /// What a fit proposes.
    /// @param point  its parameters, as sides of this problem
    /// @throws std::invalid_argument  where it is of other experiments
    void propose(approximate_fit const& fit, box point) {
        if (fit.starts.size() != whole_.experiments.size())
            throw std::invalid_argument("identification state: its fit is of another problem");
        fitted_ = std::move(point);
        fitted_starts_ = fit.starts;
    }
    /// The fitted parameters, or else the middle of what is left.
    [[nodiscard]] box fitted() const { return point_box(mid(fitted_ ? *fitted_ : problem_.prior)); }
    /// Of the fit, within all starts, or within those that are left; none without a fit.
    [[nodiscard]] std::vector<box> proposed_starts() const { return proposed_within(whole_); }
    [[nodiscard]] std::vector<box> fitted_starts() const { return proposed_within(problem_); }

    [[nodiscard]] identification_problem const& whole() const { return whole_; }
    /// The problem with the whole prior and the starts that are left.
    [[nodiscard]] identification_problem const& searched() const {
        return searched_ ? *searched_ : whole_;
    }
    /// For a search of the whole prior: what is not left is cut off before it is run, existence is
    /// proved from the starts of the fit. Made from the same problem, options, fit and leftover
    /// it answers the same, on whatever machine.
    [[nodiscard]] feasibility_test& search_test() {
        if (narrowed_ && !search_test_) {
            searched_ = whole_;
            for (std::size_t e = 0; e < whole_.experiments.size() && !empty(); ++e)
                searched_->experiments[e].initial = problem_.experiments[e].initial;
            searched_->require_valid();
            search_test_.emplace(*searched_, options_);
            search_test_->set_rest(problem_.prior);
        }
        auto& result = narrowed_ ? *search_test_ : test();
        if (fitted_) result.set_starts(fitted_starts());
        return result;
    }

    /// Lines of contractors that were asked, or not.
    [[nodiscard]] contraction_journal& journal() { return journal_; }
    /// Whether one of these was asked and removed something of the parameters.
    [[nodiscard]] bool gained(std::string_view by) const {
        return std::ranges::any_of(
            journal_, [&](contraction_record const& r) { return r.by == by && r.left < 1; });
    }
    /// Of all tests until now.
    [[nodiscard]] std::size_t integrations() const {
        return dropped_ + (test_ ? test_->integrations() : 0) +
               (search_test_ ? search_test_->integrations() : 0);
    }

private:
    [[nodiscard]] std::vector<box> proposed_within(identification_problem const& problem) const {
        std::vector<box> starts;
        for (std::size_t e = 0; e < fitted_starts_.size(); ++e)
            starts.push_back(point_within(problem.experiments[e].initial, fitted_starts_[e]));
        return starts;
    }
    [[noreturn]] static void refuse() {
        throw std::invalid_argument("what is left of a prior is of another problem");
    }
    void drop_runs() {
        if (test_) dropped_ += test_->integrations();
        test_.reset();
        reach_.reset();
        search_test_.reset();
        searched_.reset();
    }

    identification_problem whole_, problem_;
    feasibility_test_options options_;
    inversion_options search_;
    work_limit limit_;
    bool narrowed_ = false;
    std::optional<feasibility_test> test_; ///< refers to `problem_`
    std::optional<double> reach_;
    std::optional<box> fitted_;
    std::vector<std::vector<double>> fitted_starts_;
    std::optional<identification_problem> searched_;
    std::optional<feasibility_test> search_test_; ///< refers to `searched_`
    contraction_journal journal_;
    std::size_t dropped_ = 0; ///< integrations of tests that are gone
};

} // namespace sivid

#endif
