// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_CUT_PROGRAM_HPP
#define SIVID_PAVING_CUT_PROGRAM_HPP

#include <sivid/space/constraint_blocks.hpp>

#include <Eigen/Core>
#include <Eigen/LU>

#include <cstddef>
#include <vector>

namespace sivid {

/// How far an unknown can go, approximately: the functions that stop it, with signed multipliers.
struct approximate_cut {
    /// \f$ \pm d_j - \sum_i w_i f_i \f$ is about constant but for bounds of the unknowns; when
    /// `empty`, \f$ \sum_i w_i f_i \f$ itself is, and too large: nothing meets all constraints.
    std::vector<minimax_weight> weights;
    bool empty = false;
    std::size_t exchanges = 0;
};

/// Maximises \f$ \pm d_j \f$ over \f$ d \in [-1,1]^n \f$ with \f$ |f_y(d)| \le margin_y \f$ for all
/// functions of some blocks: the dual simplex method, which starts at a corner of the box and takes
/// in the constraint that is violated most. Every basis bounds \f$ d_j \f$ already, so stopping
/// early is safe.
/// @guarantee  none: doubles. The multipliers are for \f$ certified_reach \f$, which proves.
/// @cost  about n exchanges, each O(n^3 + functions * columns)
class cut_program {
public:
    /// @param blocks  kept by reference; an infinite margin takes a function out
    cut_program(std::size_t unknowns, std::vector<minimax_block> const& blocks)
        : constraints_(unknowns, blocks), n_(static_cast<Eigen::Index>(unknowns)) {}

    /// @param upwards  maximise \f$ d_j \f$, else \f$ -d_j \f$
    [[nodiscard]] approximate_cut operator()(std::size_t j, bool upwards) {
        approximate_cut result;
        start(static_cast<Eigen::Index>(j), upwards);
        auto const limit = 20 * (constraints_.unknowns() + 2);
        for (; result.exchanges < limit; ++result.exchanges) {
            factors_.compute(basis_);
            point_ = factors_.transpose().solve(reach_);
            if (!point_.allFinite()) break;
            auto enters = constraints_.worst_function(point_);
            auto const bound = constraints_.worst_bound(point_);
            if (bound.excess > enters.excess) enters = bound;
            if (!(enters.excess > 1e-9)) break;
            auto const normal = constraints_.normal(enters, n_);
            Eigen::VectorXd const direction = factors_.solve(normal);
            auto const leaves = leaving_member(direction, factors_.solve(goal_));
            if (leaves < 0) {
                if (direction.allFinite()) take(result, -direction);
                add_weight(result.weights, enters, 1);
                result.empty = true;
                return result;
            }
            members_[static_cast<std::size_t>(leaves)] = enters;
            basis_.col(leaves) = normal;
            reach_[leaves] = constraints_.reach(enters);
        }
        factors_.compute(basis_);
        take(result, factors_.solve(goal_));
        return result;
    }

private:
    /// The corner of the box that is farthest in the direction asked for.
    void start(Eigen::Index j, bool upwards) {
        goal_ = Eigen::VectorXd::Zero(n_);
        goal_[j] = upwards ? 1 : -1;
        basis_ = Eigen::MatrixXd::Identity(n_, n_);
        reach_ = Eigen::VectorXd::Ones(n_);
        members_.clear();
        for (std::size_t v = 0; v < constraints_.unknowns(); ++v) members_.push_back({true, 0, v});
        if (upwards) return;
        members_[static_cast<std::size_t>(j)].positive = false;
        basis_(j, j) = -1;
    }

    void take(approximate_cut& result, Eigen::VectorXd const& multipliers) const {
        for (std::size_t k = 0; k < members_.size(); ++k) {
            add_weight(result.weights, members_[k], multipliers[static_cast<Eigen::Index>(k)]);
        }
    }

    constraint_blocks constraints_;
    Eigen::Index n_;
    std::vector<signed_constraint> members_;
    Eigen::MatrixXd basis_;
    Eigen::VectorXd reach_, goal_, point_;
    Eigen::PartialPivLU<Eigen::MatrixXd> factors_;
};

} // namespace sivid

#endif
