// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_MOTION_DETAIL_VERIFICATION_TYPES_HPP
#define SIVID_DECISION_MOTION_DETAIL_VERIFICATION_TYPES_HPP

#include <sivid/decision/prediction_problem.hpp>
#include <sivid/decision/requirement/robustness.hpp>

#include <functional>
#include <vector>

namespace sivid {

/// A single motion that violates a requirement, with a parameter that is proved feasible.
struct violating_motion {
    std::vector<double> parameters; ///< sides of `feasible_points::direct`
    std::vector<double> start;
    truth found;     ///< of this motion, enclosed anew
    double time = 0; ///< an instant at which the robustness is decided
};

/// Where parameters come from that are proved to be possible: what a refutation needs.
struct feasible_points {
    /// The same prediction, with the user's parameters as sides.
    prediction_problem const* direct = nullptr;
    /// Points of `direct` to be tried for a point of the problem, most promising first.
    std::function<std::vector<std::vector<double>>(std::vector<double> const&)> candidates{};
    /// Whether a point of `direct` is proved feasible; false says nothing.
    std::function<bool(std::vector<double> const&)> proved{};
};

} // namespace sivid

#endif
