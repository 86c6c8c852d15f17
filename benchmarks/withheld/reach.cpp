// SPDX-License-Identifier: MIT
#include "reach.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

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
                                            std::vector<double> const& x,
                                            std::vector<double> const& aim, double radius) {
    auto const [a, b] = around(model, x, radius);
    // Tolerances below are for an aim of size 1.
    double size = 0;
    for (double const c : aim) size = std::max(size, std::abs(c));
    if (!(size > 0)) return std::vector<double>(x.size(), 0);
    auto goal = aim;
    for (auto& c : goal) c /= size;
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
        auto c = goal;
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

namespace {

/// What is to grow, as far as the data allow.
struct aim {
    std::function<double(std::vector<double> const&)> value;
    std::function<std::vector<double>(std::vector<double> const&)> slope;
};

/// The model whose misfits are in units of a share of their bounds.
fit_problem::linear_model within_bounds(fit_problem::linear_model model, double share) {
    for (auto& z : model.misfit) z /= share;
    for (auto& by : model.slope)
        for (auto& slope : by) slope /= share;
    return model;
}

/// A point that explains the data, at which `what` is as large as was found.
std::vector<double> pushed(fit_problem const& problem, std::vector<double> best, aim const& what) {
    constexpr double limit = 1 - 1e-6; // in bounds; linear programs ask for some more
    double const from = what.value(best);
    double value = from, radius = 0.1;
    for (int round = 0; round < 24 && radius > 1e-4; ++round) {
        // Products of parameters are no lines: what misses the bounds is corrected by moves that
        // keep away from these, as far as they can, and by shorter ones.
        auto at = best;
        bool explains = false;
        double within = radius;
        for (double const share : {1 - 1e-5, 0.99, 0.999, 0.9999, 1 - 1e-5}) {
            auto const move =
                farthest(within_bounds(problem.linear(at), share), at, what.slope(at), within);
            within /= 3;
            if (!move) continue;
            for (std::size_t i = 0; i < at.size(); ++i)
                at[i] = std::clamp(at[i] + (*move)[i], 0.0, 1.0);
            explains = problem.inflation(at) <= limit;
            if (explains) break;
        }
        double const gain = explains ? what.value(at) - value : 0;
        if (gain > 0) {
            best = at;
            value += gain;
        }
        if (gain > 0.01 * (value - from))
            radius *= 2;
        else
            radius /= 4;
    }
    return best;
}

/// Held-out sample `m` above its middle (`sign` -1: below).
aim misfit_of(fit_problem const& problem, std::size_t m, double sign) {
    return {[&problem, m, sign](std::vector<double> const& x) {
                return sign * problem.misfits(x, true)[m];
            },
            [&problem, m, sign](std::vector<double> const& x) {
                auto const model = problem.linear(x, true);
                std::vector<double> slope;
                for (auto const& by : model.slope) slope.push_back(sign * by[m]);
                return slope;
            }};
}

} // namespace

reached reach(fit_problem const& problem, std::vector<double> const& x, std::size_t which) {
    reached r{x[which], x[which], {}};
    for (double const sign : {1.0, -1.0}) {
        auto end =
            pushed(problem, x,
                   {[which, sign](std::vector<double> const& at) { return sign * at[which]; },
                    [which, sign](std::vector<double> const& at) {
                        std::vector<double> slope(at.size(), 0);
                        slope[which] = sign;
                        return slope;
                    }});
        r.lower = std::min(r.lower, end[which]);
        r.upper = std::max(r.upper, end[which]);
        r.ends.push_back(std::move(end));
    }
    return r;
}

std::vector<std::vector<double>> worst_held_out(fit_problem const& problem,
                                                std::vector<double> const& x) {
    constexpr std::size_t pushes = 3;
    std::vector<std::vector<double>> found{x};
    auto const fit = problem.linear(x), own = problem.linear(x, true);
    std::size_t const n = x.size();
    // How far a sample moves where those of the fit move by one bound in the mean, by their normal
    // equations; the linear program of the first one says how far that is.
    std::vector<std::vector<double>> normal(n, std::vector<double>(n, 0));
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j)
            for (std::size_t m = 0; m < fit.misfit.size(); ++m)
                normal[i][j] += fit.slope[i][m] * fit.slope[j][m];
        normal[i][i] += 1e-6;
    }
    std::vector<double> moves(own.misfit.size(), 0);
    std::vector<double> row(n);
    for (std::size_t m = 0; m < moves.size(); ++m) {
        for (std::size_t i = 0; i < n; ++i) row[i] = own.slope[i][m];
        auto matrix = normal;
        auto along = row;
        if (!solve(matrix, along)) return found;
        for (std::size_t i = 0; i < n; ++i) moves[m] += row[i] * along[i];
        moves[m] = std::sqrt(std::max(moves[m], 0.0));
    }
    if (moves.empty()) return found;
    auto const first =
        static_cast<std::size_t>(std::max_element(moves.begin(), moves.end()) - moves.begin());
    for (std::size_t i = 0; i < n; ++i) row[i] = own.slope[i][first];
    auto const move = farthest(fit, x, row);
    if (!move || moves[first] == 0) return found;
    double far = 0;
    for (std::size_t i = 0; i < n; ++i) far += row[i] * (*move)[i];
    std::vector<std::size_t> order(moves.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    auto const likely = [&](std::size_t m) {
        return std::abs(own.misfit[m]) + far / moves[first] * moves[m];
    };
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return likely(a) > likely(b); });
    for (std::size_t k = 0; k < std::min(pushes, order.size()); ++k) {
        auto const m = order[k];
        found.push_back(pushed(problem, x, misfit_of(problem, m, own.misfit[m] < 0 ? -1 : 1)));
    }
    return found;
}

} // namespace withheld
