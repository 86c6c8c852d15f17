// SPDX-License-Identifier: MIT
#include "reach.hpp"

#include <algorithm>
#include <cmath>

namespace withheld {

namespace {

/// a d <= b, row by row.
struct half_spaces {
    std::vector<std::vector<double>> a;
    std::vector<double> b;
};

half_spaces around(fit_problem::linear_model const& model, std::vector<double> const& x,
                   double radius) {
    half_spaces h;
    std::size_t const n = x.size();
    std::vector<double> row(n);
    for (std::size_t m = 0; m < model.misfit.size(); ++m)
        for (double const side : {1.0, -1.0}) {
            for (std::size_t i = 0; i < n; ++i) row[i] = side * model.slope[i][m];
            h.a.push_back(row);
            h.b.push_back(1 - side * model.misfit[m]);
        }
    for (std::size_t i = 0; i < n; ++i)
        for (double const side : {1.0, -1.0}) {
            row.assign(n, 0);
            row[i] = side;
            h.a.push_back(row);
            h.b.push_back(std::min(radius, side > 0 ? 1 - x[i] : x[i]));
        }
    return h;
}

/// The largest share of `step` that keeps `value` positive.
double share(std::vector<double> const& value, std::vector<double> const& step) {
    double most = 1;
    for (std::size_t k = 0; k < value.size(); ++k)
        if (step[k] < 0) most = std::min(most, -0.95 * value[k] / step[k]);
    return most;
}

} // namespace

std::optional<std::vector<double>> farthest(fit_problem::linear_model const& model,
                                            std::vector<double> const& x, std::size_t which,
                                            double sign, double radius) {
    auto const [a, b] = around(model, x, radius);
    std::size_t const n = x.size(), rows = b.size();
    std::vector<double> d(n, 0), slack(rows), dual(rows, 1);
    for (std::size_t k = 0; k < rows; ++k) slack[k] = std::max(b[k], 0.1);
    std::vector<double> ds(rows), dy(rows), missed(rows);
    for (int round = 0; round < 100; ++round) {
        // a d + slack = b, a' dual = c, slack dual = mu: Newton's step, reduced to d.
        double gap = 0, worst = 0;
        for (std::size_t k = 0; k < rows; ++k) {
            double sum = slack[k] - b[k];
            for (std::size_t i = 0; i < n; ++i) sum += a[k][i] * d[i];
            missed[k] = sum;
            worst = std::max(worst, std::abs(sum));
            gap += slack[k] * dual[k];
        }
        std::vector<double> c(n, 0);
        c[which] = sign;
        double dual_worst = 0;
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t k = 0; k < rows; ++k) c[i] -= a[k][i] * dual[k];
            dual_worst = std::max(dual_worst, std::abs(c[i]));
        }
        if (gap < 1e-7 && worst < 1e-7 && dual_worst < 1e-6) return d;
        double const mu = 0.1 * gap / static_cast<double>(rows);
        std::vector<std::vector<double>> normal(n, std::vector<double>(n, 0));
        std::vector<double> right = c;
        for (std::size_t k = 0; k < rows; ++k) {
            double const weight = dual[k] / slack[k];
            // dy = (mu + dual missed - slack dual + dual a dd) / slack
            double const fixed = (mu + dual[k] * missed[k]) / slack[k] - dual[k];
            for (std::size_t i = 0; i < n; ++i) {
                if (a[k][i] == 0) continue;
                right[i] -= a[k][i] * fixed;
                for (std::size_t j = 0; j <= i; ++j) normal[i][j] += weight * a[k][i] * a[k][j];
            }
        }
        for (std::size_t i = 0; i < n; ++i) {
            normal[i][i] += 1e-12 * (1 + normal[i][i]);
            for (std::size_t j = i + 1; j < n; ++j) normal[i][j] = normal[j][i];
        }
        auto dd = right;
        if (!solve(normal, dd)) return std::nullopt;
        for (std::size_t k = 0; k < rows; ++k) {
            double along = 0;
            for (std::size_t i = 0; i < n; ++i) along += a[k][i] * dd[i];
            ds[k] = -missed[k] - along;
            dy[k] = (mu - dual[k] * ds[k]) / slack[k] - dual[k];
        }
        double const primal = share(slack, ds), other = share(dual, dy);
        for (std::size_t i = 0; i < n; ++i) d[i] += primal * dd[i];
        for (std::size_t k = 0; k < rows; ++k) {
            slack[k] += primal * ds[k];
            dual[k] += other * dy[k];
        }
    }
    return std::nullopt;
}

reached reach(fit_problem const& problem, std::vector<double> const& x, std::size_t which) {
    constexpr double limit = 1 + 1e-3; // in bounds: the simulation's own error
    reached r{x[which], x[which], {}};
    for (double const sign : {1.0, -1.0}) {
        auto best = x;
        double radius = 0.1;
        for (int round = 0; round < 24 && radius > 1e-4; ++round) {
            // Products of parameters are no lines: what misses the bounds is corrected by shorter
            // moves.
            auto at = best;
            bool explains = false;
            double within = radius;
            for (int correction = 0; correction < 4 && !explains; ++correction, within /= 8) {
                auto const move = farthest(problem.linear(at), at, which, sign, within);
                if (!move) break;
                for (std::size_t i = 0; i < at.size(); ++i)
                    at[i] = std::clamp(at[i] + (*move)[i], 0.0, 1.0);
                explains = problem.inflation(at) <= limit;
            }
            double const gain = explains ? sign * (at[which] - best[which]) : 0;
            if (gain > 0) best = at;
            r.lower = std::min(r.lower, best[which]);
            r.upper = std::max(r.upper, best[which]);
            if (gain > 0.01 * (r.upper - r.lower))
                radius *= 2;
            else
                radius /= 4;
        }
        r.ends.push_back(std::move(best));
    }
    return r;
}

} // namespace withheld
