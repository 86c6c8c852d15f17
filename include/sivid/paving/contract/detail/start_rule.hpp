// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_CONTRACT_DETAIL_START_RULE_HPP
#define SIVID_PAVING_CONTRACT_DETAIL_START_RULE_HPP

#include <sivid/space/dense.hpp>
#include <sivid/space/linear_program/minimax_lp.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// A start as an affine function of the parameters, both normalised:
///   \f$ s_i = middle_i + \sum_j slope_{ij} d_j \f$ for \f$ d \in [-1,1]^n \f$.
struct start_rule {
    std::vector<double> middle;
    std::vector<double> slope; ///< [start * parameters + parameter]
};

/// Misfits of measurements as affine functions of normalised parameters d and starts s,
///   \f$ f_y = offset_y + \sum_j a_{jy} d_j + \sum_i b_{iy} s_i \f$, wanted: \f$ |f_y| \le margin_y
///   \f$.
struct misfit_forms {
    std::size_t parameters = 0, starts = 0;
    std::vector<double> offset;
    std::vector<double> by_parameter; ///< [parameter * functions + y]
    std::vector<double> by_start;     ///< [start * functions + y]
    std::vector<double> margin;

    [[nodiscard]] std::size_t functions() const { return offset.size(); }
};

/// Looks for an affine rule by which the starts explain all parameters of a box: with it
/// \f$ |f_y| \le margin_y \f$ for all \f$ d \in [-1,1]^n \f$ and all but `spare` functions, and
/// \f$ |s_i| < 1 \f$.
///   For a given rule the worst d of a function is a corner known by signs, so the minimax problem
///   over rules is a linear program with 2^n rows for each function, of which only those are
///   written down that some earlier solution violates. Measurements that stand in the way most are
///   left out, one by one, up to `spare`.
/// @guarantee  none: doubles. That the rule does what it should is for others to prove.
/// @cost  a few linear programs in starts * (parameters + 1) unknowns; one in the starts alone
/// where
///   not even the middle of the box can be explained
/// @ref   A. Ben-Tal, A. Goryashko, E. Guslitzer, A. Nemirovski, Mathematical Programming A 99
///   (2004): affine decision rules
class start_rule_search {
public:
    /// @param forms  at least one start
    [[nodiscard]] std::optional<start_rule> operator()(misfit_forms const& forms,
                                                       std::size_t spare) {
        take(forms);
        for (std::size_t left_out = 0;; ++left_out) {
            auto const in_the_way = solve(left_out < spare);
            if (!in_the_way) return rule_;
            if (*in_the_way >= forms.functions()) return std::nullopt;
            margin_[static_cast<Eigen::Index>(*in_the_way)] = infinity;
        }
    }

    /// A rule that comes close: about the best starts of the middle of the box, and slopes by least
    /// squares, shortened so that starts stay in their boxes.
    /// @guarantee  none but that
    [[nodiscard]] start_rule propose(misfit_forms const& forms) {
        take(forms);
        std::vector<minimax_block> blocks(1);
        auto const solved = best_in_the_middle(blocks);
        if (solved.point.empty()) return rule_within(vector::Zero(s_), guess());
        return rule_within(Eigen::Map<vector const>(solved.point.data(), s_), guess());
    }

    /// A rule whose largest misfit at some points of the box is about least: those at which another
    /// rule does worst, of all that data leave of the box. Slopes are shortened as above.
    /// @param points  normalised, as many sides as parameters; one at least
    /// @guarantee  none
    /// @cost  a linear program in starts * (parameters + 1) unknowns, with a function for each
    /// point
    ///        and measurement
    [[nodiscard]] start_rule best_at(misfit_forms const& forms,
                                     std::vector<std::vector<double>> const& points) {
        take(forms);
        constexpr double firm = 1e3; // how much more a start outside its box counts
        offset_.tail(s_) *= firm;
        b_.bottomRows(s_) *= firm;
        margin_.setZero();
        margin_.tail(s_).setConstant(firm * furthest);
        std::vector<minimax_block> blocks(points.size());
        rows_.assign(points.size(), {});
        for (std::size_t k = 0; k < points.size(); ++k) {
            vector const at = Eigen::Map<vector const>(points[k].data(), p_);
            std::swap(rows_.back(), rows_[k]);
            for (Eigen::Index y = 0; y < offset_.size(); ++y) add_row(blocks[k], y, &at);
            std::swap(rows_.back(), rows_[k]);
            finish(blocks[k], s_ * (1 + p_));
        }
        auto const solved = minimax_solver(static_cast<std::size_t>(s_ * (1 + p_)), blocks)();
        if (solved.point.empty()) return rule_within(vector::Zero(s_), matrix::Zero(s_, p_));
        return rule_within(Eigen::Map<vector const>(solved.point.data(), s_),
                           Eigen::Map<matrix const>(solved.point.data() + s_, s_, p_));
    }

private:
    using vector = Eigen::VectorXd;
    using matrix = Eigen::MatrixXd;
    /// Starts stay so far from the ends of their boxes that rounding does not matter.
    static constexpr double furthest = 1 - 1e-9;
    static constexpr int rounds = 12;
    static constexpr double infinity = std::numeric_limits<double>::infinity();

