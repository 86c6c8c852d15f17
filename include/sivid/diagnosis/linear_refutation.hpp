// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_LINEAR_REFUTATION_HPP
#define SIVID_DIAGNOSIS_LINEAR_REFUTATION_HPP

#include <sivid/number/interval_traits.hpp>
#include <sivid/space/constraint_blocks.hpp>

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>
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

    using vector = Eigen::VectorXd;
    auto const last = static_cast<Eigen::Index>(n);
    // Columns: inequalities, then the lower and the upper bound of each unknown.
    auto const column = [&](std::size_t k) {
        vector c = vector::Zero(last + 1);
        if (k < rows) {
            std::copy(system.row(k), system.row(k) + n, c.data());
            c[last] = system.weight(k);
        } else {
            c[static_cast<Eigen::Index>((k - rows) % n)] = k - rows < n ? -1 : 1;
        }
        return c;
    };
    auto const cost = [&](std::size_t k) {
        return k < rows ? system.bound(k) : k - rows < n ? 0.0 : 1.0;
    };
    // Right-hand sides a little off zero, each by its own, so that no pivot is degenerate (which
    // could go in circles).
    vector target = vector::Ones(last + 1);
    for (Eigen::Index j = 0; j < last; ++j) target[j] = 1e-10 * static_cast<double>(j + 1);
    std::vector<std::size_t> basis{first};
    for (std::size_t j = 0; j < n; ++j) {
        bool const above =
            system.row(first)[j] / system.weight(first) > target[static_cast<Eigen::Index>(j)];
        basis.push_back(rows + (above ? j : n + j));
    }
    Eigen::MatrixXd columns(last + 1, last + 1);
    vector costs(last + 1);
    Eigen::PartialPivLU<Eigen::MatrixXd> factors;
    for (std::size_t pivot = 0; pivot < most_pivots; ++pivot) {
        for (Eigen::Index k = 0; k <= last; ++k) {
            columns.col(k) = column(basis[static_cast<std::size_t>(k)]);
            costs[k] = cost(basis[static_cast<std::size_t>(k)]);
        }
        factors.compute(columns);
        vector const y = factors.solve(target);
        vector const pi = factors.transpose().solve(costs); // (z, -t)
        if (!y.allFinite() || !pi.allFinite()) break;
        result.t = -pi[last];
        result.z.assign(pi.data(), pi.data() + last);
        result.multipliers.multipliers.clear();
        for (std::size_t k = 0; k <= n; ++k) {
            double const size = y[static_cast<Eigen::Index>(k)];
            if (basis[k] < rows && size > 0) {
                result.multipliers.multipliers.emplace_back(basis[k], size);
            }
        }
        // Entering: the inequality that the current z, t violates most, in its own weight.
        double most = 1e-9;
        std::size_t entering = rows + 2 * n;
        for (std::size_t i = 0; i < rows; ++i) {
            double const* const a = system.row(i);
            double const w = system.weight(i);
            double violation = pi[last] * w - system.bound(i);
            for (std::size_t j = 0; j < n; ++j) violation += a[j] * result.z[j];
            if (w > 0) violation /= w;
            if (violation > most) most = violation, entering = i;
        }
        for (std::size_t j = 0; j < n; ++j) {
            if (-result.z[j] > most) most = -result.z[j], entering = rows + j;
            if (result.z[j] - 1 > most) most = result.z[j] - 1, entering = rows + n + j;
        }
        if (entering == rows + 2 * n) break;
        auto const leaving = leaving_member(factors.solve(column(entering)), y);
        if (leaving < 0) break;
        basis[static_cast<std::size_t>(leaving)] = entering;
    }
    for (auto& z : result.z) z = std::clamp(z, 0.0, 1.0);
    return result;
}

} // namespace sivid

#endif
