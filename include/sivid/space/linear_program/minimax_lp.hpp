// SPDX-License-Identifier: MIT
#ifndef SIVID_SPACE_LINEAR_PROGRAM_MINIMAX_LP_HPP
#define SIVID_SPACE_LINEAR_PROGRAM_MINIMAX_LP_HPP

#include <sivid/space/linear_program/constraint_blocks.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace sivid {

/// \f$ \min_{d \in [-1,1]^n} \max_y (|f_y(d)| - margin_y) \f$, approximately.
struct approximate_minimax {
    double value = -std::numeric_limits<double>::infinity(); ///< NaN: numbers that are none
    std::vector<double> point;                               ///< where the maximum is about least
    std::vector<minimax_weight> weights; ///< multipliers, at most n + 1; the sum of sizes is one
    std::size_t exchanges = 0;
};

/// Solves the minimax problem as a linear program in d and the height, by `dual_simplex`: the
/// function that is largest at the present point enters the proof, and another one leaves it. Every
/// basis is a proof of some lower bound already, so stopping early is safe.
/// @guarantee  none: doubles. The multipliers are for \f$ combined_polynomial \f$, which proves.
/// @cost  a few times n exchanges, each O(n^2 + functions * columns)
/// @ref   E. Stiefel, Numerische Mathematik 2 (1960): exchange and simplex method
class minimax_solver {
public:
    /// @param blocks  kept by reference
    minimax_solver(std::size_t unknowns, std::vector<minimax_block> const& blocks)
        : constraints_(unknowns, blocks), n_(unknowns) {}

    /// A second call goes on where the first one ended, with functions that have come meanwhile;
    /// none may be changed or taken out.
    [[nodiscard]] approximate_minimax operator()() {
        approximate_minimax result;
        result.point.assign(n_, 0.0);
        if (!program_.started()) {
            std::vector<double> const middle(n_ + 1, 0.0);
            auto const first = constraints_.worst_function(middle);
            if (!(first.excess > -std::numeric_limits<double>::infinity())) return result;
            start(first);
        }
        auto const before = program_.exchanges();
        (void)program_.run([this](auto const& x, half_space& enters) { return worst(x, enters); },
                           40 * (n_ + 2));
        result.exchanges = program_.exchanges() - before;
        for (std::size_t v = 0; v < n_; ++v) {
            double const d = program_.point()[v];
            result.point[v] = std::isfinite(d) ? std::clamp(d, -1.0, 1.0) : 0.0;
        }
        result.value =
            program_.started() ? -program_.value() : std::numeric_limits<double>::quiet_NaN();
        result.weights = constraints_.weights(program_.combination());
        return result;
    }

private:
    void write(signed_constraint const& m, half_space& to) const {
        constraints_.write(m, to, n_ + 1);
        to.normal[n_] = m.is_bound ? 0 : -1; // f - height <= margin
    }
    /// One function, balanced by the bounds of the unknowns.
    void start(signed_constraint const& first) {
        std::vector<half_space> basis(n_ + 1);
        write(first, basis[n_]);
        for (std::size_t v = 0; v < n_; ++v) {
            write({true, 0, v, basis[n_].normal[v] <= 0}, basis[v]);
        }
        std::vector<double> goal(n_ + 1, 0.0);
        goal[n_] = -1;
        (void)program_.start(std::move(goal), std::move(basis));
    }
    bool worst(std::vector<double> const& x, half_space& enters) {
        auto worst = constraints_.worst_function(x);
        worst.excess -= x[n_];
        auto const bound = constraints_.worst_bound(x);
        if (bound.excess > worst.excess) worst = bound;
        if (!(worst.excess > 1e-9 * (1 + std::abs(x[n_])))) return false;
        write(worst, enters);
        return true;
    }

    constraint_blocks constraints_;
    std::size_t n_;
    dual_simplex program_;
};

} // namespace sivid

#endif