    /// The functions, and after them one for each start: itself.
    void take(misfit_forms const& forms) {
        p_ = static_cast<Eigen::Index>(forms.parameters);
        s_ = static_cast<Eigen::Index>(forms.starts);
        auto const n = static_cast<Eigen::Index>(forms.functions());
        using map = Eigen::Map<matrix const>;
        offset_ = vector::Zero(n + s_);
        offset_.head(n) = Eigen::Map<vector const>(forms.offset.data(), n);
        a_ = matrix::Zero(n + s_, p_);
        a_.topRows(n) = map(forms.by_parameter.data(), n, p_);
        b_ = matrix::Zero(n + s_, s_);
        b_.topRows(n) = map(forms.by_start.data(), n, s_);
        b_.bottomRows(s_).setIdentity();
        margin_ = vector::Constant(n + s_, furthest);
        margin_.head(n) = Eigen::Map<vector const>(forms.margin.data(), n);
    }

    /// Shortened so that starts stay in their boxes.
    [[nodiscard]] start_rule rule_within(vector const& at, matrix const& slope) const {
        constexpr double inside = 1 - 4e-6; // whoever follows it linearises about it
        start_rule rule;
        for (Eigen::Index i = 0; i < s_; ++i) {
            double const middle = std::isfinite(at[i]) ? std::clamp(at[i], -inside, inside) : 0;
            double const sum = slope.row(i).cwiseAbs().sum(), room = inside - std::abs(middle);
            double const share = sum <= room ? 1 : sum > room ? room / sum : 0; // NaN: none
            rule.middle.push_back(middle);
            for (Eigen::Index j = 0; j < p_; ++j)
                rule.slope.push_back(share > 0 ? share * slope(i, j) : 0);
        }
        return rule;
    }

    /// The best starts of the middle of the box alone.
    [[nodiscard]] approximate_minimax best_in_the_middle(std::vector<minimax_block>& blocks) {
        rows_.assign(1, {});
        for (Eigen::Index y = 0; y < offset_.size(); ++y) {
            if (margin_[y] < infinity) add_row(blocks[0], y, nullptr);
        }
        finish(blocks[0], s_);
        return minimax_solver(static_cast<std::size_t>(s_), blocks)();
    }

    /// @param may_leave_out  look for a function that stands in the way
    /// @returns nothing when the rule does what it should; else that function, or the number of all
    ///   when there is none
    [[nodiscard]] std::optional<std::size_t> solve(bool may_leave_out) {
        auto const none = static_cast<std::size_t>(offset_.size());
        std::vector<minimax_block> blocks(1);
        auto solved = best_in_the_middle(blocks);
        auto unknowns = static_cast<std::size_t>(s_);
        if (!(solved.value <= 0)) return may_leave_out ? blocking(solved, unknowns, blocks) : none;
        vector const start = Eigen::Map<vector const>(solved.point.data(), s_);
        // What the parameters change, the starts make good as far as they can.
        matrix slope = guess();
        if (explains(start, slope)) return std::nullopt;
        blocks.clear();
        rows_.clear();
        unknowns = static_cast<std::size_t>(s_ * (1 + p_));
        auto at = start;
        minimax_solver growing(unknowns, blocks);
        for (int round = 0; round < rounds; ++round) {
            if (!add_violated(blocks, at, slope, round == 0 ? -infinity : solved.value)) {
                break;
            }
            solved = growing();
            if (!(solved.value <= 0)) {
                return may_leave_out ? blocking(solved, unknowns, blocks) : none;
            }
            at = Eigen::Map<vector const>(solved.point.data(), s_);
            slope = Eigen::Map<matrix const>(solved.point.data() + s_, s_, p_);
            if (explains(at, slope)) return std::nullopt;
        }
        return none;
    }

