// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_DISTURBANCE_DETAIL_PLAIN_MOTION_HPP
#define SIVID_PAVING_DISTURBANCE_DETAIL_PLAIN_MOTION_HPP

#include <sivid/number/interval.hpp>
#include <sivid/paving/disturbance/detail/disturbed_motion.hpp>
#include <sivid/space/dense.hpp>

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace sivid::paving_detail {

/// A motion in plain doubles, at the middles of what is known of its cells, by the trapezoidal
/// rule: \f$ z_{k+1} = \Phi z_k + M^{-1} h (F \pi + c + d) \f$ with \f$ M = 1 - h J/2 \f$. The
/// weights that belong to it, backward, run along straight lines in each cell.
struct plain_motion {
    struct cell {
        double length = 0;
        Eigen::MatrixXd step, kick, by_parameter; ///< Phi, M^-1 h, F
        Eigen::VectorXd defect;
        Eigen::VectorXd left; ///< what the middles leave open of z', at most; or none
    };
    std::vector<cell> cells;

    /// @param away  of parameters from the middle: what is left open then counts; or none
    explicit plain_motion(disturbed_motion const& m, std::vector<interval> const& away = {}) {
        auto const n = static_cast<Eigen::Index>(m.beside.front().size());
        Eigen::MatrixXd const one = Eigen::MatrixXd::Identity(n, n);
        for (auto const& c : m.cells) {
            cell p;
            p.length = mid(c.length);
            auto const j = middles(c.by_state, n);
            p.kick = approximate_inverse(one - 0.5 * p.length * j);
            p.step = p.kick * (one + 0.5 * p.length * j);
            p.kick *= p.length;
            p.by_parameter = middles(c.by_parameter, n);
            p.defect = middles(c.defect, n);
            if (!away.empty()) p.left = left_open(c, away);
            cells.push_back(std::move(p));
        }
    }
    [[nodiscard]] static Eigen::VectorXd left_open(disturbed_cell const& c,
                                                   std::vector<interval> const& away) {
        auto const n = c.defect.size();
        Eigen::VectorXd result(static_cast<Eigen::Index>(n));
        for (std::size_t i = 0; i < n; ++i) {
            double sum = rad(c.defect[i]) + mag(c.rough[i]);
            for (std::size_t j = 0; j < n; ++j)
                sum += product(rad(c.by_state[i * n + j]), mag(c.beside[j]));
            for (std::size_t j = 0; j < away.size(); ++j)
                sum += product(rad(c.by_parameter[i * away.size() + j]), mag(away[j]));
            result[static_cast<Eigen::Index>(i)] = std::isfinite(sum) ? sum : 1e100;
        }
        return result;
    }
    [[nodiscard]] static double product(double a, double b) { return a == 0 ? 0 : a * b; }
    /// Of numbers in so many rows; 0 where there is no middle.
    [[nodiscard]] static Eigen::MatrixXd middles(std::vector<interval> const& x,
                                                 Eigen::Index rows) {
        auto const columns = rows == 0 ? 0 : static_cast<Eigen::Index>(x.size()) / rows;
        Eigen::MatrixXd result(rows, columns);
        for (Eigen::Index i = 0; i < rows; ++i) {
            for (Eigen::Index j = 0; j < columns; ++j) {
                auto const& v = x[static_cast<std::size_t>(i * columns + j)];
                result(i, j) = is_bounded(v) ? mid(v) : 0.0;
            }
        }
        return result;
    }
};

} // namespace sivid::paving_detail

#endif
