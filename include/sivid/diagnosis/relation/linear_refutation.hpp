// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_RELATION_LINEAR_REFUTATION_HPP
#define SIVID_DIAGNOSIS_RELATION_LINEAR_REFUTATION_HPP

#include <sivid/number/interval_traits.hpp>
#include <sivid/space/linear_program/dual_simplex.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
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

/// Solves min t by `dual_simplex` in (z, t); a basis is at hand: one inequality and a bound of each
/// unknown. Whatever basis it stops at gives multipliers for `proved_margin`.
/// @cost  O(n size) for each of some tens of exchanges; n is expected to be small
[[nodiscard]] inline approximate_relaxation least_relaxation(linear_system const& system,
                                                             std::size_t most_exchanges = 500) {
    auto const n = system.unknowns();
    auto const rows = system.size();
    approximate_relaxation result;
    std::size_t first = 0;
    while (first < rows && !(system.weight(first) > 0)) ++first;
    if (first == rows) return result;
    // Names: inequalities, then the lower and the upper bound of each unknown.
    auto const write = [&](std::size_t k, half_space& to) {
        to.name = k;
        to.normal.assign(n + 1, 0.0);
        if (k < rows) {
            std::copy(system.row(k), system.row(k) + n, to.normal.begin());
            to.normal[n] = -system.weight(k);
            to.reach = system.bound(k);
        } else {
            bool const lower = k - rows < n;
            to.normal[(k - rows) % n] = lower ? -1 : 1;
            to.reach = lower ? 0 : 1;
        }
    };
    std::vector<half_space> basis(n + 1);
    write(first, basis[n]);
    for (std::size_t j = 0; j < n; ++j) {
        write(rows + (basis[n].normal[j] > 0 ? j : n + j), basis[j]);
    }
    std::vector<double> goal(n + 1, 0.0);
    goal[n] = -1;
    dual_simplex program;
    if (!program.start(std::move(goal), std::move(basis))) return result;
    // The inequality that is violated most, in its own weight.
    auto const worst = [&](std::vector<double> const& x, half_space& enters) {
        double most = 1e-9;
        std::size_t entering = rows + 2 * n;
        for (std::size_t i = 0; i < rows; ++i) {
            double const* const a = system.row(i);
            double const w = system.weight(i);
            double violation = -x[n] * w - system.bound(i);
            for (std::size_t j = 0; j < n; ++j) violation += a[j] * x[j];
            if (w > 0) violation /= w;
            if (violation > most) most = violation, entering = i;
        }
        for (std::size_t j = 0; j < n; ++j) {
            if (-x[j] > most) most = -x[j], entering = rows + j;
            if (x[j] - 1 > most) most = x[j] - 1, entering = rows + n + j;
        }
        if (entering == rows + 2 * n) return false;
        write(entering, enters);
        return true;
    };
    auto const how = program.run(worst, most_exchanges);
    for (auto const& [k, size] : program.combination()) {
        if (k < rows) result.multipliers.multipliers.emplace_back(k, size);
    }
    result.t = how == dual_simplex::outcome::empty ? HUGE_VAL : -program.value();
    result.z.assign(program.point().begin(), program.point().end() - 1);
    for (auto& z : result.z) z = std::clamp(z, 0.0, 1.0);
    return result;
}

} // namespace sivid

#endif
