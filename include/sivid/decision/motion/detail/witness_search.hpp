// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_MOTION_DETAIL_WITNESS_SEARCH_HPP
#define SIVID_DECISION_MOTION_DETAIL_WITNESS_SEARCH_HPP

#include <sivid/decision/motion/detail/idle_parts.hpp>
#include <sivid/decision/motion/detail/judged_motions.hpp>
#include <sivid/decision/motion/detail/verification_types.hpp>
#include <sivid/paving/run_options.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace sivid::decision_detail {

/// Single motions that violate a requirement, at points that are proved feasible.
class witness_search {
public:
    /// @param feasible  and `asked`: longer than the search
    witness_search(feasible_points const& feasible, requirement const& asked, run_options run,
                   work_limit limit)
        : feasible_(&feasible), asked_(&asked), run_(std::move(run)), limit_(std::move(limit)) {
        run_.keep_going = limit_;
    }

    [[nodiscard]] bool possible() const {
        return feasible_->direct != nullptr && feasible_->candidates && feasible_->proved;
    }
    [[nodiscard]] std::size_t integrations() const {
        return earlier_ + (direct_ ? direct_->cover().integrations() : 0);
    }

    /// Tries the points where the bounds of a part suggest a violation, each once on one grid.
    [[nodiscard]] std::optional<violating_motion>
    operator()(judged_motions& motions, motion_cover::part const& part, truth const& found) {
        if (!possible()) return std::nullopt;
        auto const points = motions.suspicious_points(part, found);
        follow(motions.cover().times());
        auto& cover = direct_->cover();
        struct single {
            motion_cover::part motion;
            std::vector<std::vector<double>> parameters; ///< that have this motion
        };
        std::vector<single> singles;
        std::map<std::vector<double>, std::size_t> place; // of motions that differ
        for (auto const& [start, parameters] : points) {
            for (auto const& candidate : feasible_->candidates(parameters)) {
                auto const own = mid(point_within(around_, candidate));
                auto key = own;
                key.insert(key.end(), start.begin(), start.end());
                if (!tried_.insert(key).second) continue;
                for (std::size_t j = 0; j < own.size(); ++j) {
                    if (slim_->idle[j]) key[j] = 0;
                }
                auto const [at, fresh] = place.emplace(std::move(key), singles.size());
                if (fresh) singles.push_back({cover.point(start, own), {}});
                singles[at->second].parameters.push_back(own);
            }
        }
        for (std::size_t first = 0; first < singles.size() && limit_(); first += cover.at_once()) {
            auto const last = std::min(first + cover.at_once(), singles.size());
            std::vector<motion_cover::part*> some;
            for (auto k = first; k < last; ++k) some.push_back(&singles[k].motion);
            cover.learn(some);
            for (auto k = first; k < last; ++k) {
                auto const says = direct_->judge(singles[k].motion);
                if (!says.found.refuted()) continue;
                for (auto const& parameters : singles[k].parameters) {
                    if (!feasible_->proved(parameters)) continue;
                    auto const segment = says.found.high_from.segment;
                    return violating_motion{parameters, mid(singles[k].motion.initial), says.found,
                                            cover.times()[segment / 2]};
                }
            }
        }
        return std::nullopt;
    }

private:
    void follow(std::vector<double> const& times) {
        if (!slim_) {
            slim_ = std::make_unique<without_idle_parts>(*feasible_->direct, *asked_);
            around_ = feasible_->direct->around();
        }
        if (direct_ && direct_->cover().times() == times) return;
        earlier_ = integrations();
        direct_ = std::make_unique<judged_motions>(slim_->problem, slim_->what, times, run_);
        tried_.clear();
    }

    feasible_points const* feasible_;
    requirement const* asked_;
    run_options run_;
    work_limit limit_;
    std::unique_ptr<without_idle_parts> slim_;
    std::unique_ptr<judged_motions> direct_;
    box around_;
    std::set<std::vector<double>> tried_;
    std::size_t earlier_ = 0;
};

} // namespace sivid::decision_detail

#endif
