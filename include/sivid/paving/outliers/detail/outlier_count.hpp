// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_OUTLIERS_DETAIL_OUTLIER_COUNT_HPP
#define SIVID_PAVING_OUTLIERS_DETAIL_OUTLIER_COUNT_HPP

#include <sivid/model/problem.hpp>
#include <sivid/paving/contract/detail/lp_contractor.hpp>
#include <sivid/paving/judge/detail/response_search.hpp>
#include <sivid/paving/outliers/outlier_search_options.hpp>
#include <sivid/paving/response/local_response.hpp>
#include <sivid/paving/search/search_budget.hpp>
#include <sivid/space/box.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

namespace sivid {

/// A box of parameters with how many measurements are violated all over it.
struct outlier_box : explored_box {
    std::vector<std::size_t> least; ///< by experiment
    std::size_t bound = 0;          ///< all experiments together
    double volume = 1;
};

/// Which boxes may violate the fewest measurements: see `outlier_count_search`.
struct outlier_policy {
    using node = outlier_box;

    box prior;
    double sharp_enough = 0;
    std::function<bool()> keep_going;
    std::size_t goal = 0; ///< boxes that violate so many are of no interest

    [[nodiscard]] static bool before(node const& a, node const& b) {
        return a.bound < b.bound || (a.bound == b.bound && a.volume > b.volume);
    }
    [[nodiscard]] bool drops(node const& n) const { return is_empty(n.set) || n.bound >= goal; }
    [[nodiscard]] bool cancelled() const { return keep_going && !keep_going(); }
    [[nodiscard]] static std::size_t sum(std::vector<std::size_t> const& all) {
        return std::accumulate(all.begin(), all.end(), std::size_t{0});
    }

    /// Raises the bound of a box, and contracts it to what may violate fewer than the goal.
    void judge(node& n) const {
        auto const none = [&] { n.bound = goal; };
        std::size_t const most = goal - 1;
        auto const spare = [&](std::size_t e) { return most - (sum(n.least) - n.least[e]); };
        for (std::size_t e = 0; e < n.known.size(); ++e) {
            if (sum(n.least) > most) return none();
            auto r = std::make_shared<response>(*n.known[e]);
            for (r->allowed = n.least[e]; r->allowed <= spare(e); ++r->allowed) {
                auto part = n.set;
                if (cancelled()) break; // so many are proved, perhaps more are needed
                if (!assess(*r, part).refuted && lp_contractor()({r}, part)) break;
            }
            n.least[e] = r->allowed;
        }
        n.bound = std::max(n.bound, sum(n.least));
        if (n.bound > most) return none();
        auto joint = n.set;
        if (n.known.size() > 1 && !lp_contractor()(allowing(n.known, n.least), joint)) {
            n.bound = std::max(n.bound, sum(n.least) + 1);
            if (n.bound > most) return none();
        }
        auto cap = n.least;
        for (std::size_t e = 0; e < cap.size(); ++e) cap[e] = spare(e);
        auto const known = allowing(n.known, cap);
        n.smear.assign(n.set.size(), 0.0);
        for (std::size_t e = 0; e < known.size(); ++e) {
            auto const& r = *known[e];
            auto const says = assess(r, n.set);
            if (says.refuted) return none();
            for (std::size_t j = 0; j < n.set.size(); ++j) n.smear[j] += says.smear[j];
            n.stale[e] = r.outputs() < r.measurements || !(says.sharpness <= sharp_enough);
        }
        if (!lp_contractor()(known, n.set)) return none();
        n.volume = relative_volume(n.set, prior).upper();
    }

private:
    [[nodiscard]] static response_list allowing(response_list const& known,
                                                std::vector<std::size_t> const& outliers) {
        response_list result;
        for (std::size_t e = 0; e < known.size(); ++e) {
            auto own = std::make_shared<response>(*known[e]);
            own->allowed = outliers[e];
            result.push_back(std::move(own));
        }
        return result;
    }
};

/// Bounds from below how many measurements every parameter of the prior violates, all experiments
/// together, by branch and bound.
///   Over a box, experiment e violates at least as many as the least q for which the q-relaxed
///   tests do not refute it; the sum over the experiments, and one more when all together refute
///   that distribution, is the box's bound. The box with the least bound is looked at first. Boxes
///   that cannot violate fewer than `goal` are dropped, and contracted by that.
/// @guarantee  `bound` outliers are needed: for every parameter and all starts at least so many
///             measurements fail
class outlier_count_search {
public:
    /// @param problem  its budgets of outliers do not matter
    /// @param least    by experiment: what is known to be violated at least, or empty
    outlier_count_search(identification_problem const& problem, std::vector<std::size_t> least,
                         outlier_search_options options)
        : options_(std::move(options)),
          search_(problem, options_.test,
                  {problem.prior, options_.test.sharp_enough, options_.keep_going}, problem.prior,
                  known(problem, std::move(least))) {}

    /// At least so many measurements are violated, or `goal` when that is less.
    [[nodiscard]] std::size_t bound() const {
        std::size_t least = search_.policy().goal;
        for (auto const* list : {&search_.waiting(), &search_.stuck()}) {
            for (auto const& n : *list) least = std::min(least, n.bound);
        }
        return least;
    }
    /// Why the search ended where it did not decide.
    [[nodiscard]] stop_reason reason() const { return reason_; }
    [[nodiscard]] std::size_t boxes() const { return search_.tested(); }
    [[nodiscard]] std::size_t integrations() const { return search_.integrations(); }

    /// Searches until no parameter is left that may violate fewer than `goal`.
    /// @param promising  called with a parameter that may do with fewer; returns the new goal
    /// @returns bound()
    template <class Promising>
    std::size_t operator()(std::size_t goal, Promising&& promising) {
        auto& policy = search_.policy();
        policy.goal = goal;
        work_limit const limit(options_.seconds, options_.keep_going);
        std::function<bool()> const go_on = [&] {
            return !policy.cancelled() && !used_up(options_, limit, boxes(), search_.bytes());
        };
        while (auto const* next = search_.next()) {
            if (bound() >= policy.goal) break;
            if (!go_on()) {
                auto const over = used_up(options_, limit, boxes(), search_.bytes());
                reason_ = over.value_or(stop_reason::cancelled);
                break;
            }
            if (!next->is_blind() && hopeful(*next) < policy.goal) {
                policy.goal = std::min(policy.goal, promising(mid(next->set)));
                if (policy.drops(*next)) continue;
            }
            search_.step(go_on);
        }
        return bound();
    }

private:
    [[nodiscard]] static outlier_box known(identification_problem const& problem,
                                           std::vector<std::size_t> least) {
        outlier_box result;
        least.resize(problem.experiments.size(), 0);
        result.bound = outlier_policy::sum(least);
        result.least = std::move(least);
        return result;
    }

    /// How many measurements seem to be violated in the middle.
    [[nodiscard]] static std::size_t hopeful(outlier_box const& n) {
        std::size_t failed = 0;
        auto const middle = point_box(mid(n.set));
        for (auto const& r : n.known) {
            auto const values = output_ranges(*r, middle);
            for (std::size_t y = 0; y < values.size(); ++y) {
                failed += disjoint(values[y], r->bounds[y]) ? 1 : 0;
            }
            failed += r->measurements - values.size();
        }
        return failed;
    }

    outlier_search_options options_;
    response_search<outlier_policy> search_;
    stop_reason reason_ = stop_reason::accuracy_reached; // boxes that cannot be split are left
};

} // namespace sivid

#endif
