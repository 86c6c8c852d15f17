// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_JUDGE_DETAIL_EQUATION_AIDED_TEST_HPP
#define SIVID_PAVING_JUDGE_DETAIL_EQUATION_AIDED_TEST_HPP

#include <sivid/model/problem.hpp>
#include <sivid/number/interval_traits.hpp>
#include <sivid/paving/judge/feasibility_test.hpp>
#include <sivid/paving/observer/detail/observer_contraction.hpp>
#include <sivid/paving/relation/relation_contraction.hpp>
#include <sivid/paving/run/detail/lending_pool.hpp>
#include <sivid/paving/set_test.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace sivid {

/// What is left of a prior without runs, and the share of the volume that equations and observers
/// have each left of what they were given, all rounds together.
struct contraction_without_runs {
    box rest;
    double by_equations = 1, by_observers = 1;
};

/// What the state equations between samples and interval observers, one after the other, leave of
/// a prior until they rest: no trajectory is integrated. Equations see many measurements together,
/// observers see states that no channel shows.
/// @param problem  its model has no delays (checked)
/// @guarantee  no parameter that explains the data is removed; empty: proved, there is none
/// @cost  as both (`contract_by_relations`, `observer_contraction`), some rounds of them
[[nodiscard]] inline contraction_without_runs
contract_without_runs(identification_problem const& problem,
                      relation_contraction_options const& options) {
    contraction_without_runs result{problem.prior};
    auto& rest = result.rest;
    if (rest.size() == 0) return result;
    auto const share = [](box const& part, box const& whole) {
        return is_empty(part) ? 0.0 : std::min(1.0, relative_volume(part, whole).upper());
    };
    relation_test const between_samples(problem, options);
    observer_contraction along(problem, {.keep_going = options.keep_going});
    for (bool gains = true; gains && (!options.keep_going || options.keep_going());) {
        auto found = between_samples(rest);
        if (found.verdict == box_verdict::outside) found.rest = empty_box(rest.size());
        result.by_equations *= share(found.rest, rest);
        rest = found.rest;
        if (is_empty(rest)) return result;
        rest = along(found.rest);
        double const left = share(rest, found.rest);
        result.by_observers *= left;
        gains = !is_empty(rest) && left < 0.8;
    }
    return result;
}

/// `feasibility_test`, and where its runs end before they could tell interval observers and the
/// state equations between samples: together they search a prior over which no trajectory is
/// carried far.
/// @guarantee  as all of them; what observers and equations exclude has no certificate
class equation_aided_test {
public:
    static constexpr bool concurrent = true;
    using knowledge = feasibility_test::knowledge;

    /// @param runs, problem  outlive this
    /// @param below  the share of the measurements that runs over a box reach, below which the
    ///               equations are asked
    equation_aided_test(feasibility_test& runs, identification_problem const& problem,
                        relation_contraction_options const& options, double below = 0.5)
        : runs_(&runs),
          equations_(problem, options),
          observers_([&problem, go_on = options.keep_going] {
              return observer_contraction(problem, {.keep_going = go_on, .rounds = 6});
          }),
          asks_(!problem.model.has_memory()),
          below_(below),
          early_(asks_) {}

    [[nodiscard]] assessment<knowledge> operator()(box const& x,
                                                   std::shared_ptr<knowledge const> const& known) {
        auto result = judge(x, known);
        return result.blind ? std::move(learn({x})[0]) : result;
    }
    [[nodiscard]] assessment<knowledge> judge(box const& x,
                                              std::shared_ptr<knowledge const> const& known) const {
        return runs_->judge(x, known);
    }
    [[nodiscard]] std::vector<assessment<knowledge>> learn(std::vector<box> const& boxes) {
        auto results = runs_->learn(boxes);
        bool early = false;
        for (std::size_t k = 0; k < boxes.size(); ++k) {
            auto& found = results[k];
            if (!asks_ || found.verdict != box_verdict::undecided ||
                (found.knowledge && !(feasibility_test::reached(found) < below_)))
                continue;
            early = true;
            found.proof.clear();
            auto const seen = (*observers_.borrow())(found.rest);
            auto more = is_empty(seen) ? assessment<>{} : equations_(seen);
            if (is_empty(seen) || more.verdict == box_verdict::outside) {
                found = {.verdict = box_verdict::outside, .rest = boxes[k], .cost = found.cost};
                continue;
            }
            found.rest = std::move(more.rest);
            if (!more.smear.empty()) found.smear = std::move(more.smear);
        }
        early_ = early;
        return results;
    }
    /// One box while runs end early: what its equations say tells which side to split.
    [[nodiscard]] std::size_t at_once() const { return early_ ? 1 : runs_->at_once(); }
    [[nodiscard]] static std::size_t bytes(knowledge const& known) {
        return feasibility_test::bytes(known);
    }
    [[nodiscard]] bool cancelled() const { return runs_->cancelled(); }

private:
    feasibility_test* runs_;
    relation_test equations_;
    lending_pool<observer_contraction> observers_;
    bool asks_;
    double below_;
    std::atomic<bool> early_;
};

} // namespace sivid

#endif
