// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_PLACE_DETAIL_LAW_SEARCH_HPP
#define SIVID_APPROXIMATE_PLACE_DETAIL_LAW_SEARCH_HPP

#include <sivid/approximate/place/detail/law.hpp>
#include <sivid/approximate/place/detail/place_fit.hpp>
#include <sivid/space/dense.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace sivid {

/// How well a law in place of free missing rates explains the data, to first order about the fit
/// with free ones, while parameters, starts and the other places adapt.
struct ranked_law {
    std::size_t index = 0;                                    ///< into the list of laws
    double squares = std::numeric_limits<double>::infinity(); ///< left, with regularisation
    double score = std::numeric_limits<double>::infinity();   ///< 3 squares + functions ln n + cost
    /// Share of what the free missing rate gains that the law gains too.
    double share = 0;
};

/// Linear least squares about the fit of a set of places.
class law_search {
public:
    /// @param fit  of a set with at least one equation
    law_search(place_fitter& fits, place_fit const& fit) : campaign_(&fits.simulations()) {
        fits.release(fit.set);
        targets_ = fits.targets();
        at_ = fits.vector_of(fit.state);
        auto const smooth = fits.prior();
        residual_lists r;
        if (!campaign_->linearise(at_, r)) return;
        auto const g = at_.global.size();
        for (std::size_t e = 0; e < campaign_->experiments(); ++e) {
            auto const n = static_cast<Eigen::Index>(r[e].size());
            Eigen::VectorXd root(n);
            for (Eigen::Index k = 0; k < n; ++k) {
                root[k] = std::sqrt(fits.kept()[e][static_cast<std::size_t>(k)]);
                samples_ += root[k] > 0 ? 1 : 0;
            }
            residuals_.emplace_back(
                root.cwiseProduct(Eigen::Map<Eigen::VectorXd const>(r[e].data(), n)));
            jacobians_.emplace_back(root.asDiagonal() * campaign_->derivatives(e));
            smooth_.emplace_back(smooth[e].selfadjointView<Eigen::Lower>());
            traces_.push_back(trace_at_knots(*campaign_, e, at_));
            locals_.push_back(jacobians_.back().cols() - g);
        }
        valid_ = true;
    }
    [[nodiscard]] bool valid() const {
        return valid_ && std::none_of(traces_.begin(), traces_.end(),
                                      [](auto const& t) { return t.times.empty(); });
    }
    [[nodiscard]] std::vector<knot_trace> const& traces() const { return traces_; }

    /// Laws for number `c` of the targets of the set; best first.
    /// @param beside  a law that acts besides each of them; none: alone
    [[nodiscard]] std::vector<ranked_law> for_target(std::size_t c, std::vector<law> const& laws,
                                                     law const* beside = nullptr) {
        prepare(c);
        std::vector<ranked_law> result;
        if (!factor_.computed()) return result;
        double const without = squares_with({});
        double whole = 0; // with the free missing rates
        for (std::size_t e = 0; e < residuals_.size(); ++e) {
            whole += residuals_[e].squaredNorm() + at_.local[e].dot(smooth_[e] * at_.local[e]);
        }
        for (std::size_t k = 0; k < laws.size(); ++k) {
            std::vector<std::vector<Eigen::VectorXd>> columns;
            auto const add = [&](law const& one) {
                for (auto const& f : one.functions) {
                    auto& v = columns.emplace_back();
                    for (std::size_t e = 0; e < residuals_.size(); ++e)
                        v.push_back(column(e, c, f[e]));
                }
            };
            add(laws[k]);
            if (beside != nullptr) add(*beside);
            ranked_law own;
            own.index = k;
            own.squares = squares_with(columns);
            if (!std::isfinite(own.squares)) continue;
            double const gain = without - whole;
            own.share = gain > 0 ? (without - own.squares) / gain : 0;
            double const terms =
                static_cast<double>(columns.size()) + (laws[k].regime.empty() ? 0 : 1);
            own.score = 3 * own.squares + terms * std::log(std::max(samples_, 2.0)) + laws[k].cost;
            result.push_back(own);
        }
        std::stable_sort(result.begin(), result.end(),
                         [](auto const& a, auto const& b) { return a.score < b.score; });
        return result;
    }

private:
    [[nodiscard]] Eigen::VectorXd column(std::size_t e, std::size_t c,
                                         std::vector<double> const& f) const {
        auto const g = at_.global.size();
        Eigen::VectorXd sum = Eigen::VectorXd::Zero(residuals_[e].size());
        for (std::size_t k = 0; k < campaign_->knots(e).size(); ++k) {
            sum += f[k] * jacobians_[e].col(g + knot_column(e, k, c));
        }
        return sum;
    }
    [[nodiscard]] Eigen::Index knot_column(std::size_t e, std::size_t k, std::size_t c) const {
        return static_cast<Eigen::Index>(campaign_->free_starts(e) + k * targets_.size() + c);
    }

