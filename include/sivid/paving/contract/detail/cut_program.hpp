// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_CONTRACT_DETAIL_CUT_PROGRAM_HPP
#define SIVID_PAVING_CONTRACT_DETAIL_CUT_PROGRAM_HPP

#include <sivid/space/linear_program/constraint_blocks.hpp>

#include <cstddef>
#include <utility>
#include <vector>

namespace sivid {

/// How far an unknown can go, approximately: the functions that stop it, with signed multipliers.
struct approximate_cut {
    /// \f$ \pm d_j - \sum_i w_i f_i \f$ is about constant but for bounds of the unknowns; when
    /// `empty`, \f$ \sum_i w_i f_i \f$ itself is, and too large: nothing meets all constraints.
    std::vector<minimax_weight> weights;
    std::vector<double> point; ///< where it is about reached
    bool empty = false;
};

/// Maximises \f$ \pm d_j \f$, or another goal, over \f$ d \in [-1,1]^n \f$ with \f$ |f_y(d)| \le
/// margin_y \f$ for all functions of some blocks, by `dual_simplex` from the corner of the box that
/// is farthest. Every basis bounds \f$ d_j \f$ already, so stopping early is safe.
/// @guarantee  none: doubles. The multipliers are for \f$ certified_reach \f$, which proves.
/// @cost  about n exchanges, each O(n^2 + functions * columns)
class cut_program {
public:
    /// @param blocks  kept by reference; an infinite margin takes a function out
    cut_program(std::size_t unknowns, std::vector<minimax_block> const& blocks)
        : constraints_(unknowns, blocks) {}

    /// @param upwards  maximise \f$ d_j \f$, else \f$ -d_j \f$
    [[nodiscard]] approximate_cut operator()(std::size_t j, bool upwards) {
        std::vector<double> goal(constraints_.unknowns(), 0.0);
        goal[j] = upwards ? 1 : -1;
        return (*this)(std::move(goal));
    }
    /// Maximises \f$ \sum_v goal_v d_v \f$.
    [[nodiscard]] approximate_cut operator()(std::vector<double> goal) {
        auto const n = constraints_.unknowns();
        std::vector<half_space> corner(n);
        for (std::size_t v = 0; v < n; ++v) {
            constraints_.write({true, 0, v, goal[v] >= 0}, corner[v], n);
        }
        dual_simplex program;
        approximate_cut result;
        if (!program.start(std::move(goal), std::move(corner))) return result;
        auto const violated = [this, n](auto const& x, half_space& enters) {
            auto worst = constraints_.worst_among(often_, x);
            auto const bound = constraints_.worst_bound(x);
            if (bound.excess > worst.excess) worst = bound;
            if (!(worst.excess > 1e-9)) {
                worst = constraints_.worst_function(x);
                if (!(worst.excess > 1e-9)) return false;
                often_.emplace_back(worst.block, worst.index);
            }
            constraints_.write(worst, enters, n);
            return true;
        };
        result.empty = program.run(violated, 20 * (n + 2)) == dual_simplex::outcome::empty;
        result.point = program.point();
        result.weights = constraints_.weights(program.combination());
        return result;
    }

private:
    constraint_blocks constraints_;
    /// Functions that stopped an earlier goal: few do, so they are tried before all others.
    std::vector<std::pair<std::size_t, std::size_t>> often_;
};

} // namespace sivid

#endif
