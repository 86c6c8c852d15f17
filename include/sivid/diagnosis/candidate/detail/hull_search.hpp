// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CANDIDATE_DETAIL_HULL_SEARCH_HPP
#define SIVID_DIAGNOSIS_CANDIDATE_DETAIL_HULL_SEARCH_HPP

#include <sivid/diagnosis/candidate/detail/explained_hull.hpp>
#include <sivid/diagnosis/candidate/effect_hull_options.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/model/structure/combination.hpp>
#include <sivid/paving/invert.hpp>
#include <sivid/paving/judge/feasibility_test.hpp>
#include <sivid/paving/products/dependence.hpp>
#include <sivid/paving/products/reduction.hpp>
#include <sivid/paving/strategy/detail/aided_test.hpp>
#include <sivid/paving/strategy/inquiry.hpp>
#include <sivid/paving/strategy/strategy.hpp>
#include <sivid/space/box.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// What problems leave of their priors, one after the other, within one limit for all.
class hull_search {
public:
    explicit hull_search(effect_hull_options const& options)
        : options_(&options), limit_(options.seconds, options.keep_going) {}

    [[nodiscard]] bool in_time() const { return limit_(); }
    [[nodiscard]] double accuracy() const { return options_->accuracy; }

    /// Nothing when it explains nothing. Without a fit, which excludes nothing.
    /// @param share  of the boxes, and of the time that is left where that has no share of its own
    /// @param known  products of parameters that are within these ranges already
    [[nodiscard]] std::optional<explained_hull>
    operator()(identification_problem const& problem, double share,
               std::optional<double> time = std::nullopt,
               std::vector<combination_hull> const& known = {}) const {
        if (problem.prior.size() == 0) return explained_hull{problem.prior};
        auto const map = coordinates_of(problem);
        auto posed = map ? map->problem() : problem;
        if (map) posed.prior = map->forward(problem.prior, known);
        if (is_empty(posed.prior)) return std::nullopt;
        inversion_options search{
            .accuracy_of_hull = true, .hull_gain = 0.02, .small_hull = 1e-3, .keep_outside = false};
        search.seconds = time.value_or(share) * limit_.seconds();
        search.boxes = static_cast<std::size_t>(share * static_cast<double>(options_->boxes));
        search.keep_going = limit_;
        work_limit const own(search.seconds, limit_);
        inquiry asked(std::move(posed), limited(options_->test, limit_), search, own);
        contract(options_->strategy, asked);
        if (options_->tried) options_->tried(asked.journal());
        if (asked.empty()) return std::nullopt;
        search.seconds = own.seconds();
        paving_detail::aided_test aided(asked.test(), asked.problem(), options_->strategy, own);
        auto const paving = invert(aided, asked.problem().prior, search).paving;
        if (!paving.has_outer()) return std::nullopt;
        auto const left = paving.outer_hull();
        if (!map) return explained_hull{left};
        return explained_hull{map->backward(problem.prior, left), map->products_over(left)};
    }

private:
    effect_hull_options const* options_;
    work_limit limit_;
};

/// Which side of a problem's prior a parameter is; their number where it is not among them.
[[nodiscard]] inline std::size_t index_of_parameter(identification_problem const& problem,
                                                    std::string const& name) {
    auto const& names = problem.choice.unknown;
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

} // namespace sivid

#endif
