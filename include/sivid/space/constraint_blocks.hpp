// SPDX-License-Identifier: MIT
#ifndef SIVID_SPACE_CONSTRAINT_BLOCKS_HPP
#define SIVID_SPACE_CONSTRAINT_BLOCKS_HPP

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace sivid {

/// Affine functions of some of the unknowns, each with a margin: \f$ f_y(d) = offset_y + \sum_v
/// slope_{vy} d_{variable_v} \f$ may miss zero by `margin` for nothing.
struct minimax_block {
    std::vector<std::size_t> variable; ///< per column of the slopes: which unknown
    std::vector<double> slope;         ///< [v * functions + y]
    std::vector<double> offset;
    std::vector<double> margin; ///< infinity takes a function out of the problem

    [[nodiscard]] std::size_t functions() const { return offset.size(); }
};

/// A function that takes part in a proof, with its signed multiplier.
struct minimax_weight {
    std::size_t block = 0;
    std::size_t function = 0;
    double value = 0;
};

/// A constraint of a linear program over \f$ d \in [-1,1]^n \f$: \f$ \pm f(d) \le margin \f$ for a
/// function of a block, or \f$ \pm d_v \le 1 \f$.
struct signed_constraint {
    bool is_bound = true;
    std::size_t block = 0;
    std::size_t index = 0; ///< of the function in its block, or of the unknown
    bool positive = true;
    double excess = -std::numeric_limits<double>::infinity(); ///< at the point it was looked up for
};

/// The constraints of some blocks, for simplex methods that keep a basis of them. Plain doubles.
class constraint_blocks {
public:
    /// @param blocks  kept by reference
    constraint_blocks(std::size_t unknowns, std::vector<minimax_block> const& blocks)
        : n_(unknowns), blocks_(&blocks) {}

    [[nodiscard]] std::size_t unknowns() const { return n_; }

    /// The function with the largest |f| - margin.
    [[nodiscard]] signed_constraint worst_function(Eigen::VectorXd const& point) {
        signed_constraint worst;
        for (std::size_t b = 0; b < blocks_->size(); ++b) {
            auto const& block = (*blocks_)[b];
            auto const count = block.functions();
            value_.assign(block.offset.begin(), block.offset.end());
            for (std::size_t v = 0; v < block.variable.size(); ++v) {
                double const d = point[static_cast<Eigen::Index>(block.variable[v])];
                double const* const slope = &block.slope[v * count];
                for (std::size_t y = 0; y < count; ++y) value_[y] += slope[y] * d;
            }
            for (std::size_t y = 0; y < count; ++y) {
                double const excess = std::abs(value_[y]) - block.margin[y];
                if (excess > worst.excess) worst = {false, b, y, value_[y] > 0, excess};
            }
        }
        return worst;
    }
    /// The unknown with the largest |d| - 1.
    [[nodiscard]] signed_constraint worst_bound(Eigen::VectorXd const& point) const {
        signed_constraint worst;
        for (std::size_t v = 0; v < n_; ++v) {
            double const d = point[static_cast<Eigen::Index>(v)];
            if (std::abs(d) - 1 > worst.excess) worst = {true, 0, v, d > 0, std::abs(d) - 1};
        }
        return worst;
    }

    /// Its normal, in the first n entries of a vector of `size`; the others are zero.
    [[nodiscard]] Eigen::VectorXd normal(signed_constraint const& m, Eigen::Index size) const {
        Eigen::VectorXd c = Eigen::VectorXd::Zero(size);
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
    [[nodiscard]] double reach(signed_constraint const& m) const {
        if (m.is_bound) return 1;
        auto const& block = (*blocks_)[m.block];
        return block.margin[m.index] - (m.positive ? 1 : -1) * block.offset[m.index];
    }

private:
    std::size_t n_;
    std::vector<minimax_block> const* blocks_;
    std::vector<double> value_;
};

/// The member of a basis whose multiplier is first driven to zero when another one enters.
/// @param direction  how the multipliers fall, @param present  what they are
/// @returns -1 when none falls
[[nodiscard]] inline Eigen::Index leaving_member(Eigen::VectorXd const& direction,
                                                 Eigen::VectorXd const& present) {
    double const least = 1e-11 * direction.cwiseAbs().maxCoeff();
    Eigen::Index leaves = -1;
    double step = std::numeric_limits<double>::infinity();
    for (Eigen::Index k = 0; k < direction.size(); ++k) {
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

/// The functions of a basis with their multipliers, signed.
inline void add_weight(std::vector<minimax_weight>& to, signed_constraint const& m, double size) {
    if (m.is_bound || !(size > 0) || !std::isfinite(size)) return;
    to.push_back({m.block, m.index, m.positive ? size : -size});
}

} // namespace sivid

#endif
