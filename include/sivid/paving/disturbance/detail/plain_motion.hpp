// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_DISTURBANCE_DETAIL_PLAIN_MOTION_HPP
#define SIVID_PAVING_DISTURBANCE_DETAIL_PLAIN_MOTION_HPP

#include <sivid/number/interval.hpp>
#include <sivid/paving/disturbance/detail/disturbed_motion.hpp>
#include <sivid/space/dense.hpp>

#include <Eigen/Core>

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
    };
    std::vector<cell> cells;

    explicit plain_motion(disturbed_motion const& m) {
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
            cells.push_back(std::move(p));
        }
    }
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
