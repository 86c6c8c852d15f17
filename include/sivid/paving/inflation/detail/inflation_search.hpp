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
    double above = detail::infinity; ///< boxes with more are of no interest
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
class inflation_search {
public:
    using proposal = inflation_policy::proposal;

    inflation_search(identification_problem const& problem, data_test_options const& options)
        : search_(problem, options, {.outliers = outlier_budgets(problem)}, problem.prior) {}

    /// Boxes with more are of no interest from now on.
    void drop_above(double bound) { policy().above = std::min(policy().above, bound); }
    /// With outliers, bounds beyond this are not worth extra work.
    void aim_at(double target) { policy().target = target; }

    /// Proved: no parameter of the prior has a smaller inflation.
    [[nodiscard]] double lower() const {
        double least = search_.policy().above;
        if (auto const* next = search_.next()) least = std::min(least, next->lower);
        for (auto const& b : search_.stuck()) least = std::min(least, b.lower);
        return least;
    }
    [[nodiscard]] bool exhausted() const { return search_.next() == nullptr; }
    [[nodiscard]] std::size_t tested() const { return search_.tested(); }
    [[nodiscard]] std::size_t integrations() const { return search_.integrations(); }

    /// All boxes that may contain parameters with an inflation of at most `above`.
    [[nodiscard]] std::vector<box> cover() const {
        std::vector<box> result;
        for (auto const* list : {&search_.waiting(), &search_.stuck()}) {
            for (auto const& b : *list) {
                if (!search_.policy().drops(b)) result.push_back(b.set);
            }
        }
        return result;
    }

    /// Splits the box with the least bound, or integrates over several.
    /// @param go_on  false ends an integration between two experiments
    void step(proposal const& propose, std::function<bool()> const& go_on) {
        policy().propose = propose;
        search_.step(go_on);
    }

private:
    [[nodiscard]] inflation_policy& policy() { return search_.policy(); }

    response_search<inflation_policy> search_;
};

} // namespace sivid

#endif
