// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_MOTION_DETAIL_HEARD_DATA_HPP
#define SIVID_DECISION_MOTION_DETAIL_HEARD_DATA_HPP

#include <sivid/decision/motion/detail/idle_parts.hpp>
#include <sivid/decision/motion/detail/motion_cover.hpp>
#include <sivid/paving/contract/detail/lp_contractor.hpp>
#include <sivid/space/box.hpp>
#include <sivid/work_limit.hpp>

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace sivid::decision_detail {

/// What the measurements say of parts of a prediction; they get at most half of the time.
class heard_data {
public:
    /// @param around      all sets, idle sides as they are
    /// @param unmeasured  sides of which no measurement tells, such as gains
    heard_data(without_idle_parts const& slim, box around, work_limit limit,
               std::vector<std::size_t> const& unmeasured = {})
        : slim_(&slim),
          around_(std::move(around)),
          limit_(std::move(limit)),
          unmeasured_(around_.size(), false) {
        for (auto const side : unmeasured) unmeasured_[side] = true;
    }

    /// Whether they refute all parameters of a part; false says nothing.
    [[nodiscard]] bool refute(motion_cover::part const& p) {
        auto const& problem = slim_->problem;
        if (!problem.measured || !limit_() || 2 * heard_ > clock_.spent()) return false;
        auto all = p.parameters;
        for (std::size_t j = 0; j < all.size(); ++j) {
            if (slim_->idle[j] || unmeasured_[j]) all[j] = around_[j];
        }
        auto key = ends_of(all);
        auto const said = said_.find(key);
        if (said != said_.end()) return said->second;
        work_watch const asking;
        auto const data = problem.measured(all, limit_);
        bool const refuted = !data.known.empty() && !lp_contractor()(data.known, all);
        heard_ += asking.spent();
        if (limit_()) said_.emplace(std::move(key), refuted);
        return refuted;
    }

private:
    without_idle_parts const* slim_;
    box around_;
    work_limit limit_;
    std::vector<bool> unmeasured_;
    std::map<std::vector<double>, bool> said_;
    work_watch clock_;
    double heard_ = 0; ///< of the work since
};

} // namespace sivid::decision_detail

#endif
