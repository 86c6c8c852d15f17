// SPDX-License-Identifier: MIT
#ifndef SIVID_SPACE_LINEAR_PROGRAM_CONSTRAINT_BLOCKS_HPP
#define SIVID_SPACE_LINEAR_PROGRAM_CONSTRAINT_BLOCKS_HPP

#include <sivid/space/linear_program/dual_simplex.hpp>
#include <sivid/work_clock.hpp>

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
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

/// The constraints of some blocks, for a `dual_simplex`. Plain doubles.
class constraint_blocks {
public:
    /// @param blocks  kept by reference; more may follow, and functions may join the last one
    constraint_blocks(std::size_t unknowns, std::vector<minimax_block> const& blocks)
        : n_(unknowns), blocks_(&blocks) {}

    [[nodiscard]] std::size_t unknowns() const { return n_; }

    /// The function with the largest |f| - margin.
    [[nodiscard]] signed_constraint worst_function(std::vector<double> const& point) {
        signed_constraint worst;
        for (std::size_t b = 0; b < blocks_->size(); ++b) {
            auto const& block = (*blocks_)[b];
            auto const count = block.functions();
            work_clock::count(count * (block.variable.size() + 1), 0.1);
            value_.assign(block.offset.begin(), block.offset.end());
            for (std::size_t v = 0; v < block.variable.size(); ++v) {
                double const d = point[block.variable[v]];
                auto const n = static_cast<Eigen::Index>(count);
                Eigen::Map<Eigen::ArrayXd>(value_.data(), n) +=
                    d * Eigen::Map<Eigen::ArrayXd const>(block.slope.data() + v * count, n);
            }
            for (std::size_t y = 0; y < count; ++y) {
                double const excess = std::abs(value_[y]) - block.margin[y];
                if (excess > worst.excess) worst = {false, b, y, value_[y] > 0, excess};
            }
        }
        return worst;
    }
    /// The same among some functions, each given by its block and its place there.
    [[nodiscard]] signed_constraint
    worst_among(std::vector<std::pair<std::size_t, std::size_t>> const& functions,
                std::vector<double> const& point) const {
        signed_constraint worst;
        for (auto const& [b, y] : functions) {
            auto const& block = (*blocks_)[b];
            double value = block.offset[y];
            for (std::size_t v = 0; v < block.variable.size(); ++v)
                value += point[block.variable[v]] * block.slope[v * block.functions() + y];
            double const excess = std::abs(value) - block.margin[y];
            if (excess > worst.excess) worst = {false, b, y, value > 0, excess};
        }
        return worst;
    }
    /// The unknown with the largest |d| - 1.
    [[nodiscard]] signed_constraint worst_bound(std::vector<double> const& point) const {
        signed_constraint worst;
        for (std::size_t v = 0; v < n_; ++v) {
            double const d = point[v];
            if (std::abs(d) - 1 > worst.excess) worst = {true, 0, v, d > 0, std::abs(d) - 1};
        }
        return worst;
    }

    /// Writes a constraint down; its normal in the first n entries of `size`, the others are zero.
    void write(signed_constraint const& m, half_space& to, std::size_t size) const {
        to.name = name_of(m);
        to.normal.assign(size, 0.0);
        double const sign = m.positive ? 1 : -1;
        if (m.is_bound) {
            to.normal[m.index] = sign;
            to.reach = 1;
            return;
        }
        auto const& block = (*blocks_)[m.block];
        for (std::size_t v = 0; v < block.variable.size(); ++v) {
            to.normal[block.variable[v]] += sign * block.slope[v * block.functions() + m.index];
        }
        to.reach = block.margin[m.index] - sign * block.offset[m.index];
    }

    /// The functions of a combination of half-spaces, with signed multipliers.
    [[nodiscard]] static std::vector<minimax_weight>
    weights(std::vector<std::pair<std::uint64_t, double>> const& combination) {
        std::vector<minimax_weight> result;
        for (auto const& [name, size] : combination) {
            auto const block = static_cast<std::size_t>(name >> 32);
            auto const index = static_cast<std::size_t>((name & 0xffffffffu) >> 1);
            if (block > 0) result.push_back({block - 1, index, (name & 1) != 0 ? size : -size});
        }
        return result;
    }

private:
    /// Block (0: bounds), function or unknown, sign.
    static std::uint64_t name_of(signed_constraint const& m) {
        auto const block = m.is_bound ? std::uint64_t{0} : std::uint64_t{m.block} + 1;
        return block << 32 | std::uint64_t{m.index} << 1 | (m.positive ? 1u : 0u);
    }

    std::size_t n_;
    std::vector<minimax_block> const* blocks_;
    std::vector<double> value_;
};

} // namespace sivid

#endif
