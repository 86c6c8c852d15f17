// SPDX-License-Identifier: MIT
#include "least_squares.hpp"

#include <algorithm>
#include <cmath>

namespace withheld {

bool solve(std::vector<std::vector<double>> a, std::vector<double>& b) {
    std::size_t const n = b.size();
    for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t k = 0; k < j; ++k) a[j][j] -= a[j][k] * a[j][k];
        if (!(a[j][j] > 0)) return false;
        a[j][j] = std::sqrt(a[j][j]);
        for (std::size_t i = j + 1; i < n; ++i) {
            for (std::size_t k = 0; k < j; ++k) a[i][j] -= a[i][k] * a[j][k];
            a[i][j] /= a[j][j];
        }
    }
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < i; ++k) b[i] -= a[i][k] * b[k];
        b[i] /= a[i][i];
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t k = i + 1; k < n; ++k) b[i] -= a[k][i] * b[k];
        b[i] /= a[i][i];
    }
    return true;
}

namespace {

/// The damped step; variables that would leave the box through a side they stand on are held.
std::vector<double> damped_step(normal_equations const& eq, std::vector<double> const& x,
                                double damping) {
    std::size_t const n = x.size();
    std::vector<std::size_t> free;
    for (std::size_t i = 0; i < n; ++i) {
        bool const held = (x[i] <= 0 && eq.gradient[i] > 0) || (x[i] >= 1 && eq.gradient[i] < 0);
        if (!held) free.push_back(i);
    }
    std::vector<std::vector<double>> a(free.size(), std::vector<double>(free.size()));
    std::vector<double> b(free.size());
    for (std::size_t i = 0; i < free.size(); ++i) {
        for (std::size_t j = 0; j < free.size(); ++j) a[i][j] = eq.matrix[free[i]][free[j]];
        a[i][i] += damping * a[i][i] + 1e-9 * (1 + a[i][i]);
        b[i] = -eq.gradient[free[i]];
    }
    std::vector<double> to = x;
    if (!solve(a, b)) return to;
    for (std::size_t i = 0; i < free.size(); ++i)
        to[free[i]] = std::clamp(x[free[i]] + b[i], 0.0, 1.0);
    return to;
}

} // namespace

double minimise(least_squares_problem const& problem, std::vector<double>& x, int iterations) {
    double damping = 1e-3;
    double best = problem.objective(x);
    for (int i = 0; i < iterations; ++i) {
        auto const eq = problem.linearised(x);
        double const before = best;
        bool moved = false;
        for (int attempt = 0; attempt < 6 && !moved; ++attempt) {
            auto const trial = damped_step(eq, x, damping);
            double const value = problem.objective(trial);
            if (value < best) {
                best = value;
                x = trial;
                damping = std::max(damping / 5, 1e-7);
                moved = true;
            } else {
                damping *= 8;
            }
        }
        if (!moved || before - best < 1e-4 * before) break;
    }
    return best;
}

} // namespace withheld
