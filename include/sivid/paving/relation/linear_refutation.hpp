// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_LINEAR_REFUTATION_HPP
#define SIVID_PAVING_RELATION_LINEAR_REFUTATION_HPP

#include <sivid/number/interval_traits.hpp>
#include <sivid/number/rounding.hpp>
#include <sivid/space/linear_program/dual_simplex.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
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
    /// @given  of the same unknowns
    void add(linear_system const& more) {
        entries_.insert(entries_.end(), more.entries_.begin(), more.entries_.end());
        bounds_.insert(bounds_.end(), more.bounds_.begin(), more.bounds_.end());
        weights_.insert(weights_.end(), more.weights_.begin(), more.weights_.end());
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

namespace paving_detail {

/// \f$ \min_z (c + y^T A) z - y^T b \f$ over \f$ z \in [0, 1]^n \f$: with \f$ y \ge 0 \f$ no z
/// that fulfils the inequalities has a smaller \f$ c z \f$. Nothing where a multiplier is not one.
/// @param goal  c, or nothing for 0
[[nodiscard]] inline std::optional<interval>
least_under(linear_system const& system, refutation const& y, std::vector<double> const& goal) {
    using traits = interval_traits<interval>;
    std::vector<interval> sum(system.unknowns(), traits::point(0.0));
    for (std::size_t j = 0; j < goal.size(); ++j) sum[j] = traits::point(goal[j]);
    auto least = traits::point(0.0);
    for (auto const& [i, factor] : y.multipliers) {
        if (i >= system.size() || !(factor >= 0) || !std::isfinite(factor)) return std::nullopt;
        auto const times = [f = factor](double v) {
            return traits::mul(traits::point(f), traits::point(v));
        };
        for (std::size_t j = 0; j < sum.size(); ++j) {
            sum[j] = traits::add(sum[j], times(system.row(i)[j]));
        }
        least = traits::sub(least, times(system.bound(i)));
    }
    for (auto const& c : sum) least = traits::add(least, traits::min(c, traits::point(0.0)));
    return least;
}

} // namespace paving_detail

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
    auto const least = paving_detail::least_under(system, y, {});
    if (!least) return -HUGE_VAL;
    double const gap = least->lower();
    if (!(gap > 0)) return gap <= 0 ? std::min(gap, 0.0) : -HUGE_VAL;
    auto weight = traits::point(0.0);
    for (auto const& [i, factor] : y.multipliers) {
        weight = traits::add(weight,
                             traits::mul(traits::point(factor), traits::point(system.weight(i))));
    }
    if (!(weight.upper() > 0)) return HUGE_VAL; // refuted without any that could be relaxed
    bool undefined = false;
    return traits::div(traits::point(gap), traits::point(weight.upper()), undefined).lower();
}

