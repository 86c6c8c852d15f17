// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_STIFF_DETAIL_MATRIX_EXPONENTIAL_HPP
#define SIVID_ENCLOSURE_STIFF_DETAIL_MATRIX_EXPONENTIAL_HPP

#include <sivid/space/matrix.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

namespace enclosure_detail {

/// Turns A into \f$ D^{-1} A D \f$, D diagonal of powers of two, whose rows and columns are about
/// as large as each other: as small as the units of its rows allow. What only acts, or is only
/// acted on, is measured so that it is as large as the rest.
/// @param h  the time of the exponential; a rate for matrices that have none of their own
/// @returns  D. No entry is rounded, but for those that leave the normal numbers: then A stays.
/// @ref  Osborne 1960; Parlett and Reinsch 1969
[[nodiscard]] inline std::vector<double> balance(Eigen::MatrixXd& a, double h) {
    auto const n = a.rows();
    std::vector<double> d(static_cast<std::size_t>(n), 1.0);
    if (n < 2 || !a.allFinite()) return d;
    auto const before = a;
    auto const sums = [&](Eigen::Index i) {
        double const own = std::abs(a(i, i));
        return std::pair{a.row(i).cwiseAbs().sum() - own, a.col(i).cwiseAbs().sum() - own};
    };
    auto const scale = [&](Eigen::Index i, double ratio) {
        double const f = std::ldexp(1.0, std::ilogb(ratio));
        if (!(f > 1e-60 && f < 1e60)) return;
        a.col(i) *= f;
        a.row(i) /= f;
        d[static_cast<std::size_t>(i)] *= f;
    };
    for (int sweep = 0; sweep < 6; ++sweep) {
        for (Eigen::Index i = 0; i < n; ++i) {
            auto const [row, column] = sums(i);
            if (row > 0 && column > 0) scale(i, std::sqrt(row / column));
        }
    }
    double rate = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
        auto const [row, column] = sums(i);
        rate = std::max({rate, std::abs(a(i, i)), std::sqrt(row) * std::sqrt(column)});
    }
    if (!(rate > 0)) rate = 1 / h;
    for (Eigen::Index i = 0; i < n; ++i) {
        auto const [row, column] = sums(i);
        if (column > 0 && !(row > 0)) scale(i, rate / column);
        if (row > 0 && !(column > 0)) scale(i, row / rate);
    }
    for (Eigen::Index i = 0; i < n; ++i) {
        for (Eigen::Index j = 0; j < n; ++j) {
            double const f = d[static_cast<std::size_t>(j)] / d[static_cast<std::size_t>(i)];
            if (a(i, j) == before(i, j) * f && a(i, j) / f == before(i, j)) continue;
            a = before;
            d.assign(d.size(), 1.0);
            return d;
        }
    }
    return d;
}

} // namespace enclosure_detail

/// Encloses \f$ e^{h A} \f$ for a matrix of doubles and every h of an interval, by scaling and
/// squaring: with \f$ Z = 2^{-m} h A \f$ and \f$ \|Z\|_\infty \le z \le 1/2 \f$,
///   \f$ e^Z \in \sum_{k<K} Z^k/k! + [-r, r] \f$ entry by entry, \f$ r = 2 z^K / K! \f$.
///   A norm means little where the rows have units of their own, so all is done for
///   \f$ D^{-1} A D \f$ with a diagonal D of powers of two (`balance`).
/// @param terms  K, at least 1; with the default r is below the rounding
/// @given  h >= 0
/// @returns nothing when the entries are not finite, or too large
/// @cost  O((K + m) n^3)
/// @ref   Higham, Functions of Matrices (2008), section 10.3
template <class I>
[[nodiscard]] std::optional<interval_matrix<I>> enclose_exponential(Eigen::MatrixXd a, I const& h,
                                                                    std::size_t terms = 16) {
    using traits = interval_traits<I>;
    auto const n = static_cast<std::size_t>(a.rows());
    double size = 0;
    for (std::size_t l = 0; l < traits::lanes; ++l) size = std::max(size, traits::upper(h, l));
    auto const d = enclosure_detail::balance(a, size);
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
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j)
            sum(i, j) = traits::mul(sum(i, j), traits::point(d[i] / d[j]));
    }
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