    /// The system of everything that adapts, without the target that laws replace.
    void prepare(std::size_t replaced) {
        auto const g = at_.global.size();
        Eigen::Index const size = g + keep_columns(replaced);
        Eigen::MatrixXd m = Eigen::MatrixXd::Zero(size, size);
        side_ = Eigen::VectorXd::Zero(size);
        base_ = 0;
        designs_.clear();
        lines_.clear();
        Eigen::Index first = g;
        for (std::size_t e = 0; e < residuals_.size(); ++e) {
            add_experiment(e, first, m);
            first += static_cast<Eigen::Index>(kept_columns_[e].size());
        }
        add_priors(m);
        // More than the elimination rounds by; what nothing depends on stays where it is.
        double const rounding = static_cast<double>(size) * std::numeric_limits<double>::epsilon();
        for (Eigen::Index j = 0; j < size; ++j) m(j, j) += m(j, j) > 0 ? rounding * m(j, j) : 1;
        static_cast<void>(factor_.compute(m));
    }
    /// Of the locals those that are not of the replaced target. @returns how many in all
    [[nodiscard]] Eigen::Index keep_columns(std::size_t replaced) {
        Eigen::Index all = 0;
        kept_columns_.assign(residuals_.size(), {});
        for (std::size_t e = 0; e < residuals_.size(); ++e) {
            auto const starts = static_cast<Eigen::Index>(campaign_->free_starts(e));
            for (Eigen::Index j = 0; j < locals_[e]; ++j) {
                auto const c = static_cast<std::size_t>(j - starts) %
                               std::max<std::size_t>(targets_.size(), 1);
                if (j < starts || c != replaced) kept_columns_[e].push_back(j);
            }
            all += static_cast<Eigen::Index>(kept_columns_[e].size());
        }
        return all;
    }
    /// @param first  row of the experiment's own variables
    void add_experiment(std::size_t e, Eigen::Index first, Eigen::MatrixXd& m) {
        auto const g = at_.global.size();
        auto const& columns = kept_columns_[e];
        auto const own = static_cast<Eigen::Index>(columns.size());
        Eigen::MatrixXd a(residuals_[e].size(), g + own);
        a.leftCols(g) = jacobians_[e].leftCols(g);
        Eigen::VectorXd line = residuals_[e];
        Eigen::VectorXd free = at_.local[e];
        for (Eigen::Index k = 0; k < own; ++k) {
            auto const j = columns[static_cast<std::size_t>(k)];
            a.col(g + k) = jacobians_[e].col(g + j);
            free[j] = 0;
        }
        line -= jacobians_[e].rightCols(locals_[e]) * free; // the replaced rates are taken away
        Eigen::VectorXd const kept = at_.local[e] - free;
        Eigen::VectorXd const pull = smooth_[e] * kept;
        base_ += line.squaredNorm() + kept.dot(pull);
        Eigen::MatrixXd const n = a.transpose() * a;
        m.topLeftCorner(g, g) += n.topLeftCorner(g, g);
        m.block(first, 0, own, g) += n.bottomLeftCorner(own, g);
        m.block(first, first, own, own) += n.bottomRightCorner(own, own);
        Eigen::VectorXd const b = a.transpose() * line;
        side_.head(g) += b.head(g);
        side_.segment(first, own) += b.tail(own);
        for (Eigen::Index k = 0; k < own; ++k) {
            auto const j = columns[static_cast<std::size_t>(k)];
            side_[first + k] += pull[j];
            for (Eigen::Index l = 0; l < own; ++l)
                m(first + k, first + l) += smooth_[e](j, columns[static_cast<std::size_t>(l)]);
        }
        designs_.push_back(std::move(a));
        lines_.push_back(std::move(line));
    }
    /// Parameters should not leave their priors by much.
    void add_priors(Eigen::MatrixXd& m) {
        for (Eigen::Index j = 0; j < at_.global.size(); ++j) {
            double const half = 0.5 * (campaign_->upper().global[j] - campaign_->lower().global[j]);
            double const off = at_.global[j] - campaign_->lower().global[j] - half;
            m(j, j) += 1 / (half * half);
            side_[j] += off / (half * half);
            base_ += off * off / (half * half);
        }
    }

    /// Squares left when some columns with free factors come in.
    [[nodiscard]] double
    squares_with(std::vector<std::vector<Eigen::VectorXd>> const& columns) const {
        auto const g = at_.global.size();
        auto const n = static_cast<Eigen::Index>(columns.size());
        Eigen::MatrixXd b = Eigen::MatrixXd::Zero(side_.size(), n);
        Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(n, n);
        Eigen::VectorXd slope = Eigen::VectorXd::Zero(n);
        for (Eigen::Index i = 0; i < n; ++i) {
            auto const& own = columns[static_cast<std::size_t>(i)];
            Eigen::Index first = g;
            for (std::size_t e = 0; e < own.size(); ++e) {
                Eigen::VectorXd const v = designs_[e].transpose() * own[e];
                b.col(i).head(g) += v.head(g);
                b.col(i).segment(first, v.size() - g) += v.tail(v.size() - g);
                first += v.size() - g;
                slope[i] += own[e].dot(lines_[e]);
                for (Eigen::Index j = 0; j < n; ++j) {
                    gram(i, j) += own[e].dot(columns[static_cast<std::size_t>(j)][e]);
                }
            }
        }
        Eigen::VectorXd const rest = factor_.solve(side_);
        double const without = base_ - side_.dot(rest);
        if (n == 0) return without;
        Eigen::MatrixXd const solved = factor_.solve(b);
        Eigen::MatrixXd left = gram - b.transpose() * solved;
        Eigen::VectorXd const pull = slope - b.transpose() * rest;
        left.diagonal() += 1e-9 * gram.diagonal() + Eigen::VectorXd::Constant(n, 1e-300);
        approximate_cholesky own;
        return own.compute(left) ? without - pull.dot(own.solve(pull).col(0)) : without;
    }

    approximate_campaign* campaign_;
    bool valid_ = false;
    double samples_ = 0, base_ = 0;
    arrow_vector at_;
    std::vector<std::size_t> targets_;
    std::vector<Eigen::VectorXd> residuals_, lines_;
    std::vector<Eigen::MatrixXd> jacobians_, smooth_, designs_;
    std::vector<knot_trace> traces_;
    std::vector<Eigen::Index> locals_;
    std::vector<std::vector<Eigen::Index>> kept_columns_;
    Eigen::VectorXd side_;
    approximate_cholesky factor_;
};

} // namespace sivid

#endif
