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

/// A matrix Q of doubles that is orthogonal up to rounding, with a proven enclosure of its inverse.
template <class I>
struct orthogonal_frame {
    Eigen::MatrixXd axes;
    interval_matrix<I> inverse;
};

/// Encloses \f$ Q^{-1} \f$ of a nearly orthogonal matrix.
///   With \f$ E = Q^T Q - I \f$ and \f$ e = \|E\|_\infty < 1 \f$, Q is invertible and
///   \f$ Q^{-1} = (I + E)^{-1} Q^T \in Q^T + [-d, d] \, \mathbf{1} \, |Q^T| \f$, \f$ d = e/(1-e)
///   \f$.
/// @returns false when e could not be proved below 1/2; `inverse` is then not to be used.
template <class I>
[[nodiscard]] bool enclose_inverse(Eigen::MatrixXd const& q, interval_matrix<I>& inverse) {
    using traits = interval_traits<I>;
    auto const n = static_cast<std::size_t>(q.rows());
    auto const entry = [&q](std::size_t i, std::size_t j) {
        return traits::point(q(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
    };
    double e = 0;
    for (std::size_t i = 0; i < n; ++i) {
        I row = traits::point(0.0);
        for (std::size_t j = 0; j < n; ++j) {
            I dot = traits::point(i == j ? -1.0 : 0.0);
            for (std::size_t k = 0; k < n; ++k) {
                dot = traits::add(dot, traits::mul(entry(k, i), entry(k, j)));
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
        for (std::size_t i = 0; i < n; ++i) column = traits::add(column, traits::abs(entry(j, i)));
        I const spread = traits::mul(d, column);
        for (std::size_t i = 0; i < n; ++i) inverse(i, j) = traits::add(entry(j, i), spread);
    }
    return true;
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
/// @guarantee  `inverse` encloses the inverse of `axes`; no property of `a` is trusted.
template <class I>
[[nodiscard]] orthogonal_frame<I> make_frame(Eigen::MatrixXd const& a,
                                             std::vector<double> const& weights) {
    auto const n = a.rows();
    auto q = orthogonal_axes(a, weights);
    interval_matrix<I> inverse;
    if (enclose_inverse<I>(q, inverse)) return {std::move(q), std::move(inverse)};
    return {Eigen::MatrixXd::Identity(n, n),
            interval_matrix<I>::identity(static_cast<std::size_t>(n))};
}

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/space/frame/impl/orthogonal_frame.ipp>
#endif

#endif
