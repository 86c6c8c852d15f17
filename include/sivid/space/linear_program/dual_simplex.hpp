// SPDX-License-Identifier: MIT
#ifndef SIVID_SPACE_LINEAR_PROGRAM_DUAL_SIMPLEX_HPP
#define SIVID_SPACE_LINEAR_PROGRAM_DUAL_SIMPLEX_HPP

#include <sivid/space/linear_program/detail/basis_factors.hpp>
#include <sivid/work_clock.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace sivid {

/// \f$ normal \cdot x \le reach \f$, under a name that its owner chose.
struct half_space {
    std::uint64_t name = 0;
    std::vector<double> normal;
    double reach = 0;
};

/// Maximises \f$ goal \cdot x \f$ under half-spaces, nearly, by the dual simplex method. n of them
/// are a basis: where they meet is the point, and the goal is a sum of their normals with
/// multipliers \f$ y \ge 0 \f$, so that no point under them is better than \f$ \sum_k y_k reach_k
/// \f$. One that the point violates enters, the one whose multiplier is first driven to zero
/// leaves. The half-spaces are never listed: a function finds one that a point violates.
///   A later `run` goes on from the basis: new half-spaces may have come (a warm start).
/// @guarantee  none: doubles, no proof. It ends for any numbers, NaN included; whatever basis it
///   stops at, the multipliers are a guess from which intervals can prove something. Where many
///   exchanges in a row gain nothing the goal is shifted a little, so that none goes in circles.
/// @cost  about n exchanges, each O(n^2) and one question
/// @ref   C. E. Lemke, The dual method of solving the linear programming problem, Naval Research
///   Logistics Quarterly 1 (1954)
class dual_simplex {
public:
    enum class outcome {
        optimal, ///< the point violates nothing
        empty,   ///< nothing fulfils all half-spaces, as `combination` shows
        stopped  ///< too many exchanges, or numbers that are none
    };
    /// Writes a half-space that x violates, best the one it violates most.
    /// @returns false when x will do
    using question = std::function<bool(std::vector<double> const& x, half_space& violated)>;

    /// Begins anew.
    /// @param basis  as many half-spaces as unknowns, of whose normals the goal is a non-negative
    ///   combination. For an unbounded program there are none.
    /// @returns false when they are not like that
    [[nodiscard]] bool start(std::vector<double> goal, std::vector<half_space> basis) {
        goal_ = std::move(goal);
        basis_ = std::move(basis);
        exchanges_ = 0;
        stalled_ = 0;
        started_ = found_empty_ = false;
        target_ = goal_;
        point_.assign(goal_.size(), 0.0);
        multipliers_.clear();
        if (basis_.size() != goal_.size() || !factorise() || !solve()) return false;
        double largest = 0;
        for (double const y : multipliers_) largest = std::max(largest, std::abs(y));
        for (double const y : multipliers_) {
            if (!(y >= -1e-9 * largest)) return false;
        }
        return started_ = true;
    }
    [[nodiscard]] bool started() const { return started_; }

    /// @param most  exchanges of this run
    [[nodiscard]] outcome run(question const& violated, std::size_t most) {
        if (!started_) return outcome::stopped;
        enters_.name = no_name;
        for (std::size_t k = 0;; ++k) {
            if (!violated(point_, enters_)) {
                if (updates_ == 0) return settle(outcome::optimal);
                if (!factorise() || !solve()) return settle(outcome::stopped);
                if (!violated(point_, enters_)) return settle(outcome::optimal);
            }
            if (k == most || enters_.normal.size() != goal_.size()) {
                return settle(outcome::stopped);
            }
            work_clock::count(goal_.size() * goal_.size(), 0.4);
            direction_ = enters_.normal;
            factors_.solve(direction_);
            if (!finite(direction_)) return settle(outcome::stopped);
            auto const leaves = leaving(direction_, multipliers_);
            if (leaves == direction_.size()) return settle(outcome::empty);
            if (!exchange(leaves)) return settle(outcome::stopped);
        }
    }

    [[nodiscard]] std::vector<double> const& point() const { return point_; }
    [[nodiscard]] std::size_t exchanges() const { return exchanges_; }
    /// \f$ \sum_k y_k reach_k \f$: the bound that the basis shows.
    [[nodiscard]] double value() const {
        double sum = 0;
        for (std::size_t k = 0; k < multipliers_.size(); ++k) {
            sum += multipliers_[k] * basis_[k].reach;
        }
        return sum;
    }
    /// Names of half-spaces with positive multipliers. Their normals add up to the goal; after
    /// `empty` to zero, and their reaches to less than it.
    [[nodiscard]] std::vector<std::pair<std::uint64_t, double>> combination() const {
        std::vector<std::pair<std::uint64_t, double>> result;
        for (std::size_t k = 0; k < multipliers_.size(); ++k) {
            double const y = multipliers_[k];
            if (y > 0 && std::isfinite(y)) result.emplace_back(basis_[k].name, y);
        }
        if (found_empty_) result.emplace_back(enters_.name, 1.0);
        return result;
    }

