// SPDX-License-Identifier: MIT
#ifndef SIVID_SPACE_MINIMAX_LP_HPP
#define SIVID_SPACE_MINIMAX_LP_HPP

#include <sivid/space/constraint_blocks.hpp>

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace sivid {

/// \f$ \min_{d \in [-1,1]^n} \max_y (|f_y(d)| - margin_y) \f$, approximately.
struct approximate_minimax {
    double value = -std::numeric_limits<double>::infinity();
    std::vector<double> point;           ///< where the maximum is about least
    std::vector<minimax_weight> weights; ///< multipliers, at most n + 1; the sum of sizes is one
    std::size_t exchanges = 0;
};

/// Solves the minimax problem by the simplex method on its dual, one exchange after the other: the
/// function that is largest at the present point enters the proof, and another one leaves it. Every
/// basis is a proof of some lower bound already, so stopping early is safe.
/// @guarantee  none: doubles. The multipliers are for \f$ combined_polynomial \f$, which proves.
/// @cost  a few times n exchanges, each O(n^3 + functions * columns)
/// @ref   E. Stiefel, Numerische Mathematik 2 (1960): exchange and simplex method
class minimax_solver {
public:
    /// @param blocks  kept by reference
    minimax_solver(std::size_t unknowns, std::vector<minimax_block> const& blocks)
        : constraints_(unknowns, blocks), n_(static_cast<Eigen::Index>(unknowns)) {}

    [[nodiscard]] approximate_minimax operator()() {
        approximate_minimax result;
        result.point.assign(constraints_.unknowns(), 0.0);
        point_ = Eigen::VectorXd::Zero(n_ + 1);
        auto const first = constraints_.worst_function(point_);
        if (!(first.excess > -std::numeric_limits<double>::infinity())) return result;
        start(first);
        auto const limit = 40 * (constraints_.unknowns() + 2);
        for (; result.exchanges < limit; ++result.exchanges) {
            factors_.compute(basis_);
            point_ = factors_.transpose().solve(cost_);
            point_.head(n_) *= -1;
            auto enters = constraints_.worst_function(point_);
            enters.excess -= point_[n_];
            auto const bound = constraints_.worst_bound(point_);
            if (bound.excess > enters.excess) enters = bound;
            double const scale = 1 + std::abs(point_[n_]);
            if (!(enters.excess > 1e-9 * scale) || !exchange(enters)) break;
        }
        finish(result);
        return result;
    }

private:
    /// Its column of the dual constraints.
    [[nodiscard]] Eigen::VectorXd column(signed_constraint const& m) const {
        auto c = constraints_.normal(m, n_ + 1);
        c[n_] = m.is_bound ? 0 : 1;
        return c;
    }

    /// One function, balanced by the bounds of the unknowns.
    void start(signed_constraint const& first) {
        members_.clear();
        basis_.setZero(n_ + 1, n_ + 1);
        cost_.setConstant(n_ + 1, -1.0);
        auto const balanced = column(first);
        for (Eigen::Index v = 0; v < n_; ++v) {
            bool const positive = balanced[v] <= 0;
            members_.push_back({true, 0, static_cast<std::size_t>(v), positive});
            basis_(v, v) = positive ? 1 : -1;
        }
        members_.push_back(first);
        basis_.col(n_) = balanced;
        cost_[n_] = -constraints_.reach(first);
    }

    [[nodiscard]] Eigen::VectorXd multipliers() const {
        Eigen::VectorXd one = Eigen::VectorXd::Zero(n_ + 1);
        one[n_] = 1;
        return factors_.solve(one);
    }

    /// Takes a member in for the one whose multiplier it first drives to zero.
    [[nodiscard]] bool exchange(signed_constraint const& enters) {
        auto const new_column = column(enters);
        Eigen::VectorXd const direction = factors_.solve(new_column);
        Eigen::VectorXd const present = multipliers();
        if (!direction.allFinite() || !present.allFinite()) return false;
        auto const leaves = leaving_member(direction, present);
        if (leaves < 0) return false;
        members_[static_cast<std::size_t>(leaves)] = enters;
        basis_.col(leaves) = new_column;
        cost_[leaves] = -constraints_.reach(enters);
        return true;
    }

    void finish(approximate_minimax& result) {
        factors_.compute(basis_);
        Eigen::VectorXd const w = multipliers();
        for (std::size_t v = 0; v < result.point.size(); ++v) {
            double const d = point_[static_cast<Eigen::Index>(v)];
            result.point[v] = std::isfinite(d) ? std::clamp(d, -1.0, 1.0) : 0.0;
        }
        result.value = w.dot(cost_);
        for (std::size_t k = 0; k < members_.size(); ++k) {
            add_weight(result.weights, members_[k], w[static_cast<Eigen::Index>(k)]);
        }
    }

    constraint_blocks constraints_;
    Eigen::Index n_;
    std::vector<signed_constraint> members_;
    Eigen::MatrixXd basis_;
    Eigen::VectorXd cost_, point_;
    Eigen::PartialPivLU<Eigen::MatrixXd> factors_;
};

} // namespace sivid

#endif
