// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_INFLATION_DETAIL_INFLATION_SEARCH_HPP
#define SIVID_PAVING_INFLATION_DETAIL_INFLATION_SEARCH_HPP

#include <sivid/model/problem.hpp>
#include <sivid/paving/inflation/detail/inflation_relaxation.hpp>
#include <sivid/paving/judge/box_explorer.hpp>
#include <sivid/paving/judge/detail/response_search.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

namespace sivid {

/// A box of parameters with a proved bound of the inflation.
struct inflation_box : explored_box {
    double lower = 0;
};

/// Which boxes may have the least inflation: see `inflation_search`.
class inflation_policy {
public:
    using node = inflation_box;
    /// Called with a point of each box that was bounded.
    using proposal = std::function<void(inflation_relaxation const&, bool complete)>;

    std::vector<std::size_t> outliers;
    proposal propose = nullptr;
    double above = detail::infinity; ///< boxes with more are of no interest from now on
    double target = 1;               ///< with outliers, bounds beyond this are not worth extra work

    [[nodiscard]] static bool before(node const& a, node const& b) { return a.lower < b.lower; }
    [[nodiscard]] bool drops(node const& b) const { return b.lower > above; }
    void judge(node& b) const {
        auto const found = inflation_bounder(b.known, outliers, b.set)(target);
        b.lower = std::max(b.lower, found.lower);
        b.smear = found.smear;
        propose(found, b.is_complete());
        double const missing = std::isfinite(above) ? above - b.lower : std::max(b.lower, 1.0);
        bool ended = false; // early, and that holds the bound back
        for (std::size_t s = 0; s < b.known.size(); ++s) {
            auto const& r = *b.known[s];
            bool const cut = r.outputs() < r.measurements && found.slack < 0.5 * missing;
            b.stale[s] = cut || !(found.blur[s] <= 0.1 * missing);
            ended = ended || cut;
        }
        if (ended) b.smear = found.ending;
    }
};

/// Branch and bound over boxes of parameters, the one with the least proved inflation first. An
/// experiment is integrated anew for a part when remainders, or an end before all measurements,
/// hold the bound back.
/// @guarantee  every parameter of the prior lies in a box of `cover()`, or its inflation is at
///             least `lower()` and more than the bound above which boxes were dropped
class inflation_search : public response_search<inflation_policy> {
public:
    inflation_search(identification_problem const& problem, feasibility_test_options const& options)
        : response_search(problem, options, {.outliers = outlier_budgets(problem)}, problem.prior) {
    }

    /// Proved: no parameter of the prior has a smaller inflation.
    [[nodiscard]] double lower() const {
        double least = policy().above;
        if (auto const* best = next()) least = std::min(least, best->lower);
        for (auto const& b : stuck()) least = std::min(least, b.lower);
        return least;
    }
    /// All boxes that may contain parameters with an inflation of at most `above`.
    [[nodiscard]] std::vector<box> cover() const {
        std::vector<box> result;
        for (auto const* list : {&waiting(), &stuck()}) {
            for (auto const& b : *list) {
                if (!policy().drops(b)) result.push_back(b.set);
            }
        }
        return result;
    }
};

} // namespace sivid

#endif