    /// The member whose multiplier is first driven to zero: of those that are so at nearly the same
    /// step the one that falls fastest, as a small pivot spoils the factors. Others may then fall
    /// below zero by a billionth of the largest.
    /// @param direction  how the multipliers fall, @param present  what they are
    /// @returns the number of all when none falls
    /// @ref  P. M. J. Harris, Pivot selection methods of the Devex LP code, Mathematical
    /// Programming
    ///   5 (1973)
    [[nodiscard]] static std::size_t leaving(std::vector<double> const& direction,
                                             std::vector<double> const& present) {
        double fastest = 0, largest = 0;
        for (double const d : direction) fastest = std::max(fastest, std::abs(d));
        for (double const y : present) largest = std::max(largest, std::abs(y));
        auto const step = [&](std::size_t k, double below) {
            return (std::max(present[k], 0.0) + below) / direction[k];
        };
        auto const falls = [&](std::size_t k) { return direction[k] > 1e-11 * fastest; };
        double furthest = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < direction.size(); ++k) {
            if (falls(k)) furthest = std::min(furthest, step(k, 1e-9 * largest));
        }
        std::size_t leaves = direction.size();
        for (std::size_t k = 0; k < direction.size(); ++k) {
            if (!falls(k) || !(step(k, 0) <= furthest)) continue;
            if (leaves == direction.size() || direction[k] > direction[leaves]) leaves = k;
        }
        return leaves;
    }

private:
    static constexpr std::uint64_t no_name = ~std::uint64_t{0};
    /// Updates of the factors before they are made anew, which costs as much as n of them.
    [[nodiscard]] std::size_t most_updates() const {
        return std::max<std::size_t>(16, basis_.size() / 4);
    }

    static bool finite(std::vector<double> const& v) {
        return std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); });
    }
    [[nodiscard]] bool factorise() {
        auto const n = basis_.size();
        matrix_.resize(n * n);
        for (std::size_t k = 0; k < n; ++k) {
            if (basis_[k].normal.size() != n) return false;
            for (std::size_t i = 0; i < n; ++i) matrix_[i * n + k] = basis_[k].normal[i];
        }
        updates_ = 0;
        return factors_.factorise(matrix_, n);
    }
    /// Point and multipliers of the basis; left as they were when they would not be finite.
    [[nodiscard]] bool solve() {
        next_point_.clear();
        for (auto const& m : basis_) next_point_.push_back(m.reach);
        factors_.solve_transposed(next_point_);
        next_multipliers_ = target_;
        factors_.solve(next_multipliers_);
        if (!finite(next_point_) || !finite(next_multipliers_)) return false;
        point_.swap(next_point_);
        multipliers_.swap(next_multipliers_);
        return true;
    }
    [[nodiscard]] bool exchange(std::size_t leaves) {
        double largest = 0;
        for (double const y : multipliers_) largest = std::max(largest, std::abs(y));
        stalled_ = multipliers_[leaves] > 1e-13 * largest ? 0 : stalled_ + 1;
        std::swap(basis_[leaves], enters_);
        ++exchanges_;
        bool const updated = updates_ < most_updates() && factors_.replace(leaves, direction_);
        updates_ += updated ? 1 : 0;
        if ((!updated && !factorise()) || !solve()) {
            std::swap(basis_[leaves], enters_); // the last basis that was one
            started_ = factorise() && solve();
            return false;
        }
        if (stalled_ > 2 * basis_.size() + 8) shift();
        return true;
    }
    /// Gives each member a multiplier of its own, so that ties are broken.
    void shift() {
        stalled_ = 0;
        double scale = 0;
        for (double const y : multipliers_) scale = std::max(scale, std::abs(y));
        for (std::size_t k = 0; k < basis_.size(); ++k) {
            double const more = 1e-10 * scale * (1 + static_cast<double>(k * 7919 % 101) / 101);
            multipliers_[k] = std::max(multipliers_[k], 0.0) + more;
        }
        std::fill(target_.begin(), target_.end(), 0.0);
        for (std::size_t k = 0; k < basis_.size(); ++k) {
            for (std::size_t i = 0; i < target_.size(); ++i) {
                target_[i] += multipliers_[k] * basis_[k].normal[i];
            }
        }
    }
    /// The multipliers of the goal itself, or those that show that nothing is left.
    outcome settle(outcome how) {
        target_ = goal_;
        found_empty_ = how == outcome::empty;
        if (found_empty_) {
            multipliers_ = direction_;
            for (double& y : multipliers_) y = -y;
            started_ = false;
        } else if (started_ && !solve()) {
            started_ = false;
        }
        return how;
    }

    std::vector<double> goal_, target_; ///< as given, and shifted
    std::vector<half_space> basis_;
    half_space enters_;
    basis_factors factors_;
    std::vector<double> matrix_, point_, multipliers_, direction_, next_point_, next_multipliers_;
    std::size_t exchanges_ = 0, stalled_ = 0, updates_ = 0;
    bool started_ = false, found_empty_ = false;
};

} // namespace sivid

#endif