    /// Slopes that minimise the squares of what is left of a, and of themselves.
    [[nodiscard]] matrix guess() const {
        if (p_ == 0) return matrix(s_, 0);
        vector const weight = (margin_.array() < infinity).cast<double>();
        matrix const weighted = weight.asDiagonal() * b_;
        return approximate_least_squares(weighted, -(weight.asDiagonal() * a_));
    }

    /// Largest |f| over the box.
    [[nodiscard]] vector worst(vector const& at, matrix const& slope) const {
        vector most = (offset_ + b_ * at).cwiseAbs();
        if (p_ > 0) most += (a_ + b_ * slope).cwiseAbs().rowwise().sum();
        return most;
    }
    [[nodiscard]] bool explains(vector const& at, matrix const& slope) {
        if (!((worst(at, slope) - margin_).maxCoeff() <= 0)) return false;
        rule_.middle.assign(at.data(), at.data() + s_);
        rule_.slope.clear();
        for (Eigen::Index i = 0; i < s_; ++i) {
            for (Eigen::Index j = 0; j < p_; ++j) rule_.slope.push_back(slope(i, j));
        }
        return true;
    }

    /// Appends the worst corners of functions that exceed their margins by more than `least`.
    bool add_violated(std::vector<minimax_block>& blocks, vector const& at, matrix const& slope,
                      double least) {
        vector const excess = worst(at, slope) - margin_;
        vector const middle = offset_ + b_ * at;
        matrix const change = a_ + b_ * slope;
        auto& block = blocks.emplace_back();
        rows_.emplace_back();
        vector corner(p_);
        for (Eigen::Index y = 0; y < offset_.size(); ++y) {
            if (!(excess[y] > least + 1e-7)) continue;
            double const side = middle[y] < 0 ? -1 : 1;
            for (Eigen::Index j = 0; j < p_; ++j) corner[j] = change(y, j) * side < 0 ? -1 : 1;
            add_row(block, y, &corner);
        }
        finish(block, s_ * (1 + p_));
        return block.functions() > 0;
    }

    /// One function, in the middle or at a corner; its slopes row by row until `finish`.
    void add_row(minimax_block& block, Eigen::Index y, vector const* corner) {
        rows_.back().push_back(static_cast<std::size_t>(y));
        block.margin.push_back(margin_[y]);
        block.offset.push_back(offset_[y] + (corner ? a_.row(y).dot(*corner) : 0.0));
        for (Eigen::Index i = 0; i < s_; ++i) block.slope.push_back(b_(y, i));
        if (!corner) return;
        for (Eigen::Index j = 0; j < p_; ++j) {
            for (Eigen::Index i = 0; i < s_; ++i) block.slope.push_back(b_(y, i) * (*corner)[j]);
        }
    }
    static void finish(minimax_block& block, Eigen::Index unknowns) {
        auto const count = static_cast<Eigen::Index>(block.functions());
        using by_row = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
        matrix const slopes = Eigen::Map<by_row const>(block.slope.data(), count, unknowns);
        std::copy(slopes.data(), slopes.data() + slopes.size(), block.slope.begin());
        for (Eigen::Index v = 0; v < unknowns; ++v) {
            block.variable.push_back(static_cast<std::size_t>(v));
        }
    }

    /// Of the functions that determine the minimum the one without which it is least; the number of
    /// all when only the boxes of the starts do.
    [[nodiscard]] std::size_t blocking(approximate_minimax const& solved, std::size_t unknowns,
                                       std::vector<minimax_block> const& blocks) const {
        auto const own = static_cast<std::size_t>(offset_.size() - s_);
        auto best = static_cast<std::size_t>(offset_.size());
        double least = infinity;
        for (auto const& w : solved.weights) {
            auto const y = rows_[w.block][w.function];
            if (y >= own) continue;
            auto without = blocks;
            for (std::size_t b = 0; b < without.size(); ++b) {
                for (std::size_t k = 0; k < rows_[b].size(); ++k) {
                    if (rows_[b][k] == y) without[b].margin[k] = infinity;
                }
            }
            double const value = minimax_solver(unknowns, without)().value;
            if (value < least) {
                least = value;
                best = y;
            }
        }
        return best;
    }

    Eigen::Index p_ = 0, s_ = 0;
    vector offset_, margin_;
    matrix a_, b_;
    std::vector<std::vector<std::size_t>> rows_; ///< by block: which function
    start_rule rule_;
};

} // namespace sivid

#endif
