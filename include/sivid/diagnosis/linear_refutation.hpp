// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_LINEAR_REFUTATION_HPP
#define SIVID_DIAGNOSIS_LINEAR_REFUTATION_HPP

#include <sivid/number/interval_traits.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// Inequalities \f$ A z \le b \f$ on unknowns \f$ z \in [0, 1]^n \f$, whose entries are doubles and
/// mean their exact values, with a weight \f$ s_i \ge 0 \f$ each: what it would take to call the
/// inequality violated by one unit (0: it must hold).
class linear_system {
public:
    explicit linear_system(std::size_t unknowns) : unknowns_(unknowns) {}

    void add(std::vector<double> const& row, double bound, double weight) {
        entries_.insert(entries_.end(), row.begin(), row.end());
        bounds_.push_back(bound);
        weights_.push_back(weight);
    }
    [[nodiscard]] std::size_t unknowns() const { return unknowns_; }
    [[nodiscard]] std::size_t size() const { return bounds_.size(); }
    [[nodiscard]] double const* row(std::size_t i) const { return entries_.data() + i * unknowns_; }
    [[nodiscard]] double bound(std::size_t i) const { return bounds_[i]; }
    [[nodiscard]] double weight(std::size_t i) const { return weights_[i]; }

private:
    std::size_t unknowns_;
    std::vector<double> entries_, bounds_, weights_;
};

/// Non-negative multipliers of some inequalities.
struct refutation {
    std::vector<std::pair<std::size_t, double>> multipliers; ///< (inequality, multiplier)
};

/// Proves that no \f$ z \in [0, 1]^n \f$ fulfils the inequalities, by Farkas' lemma on a box: with
/// \f$ y \ge 0 \f$, \f$ \min_z y^T A z = \sum_j \min(0, (y^T A)_j) \f$ must not exceed
/// \f$ y^T b \f$.
/// @returns a proved lower bound of the margin
///   \f$ (\sum_j \min(0, (y^T A)_j) - y^T b) / y^T s \f$: even with all bounds relaxed by so many
///   weights nothing is left. The system is refuted if it is positive; at most 0 or -infinity
///   proves nothing.
/// @cost  one interval product for each entry
[[nodiscard]] inline double proved_margin(linear_system const& system, refutation const& y) {
    using traits = interval_traits<interval>;
    std::vector<interval> sum(system.unknowns(), traits::point(0.0));
    auto right = traits::point(0.0);
    auto weight = traits::point(0.0);
    for (auto const& [i, factor] : y.multipliers) {
        if (i >= system.size() || !(factor >= 0) || !std::isfinite(factor)) return -HUGE_VAL;
        auto const times = [&, f = factor](double v) {
            return traits::mul(traits::point(f), traits::point(v));
        };
        for (std::size_t j = 0; j < sum.size(); ++j) {
            sum[j] = traits::add(sum[j], times(system.row(i)[j]));
        }
        right = traits::add(right, times(system.bound(i)));
        weight = traits::add(weight, times(system.weight(i)));
    }
    auto least = traits::neg(right);
    for (auto const& c : sum) least = traits::add(least, traits::min(c, traits::point(0.0)));
    double const gap = least.lower();
    if (!(gap > 0)) return gap <= 0 ? std::min(gap, 0.0) : -HUGE_VAL;
    if (!(weight.upper() > 0)) return HUGE_VAL; // refuted without any that could be relaxed
    bool undefined = false;
    return traits::div(traits::point(gap), traits::point(weight.upper()), undefined).lower();
}

/// The least common relaxation t with \f$ A z \le b + t s \f$ for some \f$ z \in [0, 1]^n \f$, and
/// the multipliers that show it is needed, in plain floating point: nothing here is a proof.
struct approximate_relaxation {
    double t = -HUGE_VAL;
    std::vector<double> z;
    refutation multipliers; ///< at most n + 1 inequalities
};

namespace diagnosis_detail {

/// A small dense matrix in plain floating point, row by row.
struct small_matrix {
    std::size_t n = 0;
    std::vector<double> entries;

    explicit small_matrix(std::size_t size) : n(size), entries(size * size, 0.0) {}
    double& operator()(std::size_t i, std::size_t j) { return entries[i * n + j]; }
    double operator()(std::size_t i, std::size_t j) const { return entries[i * n + j]; }

    [[nodiscard]] std::vector<double> times(std::vector<double> const& x) const {
        std::vector<double> result(n, 0.0);
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = 0; j < n; ++j) result[i] += (*this)(i, j) * x[j];
        }
        return result;
    }
    [[nodiscard]] std::vector<double> transposed_times(std::vector<double> const& x) const {
        std::vector<double> result(n, 0.0);
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = 0; j < n; ++j) result[j] += (*this)(i, j) * x[i];
        }
        return result;
    }
};

