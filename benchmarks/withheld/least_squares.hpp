// SPDX-License-Identifier: MIT
// Levenberg-Marquardt within bounds, for a handful of variables that live in [0, 1].
#ifndef WITHHELD_LEAST_SQUARES_HPP
#define WITHHELD_LEAST_SQUARES_HPP

#include <functional>
#include <vector>

namespace withheld {

/// J^T J, J^T z and the objective z^T z.
struct normal_equations {
    std::vector<std::vector<double>> matrix;
    std::vector<double> gradient;
    double objective = 0;
};

struct least_squares_problem {
    std::function<double(std::vector<double> const&)> objective;
    std::function<normal_equations(std::vector<double> const&)> linearised;
};

/// Moves `x` to a local minimum in the unit box; returns the objective there.
double minimise(least_squares_problem const& problem, std::vector<double>& x, int iterations);

/// Solves a x = b for a symmetric positive definite a (Cholesky), b to x; false when it is not.
bool solve(std::vector<std::vector<double>> a, std::vector<double>& b);

} // namespace withheld

#endif
