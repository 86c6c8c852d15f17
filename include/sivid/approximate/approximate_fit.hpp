// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_APPROXIMATE_FIT_HPP
#define SIVID_APPROXIMATE_APPROXIMATE_FIT_HPP

#include <limits>
#include <vector>

namespace sivid {

/// A guess of parameters and initial states that explain the data. Nothing here is proved: a guess
/// becomes a witness only by a validated run.
struct approximate_fit {
    std::vector<double> parameters;
    std::vector<std::vector<double>> starts; ///< one initial state per experiment
    /// Per experiment and measurement (in order of time): (output - measured) / half-width of the
    /// bound.
    std::vector<std::vector<double>> residuals;
    /// Largest over the experiments of the (q+1)-th largest |residual|: at most 1 when all is
    /// explained.
    double inflation = std::numeric_limits<double>::infinity();
    /// Least sum of squared residuals on the way, without the q largest of each experiment.
    double squares = std::numeric_limits<double>::infinity();
};

} // namespace sivid

#endif