namespace paving_detail {

/// The half-spaces of a program on \f$ z \in [0, 1]^n \f$ and further unknowns, by names: the
/// inequalities, then the lower and the upper bounds of z. Inequalities have the units of their
/// equations: each is written in multiples of a power of two near its size, as those of z are.
class box_half_spaces {
public:
    /// @param relaxed  with one unknown more, by which all bounds are relaxed in their weights
    box_half_spaces(linear_system const& system, bool relaxed)
        : system_(&system), relaxed_(relaxed) {
        for (std::size_t i = 0; i < system.size(); ++i) {
            double sum = 0;
            for (std::size_t j = 0; j < system.unknowns(); ++j) sum += std::abs(system.row(i)[j]);
            double const w = system.weight(i);
            scale_.push_back(relaxed ? (w > 0 ? 1 / w : 1) : (sum > 0 ? 1 / sum : 0));
            double const size = relaxed ? sum + w : sum;
            bool const any = size > 0 && std::isfinite(size);
            factor_.push_back(any ? std::ldexp(1.0, -std::ilogb(size)) : 1.0);
        }
    }
    /// By which an inequality is multiplied in the program.
    [[nodiscard]] double factor(std::size_t i) const { return factor_[i]; }
    [[nodiscard]] std::size_t unknowns() const { return system_->unknowns() + (relaxed_ ? 1 : 0); }
    [[nodiscard]] std::size_t lower_of(std::size_t j) const { return system_->size() + j; }
    [[nodiscard]] std::size_t upper_of(std::size_t j) const {
        return system_->size() + system_->unknowns() + j;
    }
    void write(std::size_t k, half_space& to) const {
        auto const n = system_->unknowns();
        to.name = k;
        to.normal.assign(unknowns(), 0.0);
        if (k < system_->size()) {
            double const f = factor_[k];
            std::transform(system_->row(k), system_->row(k) + n, to.normal.begin(),
                           [f](double a) { return f * a; });
            if (relaxed_) to.normal[n] = -f * system_->weight(k);
            to.reach = f * system_->bound(k);
        } else {
            bool const lower = k < upper_of(0);
            to.normal[(k - system_->size()) % n] = lower ? -1 : 1;
            to.reach = lower ? 0 : 1;
        }
    }
    /// The one that x violates most, for its size.
    bool operator()(std::vector<double> const& x, half_space& enters) const {
        auto const n = system_->unknowns();
        double most = 1e-9;
        constexpr auto none = std::numeric_limits<std::size_t>::max();
        auto entering = none;
        auto const look = [&](double violation, std::size_t k) {
            if (violation > most) most = violation, entering = k;
        };
        for (std::size_t i = 0; i < system_->size(); ++i) {
            double const* const a = system_->row(i);
            double violation = -system_->bound(i);
            if (relaxed_) violation -= x[n] * system_->weight(i);
            for (std::size_t j = 0; j < n; ++j) violation += a[j] * x[j];
            look(violation * scale_[i], i);
        }
        for (std::size_t j = 0; j < n; ++j) {
            look(-x[j], lower_of(j));
            look(x[j] - 1, upper_of(j));
        }
        if (entering == none) return false;
        write(entering, enters);
        return true;
    }

private:
    linear_system const* system_;
    bool relaxed_;
    std::vector<double> scale_, factor_;
};

[[nodiscard]] inline refutation multipliers_of(dual_simplex const& program,
                                               linear_system const& system,
                                               box_half_spaces const& half_spaces) {
    refutation result;
    for (auto const& [k, size] : program.combination()) {
        if (k < system.size()) result.multipliers.emplace_back(k, size * half_spaces.factor(k));
    }
    return result;
}

} // namespace paving_detail

/// A proved lower bound of \f$ c z \f$ over all \f$ z \in [0, 1]^n \f$ that fulfil the
/// inequalities; infinite when none does.
/// @cost  O(n size) for each of some tens of exchanges
[[nodiscard]] inline double proved_least(linear_system const& system, std::vector<double> goal,
                                         std::size_t most_exchanges = 500) {
    paving_detail::box_half_spaces const half_spaces(system, false);
    std::vector<half_space> basis(goal.size());
    auto downwards = goal;
    double trivial = 0;
    for (std::size_t j = 0; j < goal.size(); ++j) {
        downwards[j] = -goal[j];
        trivial = detail::add_down(trivial, std::min(goal[j], 0.0));
        half_spaces.write(goal[j] >= 0 ? half_spaces.lower_of(j) : half_spaces.upper_of(j),
                          basis[j]);
    }
    dual_simplex program;
    if (!program.start(std::move(downwards), std::move(basis))) return trivial;
    bool const empty =
        program.run(std::cref(half_spaces), most_exchanges) == dual_simplex::outcome::empty;
    auto const y = paving_detail::multipliers_of(program, system, half_spaces);
    if (empty) return proved_margin(system, y) > 0 ? HUGE_VAL : trivial;
    auto const least = paving_detail::least_under(system, y, goal);
    return least ? std::max(trivial, least->lower()) : trivial;
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
    paving_detail::box_half_spaces const half_spaces(system, true);
    std::vector<half_space> basis(n + 1);
    half_spaces.write(first, basis[n]);
    for (std::size_t j = 0; j < n; ++j) {
        bool const lower = basis[n].normal[j] > 0;
        half_spaces.write(lower ? half_spaces.lower_of(j) : half_spaces.upper_of(j), basis[j]);
    }
    std::vector<double> goal(n + 1, 0.0);
    goal[n] = -1;
    dual_simplex program;
    if (!program.start(std::move(goal), std::move(basis))) return result;
    auto const how = program.run(std::cref(half_spaces), most_exchanges);
    result.multipliers = paving_detail::multipliers_of(program, system, half_spaces);
    result.t = how == dual_simplex::outcome::empty ? HUGE_VAL : -program.value();
    result.z.assign(program.point().begin(), program.point().end() - 1);
    for (auto& z : result.z) z = std::clamp(z, 0.0, 1.0);
    return result;
}

} // namespace sivid

#endif
