// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_MINIMAX_LP_HPP
#define SIVID_PAVING_MINIMAX_LP_HPP

#include <Eigen/Core>
#include <Eigen/LU>

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
        : n_(unknowns), blocks_(&blocks) {}

    [[nodiscard]] approximate_minimax operator()() {
        approximate_minimax result;
        result.point.assign(n_, 0.0);
        point_ = Eigen::VectorXd::Zero(size());
        auto const first = worst_function();
        if (!(first.gain > -std::numeric_limits<double>::infinity())) return result;
        start(first);
        for (auto const limit = 40 * (n_ + 2); result.exchanges < limit; ++result.exchanges) {
            factors_.compute(basis_);
            prices_ = factors_.transpose().solve(cost_);
            point_ = prices_;
            point_.head(static_cast<Eigen::Index>(n_)) *= -1;
            auto enters = worst_function();
            enters.gain -= point_[static_cast<Eigen::Index>(n_)];
            for (std::size_t v = 0; v < n_; ++v) {
                double const beyond = std::abs(point_[static_cast<Eigen::Index>(v)]) - 1;
                if (beyond > enters.gain) {
                    enters = {member::kind::bound, 0, v, point_[static_cast<Eigen::Index>(v)] > 0,
                              beyond};
                }
            }
            double const scale = 1 + std::abs(point_[static_cast<Eigen::Index>(n_)]);
            if (!(enters.gain > 1e-9 * scale) || !exchange(enters)) break;
        }
        finish(result);
        return result;
    }

private:
    /// A constraint of the primal problem: a function with a sign, or a bound of an unknown.
    struct member {
        enum class kind { function, bound };
        kind what = kind::function;
        std::size_t block = 0;
        std::size_t index = 0;
        bool positive = true;
        double gain = -std::numeric_limits<double>::infinity();
    };

    [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(n_ + 1); }

    /// The function with the largest |f| - margin at the present point.
    [[nodiscard]] member worst_function() {
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
                double const size = std::abs(value_[y]) - block.margin[y];
                if (size > worst.gain) {
                    worst = {member::kind::function, b, y, value_[y] > 0, size};
                }
            }
        }
        return worst;
    }

    /// Its column of the dual constraints, and what it costs.
    [[nodiscard]] Eigen::VectorXd column(member const& m) const {
        Eigen::VectorXd c = Eigen::VectorXd::Zero(size());
        double const sign = m.positive ? 1 : -1;
        if (m.what == member::kind::bound) {
            c[static_cast<Eigen::Index>(m.index)] = sign;
            return c;
        }
        auto const& block = (*blocks_)[m.block];
        for (std::size_t v = 0; v < block.variable.size(); ++v) {
            c[static_cast<Eigen::Index>(block.variable[v])] =
                sign * block.slope[v * block.functions() + m.index];
        }
        c[static_cast<Eigen::Index>(n_)] = 1;
        return c;
    }
    [[nodiscard]] double cost(member const& m) const {
        if (m.what == member::kind::bound) return -1;
        auto const& block = (*blocks_)[m.block];
        return (m.positive ? 1 : -1) * block.offset[m.index] - block.margin[m.index];
    }

    /// One function, balanced by the bounds of the unknowns.
    void start(member const& first) {
        members_.clear();
        basis_.setZero(size(), size());
        cost_.setConstant(size(), -1.0);
        auto const balanced = column(first);
        for (std::size_t v = 0; v < n_; ++v) {
            auto const i = static_cast<Eigen::Index>(v);
            members_.push_back({member::kind::bound, 0, v, balanced[i] <= 0, 0});
            basis_(i, i) = balanced[i] <= 0 ? 1 : -1;
        }
        members_.push_back(first);
        basis_.col(size() - 1) = balanced;
        cost_[size() - 1] = cost(first);
    }

    [[nodiscard]] Eigen::VectorXd multipliers() const {
        Eigen::VectorXd one = Eigen::VectorXd::Zero(size());
        one[size() - 1] = 1;
        return factors_.solve(one);
    }

    /// Takes a member in for the one whose multiplier it first drives to zero.
    [[nodiscard]] bool exchange(member const& enters) {
        auto const new_column = column(enters);
        Eigen::VectorXd const direction = factors_.solve(new_column);
        Eigen::VectorXd const present = multipliers();
        if (!direction.allFinite() || !present.allFinite()) return false;
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
        if (leaves < 0) return false;
        members_[static_cast<std::size_t>(leaves)] = enters;
        basis_.col(leaves) = new_column;
        cost_[leaves] = cost(enters);
        return true;
    }

    void finish(approximate_minimax& result) {
        factors_.compute(basis_);
        Eigen::VectorXd const w = multipliers();
        for (std::size_t v = 0; v < n_; ++v) {
            double const d = point_[static_cast<Eigen::Index>(v)];
            result.point[v] = std::isfinite(d) ? std::clamp(d, -1.0, 1.0) : 0.0;
        }
        result.value = w.dot(cost_);
        for (std::size_t k = 0; k < members_.size(); ++k) {
            auto const& m = members_[k];
            double const size = w[static_cast<Eigen::Index>(k)];
            if (m.what != member::kind::function || !(size > 0) || !std::isfinite(size)) continue;
            result.weights.push_back({m.block, m.index, m.positive ? size : -size});
        }
    }

    std::size_t n_;
    std::vector<minimax_block> const* blocks_;
    std::vector<member> members_;
    Eigen::MatrixXd basis_;
    Eigen::VectorXd cost_, prices_, point_;
    Eigen::PartialPivLU<Eigen::MatrixXd> factors_;
    std::vector<double> value_;
};

} // namespace sivid

#endif
