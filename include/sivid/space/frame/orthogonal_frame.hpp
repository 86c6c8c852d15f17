// SPDX-License-Identifier: MIT
#ifndef SIVID_SPACE_FRAME_ORTHOGONAL_FRAME_HPP
#define SIVID_SPACE_FRAME_ORTHOGONAL_FRAME_HPP

#include <sivid/compiled.hpp>
#include <sivid/space/detail/compiled_eigen.hpp>
#include <sivid/space/matrix.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace sivid {

/// A matrix D Q of doubles, Q orthogonal up to rounding and D diagonal, with a proven enclosure of
/// its inverse.
template <class I>
struct orthogonal_frame {
    Eigen::MatrixXd axes;
    interval_matrix<I> inverse;
};

/// Encloses \f$ B^{-1} \f$ from a matrix X near it.
///   With \f$ E = X B - I \f$ and \f$ e = \|E\|_\infty < 1 \f$, B is invertible and
///   \f$ B^{-1} = (I + E)^{-1} X \in X + [-d, d] \, \mathbf{1} \, |X| \f$, \f$ d = e/(1-e) \f$.
/// @returns false when e could not be proved below 1/2; `inverse` is then not to be used.
template <class I>
[[nodiscard]] bool enclose_inverse(Eigen::MatrixXd const& b, Eigen::MatrixXd const& x,
                                   interval_matrix<I>& inverse) {
    using traits = interval_traits<I>;
    auto const n = static_cast<std::size_t>(b.rows());
    auto const entry = [](Eigen::MatrixXd const& of, std::size_t i, std::size_t j) {
        return traits::point(of(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
    };
    double e = 0;
    for (std::size_t i = 0; i < n; ++i) {
        I row = traits::point(0.0);
        for (std::size_t j = 0; j < n; ++j) {
            I dot = traits::point(i == j ? -1.0 : 0.0);
            for (std::size_t k = 0; k < n; ++k) {
                dot = traits::add(dot, traits::mul(entry(x, i, k), entry(b, k, j)));
            }
            row = traits::add(row, traits::abs(dot));
        }
        for (std::size_t l = 0; l < traits::lanes; ++l) {
            if (!(traits::upper(row, l) < 0.5)) return false; // also for NaN
            e = std::max(e, traits::upper(row, l));
        }
    }
    // d = e / (1 - e) <= 2 e, and doubling is exact.
    I const d = traits::bounds(-2 * e, 2 * e);
    inverse = interval_matrix<I>(n, n);
    for (std::size_t j = 0; j < n; ++j) {
        I column = traits::point(0.0);
        for (std::size_t i = 0; i < n; ++i)
            column = traits::add(column, traits::abs(entry(x, i, j)));
        I const spread = traits::mul(d, column);
        for (std::size_t i = 0; i < n; ++i) inverse(i, j) = traits::add(entry(x, i, j), spread);
    }
    return true;
}
/// The same of a nearly orthogonal matrix.
template <class I>
[[nodiscard]] bool enclose_inverse(Eigen::MatrixXd const& q, interval_matrix<I>& inverse) {
    return enclose_inverse<I>(q, q.transpose(), inverse);
}

/// Nearly orthogonal axes whose first ones follow the longest columns of `a`, so that boxing along
/// them wraps least; the identity when `a` is not finite or the factorisation fails. Nothing is
/// proved.
/// @param a        n x n
/// @param weights  the length of each column in the set to be carried, n values
/// @cost  O(n^3)
/// @ref   Lohner 1987 (QR with column pivoting by size); Nedialkov and Jackson 2001, section 3.
[[nodiscard]] SIVID_DECL Eigen::MatrixXd orthogonal_axes(Eigen::MatrixXd const& a,
                                                         std::vector<double> const& weights);

/// `orthogonal_axes` with a proven inverse; the identity where that fails.
/// @param sizes  of the rows, above 0: axes are orthogonal where rows are measured in them,
/// whatever
///   the rows' units; none: as they are
/// @guarantee  `inverse` encloses the inverse of `axes`; no property of `a` is trusted.
template <class I>
[[nodiscard]] orthogonal_frame<I> make_frame(Eigen::MatrixXd const& a,
                                             std::vector<double> const& weights,
                                             std::vector<double> const& sizes = {}) {
    auto const n = a.rows();
    Eigen::VectorXd scale = Eigen::VectorXd::Ones(n);
    for (std::size_t i = 0; i < sizes.size(); ++i) scale[static_cast<Eigen::Index>(i)] = sizes[i];
    Eigen::MatrixXd const measured = scale.cwiseInverse().asDiagonal() * a;
    Eigen::MatrixXd const q = orthogonal_axes(measured, weights);
    Eigen::MatrixXd axes = scale.asDiagonal() * q;
    Eigen::MatrixXd const near = q.transpose() * scale.cwiseInverse().asDiagonal();
    interval_matrix<I> inverse;
    if (enclose_inverse<I>(axes, near, inverse)) return {std::move(axes), std::move(inverse)};
    return {Eigen::MatrixXd::Identity(n, n),
            interval_matrix<I>::identity(static_cast<std::size_t>(n))};
}

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/space/frame/impl/orthogonal_frame.ipp>
#endif

#endif
