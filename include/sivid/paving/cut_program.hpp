// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_CUT_PROGRAM_HPP
#define SIVID_PAVING_CUT_PROGRAM_HPP

#include <sivid/paving/minimax_lp.hpp>

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
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
        : n_(unknowns), blocks_(&blocks) {}

    /// @param upwards  maximise \f$ d_j \f$, else \f$ -d_j \f$
    [[nodiscard]] approximate_cut operator()(std::size_t j, bool upwards) {
        approximate_cut result;
        start(j, upwards);
        for (auto const limit = 20 * (n_ + 2); result.exchanges < limit; ++result.exchanges) {
            factors_.compute(basis_);
            point_ = factors_.transpose().solve(reach_);
            if (!point_.allFinite()) break;
            auto const enters = most_violated();
            if (!(enters.excess > 1e-9)) break;
            auto const normal = column(enters);
            Eigen::VectorXd const direction = factors_.solve(normal);
            Eigen::VectorXd const present = factors_.solve(goal_);
            auto const leaves = leaving(direction, present);
            if (leaves < 0) {
                if (direction.allFinite()) take(result, -direction);
                add(result, enters, 1);
                result.empty = true;
                return result;
            }
            members_[static_cast<std::size_t>(leaves)] = enters;
            basis_.col(leaves) = normal;
            reach_[leaves] = reach(enters);
        }
        factors_.compute(basis_);
        take(result, factors_.solve(goal_));
        return result;
    }

private:
    /// A constraint: a function with a sign, or a bound of an unknown.
    struct member {
        bool is_bound = true;
        std::size_t block = 0;
        std::size_t index = 0;
        bool positive = true;
        double excess = -std::numeric_limits<double>::infinity();
    };

    [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(n_); }

    void start(std::size_t j, bool upwards) {
        goal_ = Eigen::VectorXd::Zero(size());
        goal_[static_cast<Eigen::Index>(j)] = upwards ? 1 : -1;
        basis_ = Eigen::MatrixXd::Identity(size(), size());
        reach_ = Eigen::VectorXd::Ones(size());
        members_.clear();
        for (std::size_t v = 0; v < n_; ++v) members_.push_back({true, 0, v, true});
        if (upwards) return;
        members_[j].positive = false;
        basis_(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(j)) = -1;
    }

    [[nodiscard]] member most_violated() {
        member worst;
        for (std::size_t b = 0; b < blocks_->size(); ++b) {
            auto const& block = (*blocks_)[b];
            auto const count = block.functions();
            value_.assign(block.offset.begin(), block.offset.end());
            for (std::size_t v = 0; v < block.variable.size(); ++v) {
                double const d = point_[static_cast<Eigen::Index>(block.variable[v])];
                double const* const slope = &block.slope[v * count];
                for (std::size_t y = 0; y < count; ++y) value_[y] += slope[y] * d;
            }
            for (std::size_t y = 0; y < count; ++y) {
                double const excess = std::abs(value_[y]) - block.margin[y];
                if (excess > worst.excess) worst = {false, b, y, value_[y] > 0, excess};
            }
        }
        for (std::size_t v = 0; v < n_; ++v) {
            double const d = point_[static_cast<Eigen::Index>(v)];
            if (std::abs(d) - 1 > worst.excess) worst = {true, 0, v, d > 0, std::abs(d) - 1};
        }
        return worst;
    }

    [[nodiscard]] Eigen::VectorXd column(member const& m) const {
        Eigen::VectorXd c = Eigen::VectorXd::Zero(size());
        double const sign = m.positive ? 1 : -1;
        if (m.is_bound) {
            c[static_cast<Eigen::Index>(m.index)] = sign;
            return c;
        }
        auto const& block = (*blocks_)[m.block];
        for (std::size_t v = 0; v < block.variable.size(); ++v) {
            c[static_cast<Eigen::Index>(block.variable[v])] +=
                sign * block.slope[v * block.functions() + m.index];
        }
        return c;
    }
    /// How large normal * d may be.
    [[nodiscard]] double reach(member const& m) const {
        if (m.is_bound) return 1;
        auto const& block = (*blocks_)[m.block];
        return block.margin[m.index] - (m.positive ? 1 : -1) * block.offset[m.index];
    }

    /// The member whose multiplier is first driven to zero; -1 when there is none.
    [[nodiscard]] Eigen::Index leaving(Eigen::VectorXd const& direction,
                                       Eigen::VectorXd const& present) const {
        double const least = 1e-11 * direction.cwiseAbs().maxCoeff();
        Eigen::Index leaves = -1;
        double step = std::numeric_limits<double>::infinity();
        for (Eigen::Index k = 0; k < size(); ++k) {
            if (!(direction[k] > least)) continue;
            double const ratio = std::max(present[k], 0.0) / direction[k];
            bool const ties = leaves >= 0 && ratio == step;
            if (ratio < step || (ties && direction[k] > direction[leaves])) {
                step = ratio;
                leaves = k;
            }
        }
        return leaves;
    }

    void take(approximate_cut& result, Eigen::VectorXd const& multipliers) const {
        for (std::size_t k = 0; k < members_.size(); ++k) {
            add(result, members_[k], multipliers[static_cast<Eigen::Index>(k)]);
        }
    }
    static void add(approximate_cut& result, member const& m, double size) {
        if (m.is_bound || !(size > 0) || !std::isfinite(size)) return;
        result.weights.push_back({m.block, m.index, m.positive ? size : -size});
    }

    std::size_t n_;
    std::vector<minimax_block> const* blocks_;
    std::vector<member> members_;
    Eigen::MatrixXd basis_;
    Eigen::VectorXd reach_, goal_, point_;
    Eigen::PartialPivLU<Eigen::MatrixXd> factors_;
    std::vector<double> value_;
};

} // namespace sivid

#endif
