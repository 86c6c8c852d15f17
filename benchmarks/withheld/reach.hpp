// SPDX-License-Identifier: MIT
// How far a parameter may move while all else makes up for it: what the data allow, whoever looks.
#ifndef WITHHELD_REACH_HPP
#define WITHHELD_REACH_HPP

#include "fit.hpp"

#include <optional>
#include <vector>

namespace withheld {

/// The least and the greatest value of variable `which` (in [0, 1], as `x`) that points which
/// explain the data have been found at. From `x`, which explains them, linear programs about a
/// simulation go to either end, each about the last one's answer. What is returned is attained:
/// the data allow at least as much.
struct reached {
    double lower = 0, upper = 0;
    std::vector<std::vector<double>> ends; ///< points that attain them, about
};
reached reach(fit_problem const& problem, std::vector<double> const& x, std::size_t which);

/// The same for the inflation of the held-out data, from their middle starts: points at which the
/// held-out samples that may be moved farthest miss their bounds as much as was found.
/// @returns  `x` first
std::vector<std::vector<double>> worst_held_out(fit_problem const& problem,
                                                std::vector<double> const& x);

/// The move d with the largest sum of `aim` d such that |misfit + slope d| <= 1 and x + d in the
/// unit box, |d| <= `radius`, by an interior-point method; nothing when there is none, or it is not
/// found.
std::optional<std::vector<double>> farthest(fit_problem::linear_model const& model,
                                            std::vector<double> const& x,
                                            std::vector<double> const& aim, double radius = 1);

} // namespace withheld

#endif
