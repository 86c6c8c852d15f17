// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_FIT_DETAIL_ARROW_SYSTEM_HPP
#define SIVID_APPROXIMATE_FIT_DETAIL_ARROW_SYSTEM_HPP

#include <sivid/space/dense.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <limits>
#include <vector>

namespace sivid {

/// Values of global variables, which all experiments share, and of each experiment's own ones.
struct arrow_vector {
    Eigen::VectorXd global;
    std::vector<Eigen::VectorXd> local;

    [[nodiscard]] std::size_t size() const {
        auto n = global.size();
        for (auto const& l : local) n += l.size();
        return static_cast<std::size_t>(n);
    }
    [[nodiscard]] bool all_finite() const {
        bool finite = global.allFinite();
        for (auto const& l : local) finite = finite && l.allFinite();
        return finite;
    }
    /// Calls f(a, b, ...) for the same entry of all of them.
    template <class F, class... Others>
    void for_each(F const& f, Others&&... others) {
        for (Eigen::Index i = 0; i < global.size(); ++i) f(global[i], others.global[i]...);
        for (std::size_t e = 0; e < local.size(); ++e) {
            for (Eigen::Index i = 0; i < local[e].size(); ++i) {
                f(local[e][i], others.local[e][i]...);
            }
        }
    }
    [[nodiscard]] static arrow_vector like(arrow_vector const& shape, double value) {
        auto result = shape;
        result.for_each([value](double& v) { v = value; });
        return result;
    }
};

/// A symmetric positive definite system of block arrow shape: experiments are coupled through the
/// global variables alone, so that each experiment's own variables are eliminated by themselves.
/// Experiment e contributes a matrix over (globals, its locals), lower triangle, and a right side.
/// @cost  sum of locals^3 / 3, instead of the cube of them all
class arrow_system {
public:
    void reset(Eigen::Index globals, std::vector<Eigen::Index> const& locals) {
        globals_ = globals;
        matrices_.resize(locals.size());
        sides_.resize(locals.size());
        for (std::size_t e = 0; e < locals.size(); ++e) {
            matrices_[e].setZero(globals + locals[e], globals + locals[e]);
            sides_[e].setZero(globals + locals[e]);
        }
    }
    [[nodiscard]] Eigen::Index globals() const { return globals_; }
    [[nodiscard]] std::size_t experiments() const { return matrices_.size(); }
    [[nodiscard]] Eigen::MatrixXd& matrix(std::size_t e) { return matrices_[e]; }
    [[nodiscard]] Eigen::VectorXd& side(std::size_t e) { return sides_[e]; }

    /// Solves (matrix + damping diagonal) x = side. Variables for which `held` is not 0 stay 0, and
    /// so do those of which nothing depends. In other units of the variables the solution is the
    /// same in these: nothing is added to a diagonal but shares of itself.
    /// @returns false when a pivot is not positive
    [[nodiscard]] bool solve(double damping, arrow_vector const& held, arrow_vector& x) {
        auto const g = globals_;
        Eigen::MatrixXd schur = Eigen::MatrixXd::Zero(g, g);
        Eigen::VectorXd right = Eigen::VectorXd::Zero(g);
        Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(g);
        factors_.resize(matrices_.size());
        coupled_.resize(matrices_.size());
        for (std::size_t e = 0; e < matrices_.size(); ++e) {
            auto const& n = matrices_[e];
            auto const l = n.rows() - g;
            schur.triangularView<Eigen::Lower>() += n.topLeftCorner(g, g);
            right += sides_[e].head(g);
            if (l == 0) continue;
            Eigen::MatrixXd own = n.bottomRightCorner(l, l);
            Eigen::MatrixXd& z = coupled_[e];
            z.resize(l, g + 1);
            z.leftCols(g) = n.bottomLeftCorner(l, g);
            z.col(g) = sides_[e].tail(l);
            damp(own, damping);
            for (Eigen::Index i = 0; i < l; ++i) {
                if (held.local[e][i] != 0) hold(own, z, i);
            }
            if (!factors_[e].compute(own)) return false;
            z = factors_[e].solve_lower(z);
            schur.selfadjointView<Eigen::Lower>().rankUpdate(z.leftCols(g).transpose(), -1.0);
            right -= z.leftCols(g).transpose() * z.col(g);
        }
        for (std::size_t e = 0; e < matrices_.size() && g > 0; ++e) {
            diagonal += matrices_[e].diagonal().head(g);
        }
        for (Eigen::Index i = 0; i < g; ++i)
            schur(i, i) += damped(diagonal[i], damping, matrices_.front().rows());
        for (Eigen::Index i = 0; i < g; ++i) {
            if (held.global[i] == 0) continue;
            schur.row(i).setZero();
            schur.col(i).setZero();
            schur(i, i) = 1;
            right[i] = 0;
        }
        if (g > 0) {
            if (!top_.compute(schur)) return false;
            x.global = top_.solve(right);
        } else {
            x.global.resize(0);
        }
        x.local.resize(matrices_.size());
        for (std::size_t e = 0; e < matrices_.size(); ++e) {
            auto const l = matrices_[e].rows() - g;
            x.local[e].resize(l);
            if (l == 0) continue;
            x.local[e] =
                factors_[e].solve_upper(coupled_[e].col(g) - coupled_[e].leftCols(g) * x.global);
            for (Eigen::Index i = 0; i < l; ++i) {
                if (held.local[e][i] != 0) x.local[e][i] = 0;
            }
        }
        return x.all_finite();
    }

    /// Experiment e's own block of the inverse, after a successful `solve`.
    [[nodiscard]] Eigen::MatrixXd local_inverse(std::size_t e) const {
        auto const l = matrices_[e].rows() - globals_;
        if (l == 0) return {};
        Eigen::MatrixXd inverse = factors_[e].solve(Eigen::MatrixXd::Identity(l, l));
        if (globals_ > 0) {
            auto const spread = factors_[e].solve_upper(coupled_[e].leftCols(globals_));
            inverse += spread * top_.solve(spread.transpose());
        }
        return inverse;
    }

private:
    /// What is added to an entry of a diagonal: a share of it that is more than the rounding errors
    /// of an elimination of so many rows, and the damping. An entry of 0 has a row of zeros.
    [[nodiscard]] static double damped(double entry, double damping, Eigen::Index rows) {
        if (!(entry > 0)) return 1;
        constexpr double unit = std::numeric_limits<double>::epsilon();
        return (damping + static_cast<double>(rows) * unit) * entry;
    }
    static void damp(Eigen::MatrixXd& own, double damping) {
        auto const rows = own.rows();
        for (Eigen::Index i = 0; i < rows; ++i) own(i, i) += damped(own(i, i), damping, rows);
    }
    static void hold(Eigen::MatrixXd& own, Eigen::MatrixXd& right, Eigen::Index i) {
        own.row(i).setZero();
        own.col(i).setZero();
        own(i, i) = 1;
        right.row(i).setZero();
    }

    Eigen::Index globals_ = 0;
    std::vector<Eigen::MatrixXd> matrices_;
    std::vector<Eigen::VectorXd> sides_;
    std::vector<approximate_cholesky> factors_;
    std::vector<Eigen::MatrixXd> coupled_; ///< L^-1 (coupling, side)
    approximate_cholesky top_;
};

} // namespace sivid

#endif
