// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STRATEGY_DETAIL_AIDED_TEST_HPP
#define SIVID_PAVING_STRATEGY_DETAIL_AIDED_TEST_HPP

#include <sivid/model/problem.hpp>
#include <sivid/paving/judge/feasibility_test.hpp>
#include <sivid/paving/set_test.hpp>
#include <sivid/paving/strategy/contractor.hpp>
#include <sivid/paving/strategy/strategy.hpp>
#include <sivid/space/box.hpp>

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace sivid::paving_detail {

/// `feasibility_test`, and where its runs end before they could tell the contractors of a strategy
/// that are for parts: together they search a prior over which no trajectory is carried far.
/// @guarantee  as all of them; what contractors exclude has no certificate
class aided_test {
public:
    static constexpr bool concurrent = true;
    using knowledge = feasibility_test::knowledge;

    /// @param runs, problem  outlive this
    /// @param below  the share of the measurements that runs over a box reach, below which
    ///               contractors are asked
    aided_test(feasibility_test& runs, identification_problem const& problem, strategy const& how,
               std::function<bool()> const& keep_going, double below = 0.5)
        : runs_(&runs), below_(below) {
        // The last first: observers refute many a box before its equations are set up.
        for (auto step = how.steps.rbegin(); step != how.steps.rend(); ++step) {
            for (auto by = step->by.rbegin(); by != step->by.rend(); ++by) {
                if (!(*by)->obstacle(problem).empty()) continue;
                if (auto test = (*by)->for_parts(problem, keep_going))
                    aids_.push_back(std::move(test));
            }
        }
        early_ = !aids_.empty();
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
            if (aids_.empty() || found.verdict != box_verdict::undecided ||
                (found.knowledge && !(feasibility_test::reached(found) < below_)))
                continue;
            early = true;
            aid(found, boxes[k]);
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
    void aid(assessment<knowledge>& found, box const& whole) const {
        found.proof.clear();
        for (auto const& test : aids_) {
            auto more = test(found.rest);
            if (more.verdict == box_verdict::outside) {
                found = {.verdict = box_verdict::outside, .rest = whole, .cost = found.cost};
                return;
            }
            found.rest = std::move(more.rest);
            if (!more.smear.empty()) found.smear = std::move(more.smear);
        }
    }

    feasibility_test* runs_;
    std::vector<contractor::part_test> aids_;
    double below_;
    std::atomic<bool> early_;
};

} // namespace sivid::paving_detail

#endif
