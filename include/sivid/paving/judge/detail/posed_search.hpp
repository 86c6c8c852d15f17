// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_JUDGE_DETAIL_POSED_SEARCH_HPP
#define SIVID_PAVING_JUDGE_DETAIL_POSED_SEARCH_HPP

#include <sivid/approximate/approximate_fit.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/contract/window_contraction.hpp>
#include <sivid/paving/identify_options.hpp>
#include <sivid/paving/judge/detail/prior_contraction.hpp>
#include <sivid/paving/judge/feasibility_test.hpp>
#include <sivid/paving/products/dependence.hpp>
#include <sivid/paving/products/reduction.hpp>

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sivid::paving_detail {

/// The problem by which an algorithm searches.
inline identification_problem as_searched(identification_problem problem, algorithm how) {
    if (how == algorithm::report_1) {
        for (auto& e : problem.experiments) e.outliers = 0;
    }
    return problem;
}
/// The test that it asks.
inline feasibility_test_options as_searched(feasibility_test_options test, algorithm how) {
    if (how != algorithm::contracting) test.contract = false;
    return test;
}
/// How it is searched.
inline inversion_options as_searched(inversion_options search, identify_options const& options) {
    constexpr double resting = 0.02; // of a side
    if (options.algorithm != algorithm::contracting) {
        search.order = search_order::first_in;
        search.accuracy_of_hull = false;
    } else if (options.only_hulls && !(search.hull_gain > 0)) {
        search.hull_gain = resting;
    }
    return search;
}

/// A start of each experiment that a fit proposes, within what is known of them.
inline std::vector<box> starts_of(approximate_fit const& fit,
                                  identification_problem const& problem) {
    if (fit.starts.size() != problem.experiments.size())
        throw std::invalid_argument("identification state: its fit is of another problem");
    std::vector<box> starts;
    for (std::size_t e = 0; e < fit.starts.size(); ++e) {
        starts.push_back(point_within(problem.experiments[e].initial, fit.starts[e]));
    }
    return starts;
}

/// What a search asks about boxes: the problem, in products of parameters where that helps, from
/// the starts that windows leave, with existence to be proved from those of a fit. Made from the
/// same problem, options, fit and windows it answers the same, on whatever machine.
class posed_search {
public:
    /// @param problem  `as_searched`; is referred to
    posed_search(identification_problem const& problem, dependence_structure const& structure,
                 identify_options const& options)
        : working_(&problem), options_(as_searched(options.test, options.algorithm)) {
        if (options.algorithm == algorithm::contracting) map_ = reduction::find(problem, structure);
        unhindered_.emplace(posed(), options_);
    }
    posed_search(posed_search const&) = delete;
    posed_search& operator=(posed_search const&) = delete;

    /// How the products follow from the parameters, where they are searched.
    [[nodiscard]] std::optional<reduction> const& map() const { return map_; }
    /// With all starts.
    [[nodiscard]] identification_problem const& posed() const {
        return map_ ? map_->problem() : *working_;
    }
    [[nodiscard]] feasibility_test& unhindered() { return *unhindered_; }

    /// What comes before the search; called once.
    /// @throws std::invalid_argument  for what is of another problem
    void prepare(std::optional<approximate_fit> const& fit,
                 std::optional<window_contraction> const& windows) {
        if (windows) {
            narrowed_ = narrowed_by(*windows, posed());
            further_.emplace(*narrowed_, options_);
            further_->set_rest(windows->rest);
        }
        if (fit) test().set_starts(starts_of(*fit, asked()));
    }
    /// With the starts that are left.
    [[nodiscard]] identification_problem const& asked() const {
        return narrowed_ ? *narrowed_ : posed();
    }
    [[nodiscard]] feasibility_test& test() { return further_ ? *further_ : *unhindered_; }
    /// Integrations of all tests.
    [[nodiscard]] std::size_t integrations() const {
        return unhindered_->integrations() + (further_ ? further_->integrations() : 0);
    }

private:
    identification_problem const* working_;
    feasibility_test_options options_;
    std::optional<reduction> map_;
    std::optional<feasibility_test> unhindered_;
    std::optional<identification_problem> narrowed_; ///< whose starts windows have contracted
    std::optional<feasibility_test> further_;
};

} // namespace sivid::paving_detail

#endif
