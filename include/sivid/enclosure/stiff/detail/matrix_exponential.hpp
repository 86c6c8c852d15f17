// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_STIFF_DETAIL_MATRIX_EXPONENTIAL_HPP
#define SIVID_ENCLOSURE_STIFF_DETAIL_MATRIX_EXPONENTIAL_HPP

#include <sivid/space/matrix.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace sivid {

/// Encloses \f$ e^{h A} \f$ for a matrix of doubles and every h of an interval, by scaling and
/// squaring: with \f$ Z = 2^{-m} h A \f$ and \f$ \|Z\|_\infty \le z \le 1/2 \f$,
///   \f$ e^Z \in \sum_{k<K} Z^k/k! + [-r, r] \f$ entry by entry, \f$ r = 2 z^K / K! \f$.
/// @param terms  K, at least 1; with the default r is below the rounding
/// @given  h >= 0
/// @returns nothing when the entries are not finite, or too large
/// @cost  O((K + m) n^3)
/// @ref   Higham, Functions of Matrices (2008), section 10.3
template <class I>
[[nodiscard]] std::optional<interval_matrix<I>>
enclose_exponential(Eigen::MatrixXd const& a, I const& h, std::size_t terms = 16) {
    using traits = interval_traits<I>;
    auto const n = static_cast<std::size_t>(a.rows());
    double size = 0;
    for (std::size_t l = 0; l < traits::lanes; ++l) size = std::max(size, traits::upper(h, l));
    double const norm = (a.array().abs().rowwise().sum().maxCoeff()) * size;
    if (!std::isfinite(norm) || norm > 1e9) return std::nullopt;
    int const squarings = norm > 0.4 ? static_cast<int>(std::ceil(std::log2(norm / 0.4))) : 0;
    I const scale = traits::mul(h, traits::point(std::ldexp(1.0, -squarings)));
    interval_matrix<I> z(n, n);
    I largest = traits::point(0.0);
    for (std::size_t i = 0; i < n; ++i) {
        I row = traits::point(0.0);
        for (std::size_t j = 0; j < n; ++j) {
            auto const entry = a(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
            z(i, j) = traits::mul(scale, traits::point(entry));
            row = traits::add(row, traits::abs(z(i, j)));
        }
        largest = traits::max(largest, row);
    }
    // Horner's rule, with the remainder first.
    typename traits::mask never{};
    I remainder = traits::point(2.0);
    for (std::size_t k = 1; k <= terms; ++k) {
        remainder = traits::div(traits::mul(remainder, largest),
                                traits::point(static_cast<double>(k)), never);
    }
    for (std::size_t l = 0; l < traits::lanes; ++l) {
        if (!(traits::upper(largest, l) <= 0.5)) return std::nullopt;
    }
    interval_matrix<I> sum = interval_matrix<I>::identity(n);
    for (std::size_t k = terms - 1; k >= 1; --k) {
        sum = product(z, sum);
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = 0; j < n; ++j) {
                sum(i, j) = traits::div(sum(i, j), traits::point(static_cast<double>(k)), never);
            }
            sum(i, i) = traits::add(sum(i, i), traits::point(1.0));
        }
    }
    I const spread = traits::hull(traits::neg(remainder), remainder);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) sum(i, j) = traits::add(sum(i, j), spread);
    }
    for (int k = 0; k < squarings; ++k) sum = product(sum, sum);
    return sum;
}

/// Upper bounds of the entries of \f$ e^{h M} \f$, for a matrix M whose entries off the diagonal
/// are not negative: so are those of its exponential.
template <class I = interval>
[[nodiscard]] std::optional<Eigen::MatrixXd> bound_exponential(Eigen::MatrixXd const& m,
                                                               I const& h) {
    auto const e = enclose_exponential<I>(m, h);
    if (!e) return std::nullopt;
    Eigen::MatrixXd result(m.rows(), m.cols());
    for (std::size_t i = 0; i < e->rows(); ++i) {
        for (std::size_t j = 0; j < e->cols(); ++j) {
            double top = 0;
            for (std::size_t l = 0; l < interval_traits<I>::lanes; ++l) {
                top = std::max(top, interval_traits<I>::upper((*e)(i, j), l));
            }
            if (!std::isfinite(top)) return std::nullopt;
            result(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = top;
        }
    }
    return result;
}

} // namespace sivid

#endif
