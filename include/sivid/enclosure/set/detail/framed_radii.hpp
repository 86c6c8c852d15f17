// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_SET_DETAIL_FRAMED_RADII_HPP
#define SIVID_ENCLOSURE_SET_DETAIL_FRAMED_RADII_HPP

#include <sivid/space/frame/orthogonal_frame.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace sivid {

/// What is not known of the columns of a matrix that linear maps carry along: column c lies within
/// \f$ B [-\rho_c, \rho_c] \f$, with one nearly orthogonal frame B for all columns, so that radii
/// do not wrap from step to step. Radii need no intervals: products of absolute values and bounds
/// of roundings do, in any rounding mode.
/// @ref  Lohner 1987; Zgliczynski 2002 (C1-Lohner); Rump 1999 (midpoint-radius products)
class framed_radii {
    using matrix = Eigen::MatrixXd;

public:
    framed_radii() = default;
    framed_radii(std::size_t n, std::size_t columns)
        : axes_(matrix::Identity(index(n), index(n))),
          radii_(matrix::Zero(index(n), index(columns))) {}

    /// The whole of \f$ \{ A B r_c + d_c \} \f$ for \f$ |A - centre| \le spread \f$,
    /// \f$ |r_c| \le \rho_c, |d_c| \le rest_c \f$, in a new frame.
    /// @param units  powers of two in which rows are measured where the frame is to be orthogonal;
    ///               none: 1
    /// @given  no entry of `spread` and `rest` is negative
    void map(matrix centre, matrix spread, matrix rest, std::vector<double> const& units = {}) {
        auto const n = axes_.rows();
        for (auto* rows : {&centre, &spread, &rest}) {
            for (std::size_t i = 0; i < units.size(); ++i) rows->row(index(i)) /= units[i];
        }
        // Of a product of n by n matrices, in units of the product of the absolute values.
        double const rounding = static_cast<double>(n + 2) * unit;
        std::vector<double> weights(static_cast<std::size_t>(n), 0.0);
        for (Eigen::Index c = 0; c < radii_.cols(); ++c) {
            double const most = radii_.col(c).maxCoeff(); // columns may have units of their own
            for (Eigen::Index i = 0; i < n && most > 0; ++i) {
                auto& w = weights[static_cast<std::size_t>(i)];
                w = std::max(w, radii_(i, c) / most);
            }
        }
        matrix const turned = centre.lazyProduct(axes_);
        matrix axes = orthogonal_axes(turned, weights);
        double excess = distance(axes);
        if (!(excess < 1)) {
            axes = matrix::Identity(n, n);
            excess = 0;
        }
        // |Y|, Y = Q^T A B: what was computed; roundings of Q^T W; those of W = A B, and A's
        // spread. Then |Q^-1 A B| and |Q^-1|.
        matrix const size = axes.transpose().cwiseAbs();
        matrix const doubt = (spread + rounding * centre.cwiseAbs()).lazyProduct(axes_.cwiseAbs());
        matrix along = axes.transpose().lazyProduct(turned).cwiseAbs();
        along += size.lazyProduct(doubt + rounding * turned.cwiseAbs());
        matrix inverse = size;
        for (Eigen::Index j = 0; j < n; ++j) {
            add_excess(along, j, excess);
            add_excess(inverse, j, excess);
        }
        matrix const carried = along.lazyProduct(radii_);
        matrix const added = inverse.lazyProduct(rest);
        for (Eigen::Index c = 0; c < radii_.cols(); ++c) {
            if (is_zero(radii_, c) && is_zero(rest, c)) continue;
            for (Eigen::Index i = 0; i < n; ++i) {
                double const r = (carried(i, c) + added(i, c)) * up + tiny;
                radii_(i, c) = r < largest ? r : infinity; // NaN as well
            }
        }
        for (std::size_t i = 0; i < units.size(); ++i) axes.row(index(i)) *= units[i];
        axes_ = std::move(axes);
    }

    /// A bound of \f$ |B r_c|_i \f$.
    [[nodiscard]] double operator()(std::size_t i, std::size_t c) const {
        if (is_zero(radii_, index(c))) return 0;
        double sum = 0;
        for (Eigen::Index k = 0; k < axes_.rows(); ++k) {
            sum += std::abs(axes_(index(i), k)) * radii_(k, index(c));
        }
        double const r = sum * up + tiny;
        return r < largest ? r : infinity;
    }

private:
    static constexpr double unit = std::numeric_limits<double>::epsilon();
    /// Makes computed sums of a few dozen non-negative numbers upper bounds.
    static constexpr double up = 1 + 1e-12;
    /// More than all underflows, times anything that counts as known.
    static constexpr double tiny = 1e-290;
    static constexpr double largest = 1e300;
    static constexpr double infinity = std::numeric_limits<double>::infinity();

    static Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }
    /// d of `enclose_inverse`: \f$ \|Q^{-1} - Q^T\| \f$ relative to \f$ Q^T \f$.
    static double distance(matrix const& q) {
        auto const n = q.rows();
        double const rounding = static_cast<double>(n + 2) * unit;
        matrix const square = q.transpose().lazyProduct(q);
        matrix const sizes = q.transpose().cwiseAbs().lazyProduct(q.cwiseAbs());
        double e = 0;
        for (Eigen::Index i = 0; i < n; ++i) {
            double row = tiny;
            for (Eigen::Index j = 0; j < n; ++j) {
                row += std::abs(square(i, j) - (i == j ? 1.0 : 0.0)) + rounding * sizes(i, j);
            }
            if (!(row < 0.5)) return infinity; // NaN as well
            e = std::max(e, row);
        }
        return 2 * e * up; // e / (1 - e) <= 2 e
    }
    static bool is_zero(matrix const& a, Eigen::Index c) { return (a.col(c).array() == 0).all(); }
    /// Column j of a matrix Y of absolute values becomes that of (1 + F) Y, |F| at most `excess`.
    static void add_excess(matrix& y, Eigen::Index j, double excess) {
        double const more = y.col(j).sum() * excess + tiny;
        for (Eigen::Index i = 0; i < y.rows(); ++i) {
            double const x = (y(i, j) + more) * up;
            // What may have overflowed on the way has left a rounding bound of that size.
            y(i, j) = x < 1e280 ? x : infinity;
        }
    }

    matrix axes_;  ///< B
    matrix radii_; ///< \f$ \rho \f$
};

} // namespace sivid

#endif