/// Gauss-Jordan elimination with row pivots; nothing if the matrix is singular in floating point.
inline std::optional<small_matrix> inverse(small_matrix a) {
    auto const n = a.n;
    small_matrix result(n);
    for (std::size_t i = 0; i < n; ++i) result(i, i) = 1;
    for (std::size_t k = 0; k < n; ++k) {
        std::size_t best = k;
        for (std::size_t i = k + 1; i < n; ++i) {
            if (std::abs(a(i, k)) > std::abs(a(best, k))) best = i;
        }
        if (!(std::abs(a(best, k)) > 0)) return std::nullopt;
        for (std::size_t j = 0; j < n; ++j) {
            std::swap(a(k, j), a(best, j));
            std::swap(result(k, j), result(best, j));
        }
        double const pivot = a(k, k);
        for (std::size_t j = 0; j < n; ++j) {
            a(k, j) /= pivot;
            result(k, j) /= pivot;
        }
        for (std::size_t i = 0; i < n; ++i) {
            double const factor = a(i, k);
            if (i == k || factor == 0) continue;
            for (std::size_t j = 0; j < n; ++j) {
                a(i, j) -= factor * a(k, j);
                result(i, j) -= factor * result(k, j);
            }
        }
    }
    auto const finite = [](double v) { return std::isfinite(v); };
    if (!std::all_of(result.entries.begin(), result.entries.end(), finite)) return std::nullopt;
    return result;
}

} // namespace diagnosis_detail

/// Solves min t by the simplex method on the dual
/// \f$ \min b^T y + 1^T \mu : A^T y + \mu - \nu = 0, s^T y = 1, y, \mu, \nu \ge 0 \f$, which has
/// n + 1 rows only; a basis is at hand: one inequality and a bound of each unknown. Whatever basis
/// it stops at gives multipliers for `proved_margin`.
/// @cost  O(n size) for each of some tens of pivots; n is expected to be small
[[nodiscard]] inline approximate_relaxation least_relaxation(linear_system const& system,
                                                             std::size_t most_pivots = 500) {
    auto const n = system.unknowns();
    auto const rows = system.size();
    approximate_relaxation result;
    std::size_t first = rows;
    for (std::size_t i = 0; i < rows && first == rows; ++i) {
        if (system.weight(i) > 0) first = i;
    }
    if (first == rows) return result;

    // Columns: inequalities, then the lower and the upper bound of each unknown.
    auto const column = [&](std::size_t k) {
        std::vector<double> c(n + 1, 0.0);
        if (k < rows) {
            std::copy(system.row(k), system.row(k) + n, c.begin());
            c[n] = system.weight(k);
        } else {
            c[(k - rows) % n] = k - rows < n ? -1 : 1;
        }
        return c;
    };
    auto const cost = [&](std::size_t k) {
        return k < rows ? system.bound(k) : k - rows < n ? 0.0 : 1.0;
    };
    // Right-hand sides a little off zero, each by its own, so that no pivot is degenerate (which
    // could go in circles).
    std::vector<double> target(n + 1, 1.0);
    for (std::size_t j = 0; j < n; ++j) target[j] = 1e-10 * static_cast<double>(j + 1);
    std::vector<std::size_t> basis{first};
    for (std::size_t j = 0; j < n; ++j) {
        bool const above = system.row(first)[j] / system.weight(first) > target[j];
        basis.push_back(rows + (above ? j : n + j));
    }
    for (std::size_t pivot = 0; pivot < most_pivots; ++pivot) {
        diagnosis_detail::small_matrix b(n + 1);
        std::vector<double> costs(n + 1);
        for (std::size_t k = 0; k <= n; ++k) {
            auto const c = column(basis[k]);
            for (std::size_t i = 0; i <= n; ++i) b(i, k) = c[i];
            costs[k] = cost(basis[k]);
        }
        auto const solver = diagnosis_detail::inverse(b);
        if (!solver) break;
        auto const y = solver->times(target);
        auto const pi = solver->transposed_times(costs); // (z, -t)
        result.t = -pi[n];
        result.z.assign(pi.begin(), pi.end() - 1);
        result.multipliers.multipliers.clear();
        for (std::size_t k = 0; k <= n; ++k) {
            if (basis[k] < rows && y[k] > 0) {
                result.multipliers.multipliers.emplace_back(basis[k], y[k]);
            }
        }
        // Entering: the inequality that the current z, t violates most, in its own weight.
        double most = 1e-9;
        std::size_t entering = rows + 2 * n;
        for (std::size_t i = 0; i < rows; ++i) {
            double const* const a = system.row(i);
            double const w = system.weight(i);
            double violation = pi[n] * w - system.bound(i);
            for (std::size_t j = 0; j < n; ++j) violation += a[j] * pi[j];
            if (w > 0) violation /= w;
            if (violation > most) most = violation, entering = i;
        }
        for (std::size_t j = 0; j < n; ++j) {
            if (-pi[j] > most) most = -pi[j], entering = rows + j;
            if (pi[j] - 1 > most) most = pi[j] - 1, entering = rows + n + j;
        }
        if (entering == rows + 2 * n) break;
        auto const direction = solver->times(column(entering));
        double step = HUGE_VAL;
        std::size_t leaving = n + 1;
        for (std::size_t k = 0; k <= n; ++k) {
            if (direction[k] <= 1e-12) continue;
            double const ratio = std::max(y[k], 0.0) / direction[k];
            if (ratio < step) step = ratio, leaving = k;
        }
        if (leaving > n) break;
        basis[leaving] = entering;
    }
    for (auto& z : result.z) z = std::clamp(z, 0.0, 1.0);
    return result;
}

} // namespace sivid

#endif
