// SPDX-License-Identifier: MIT
#ifndef SIVID_SPACE_EXACT_IMPL_RATIONAL_BASIS_IPP
#define SIVID_SPACE_EXACT_IMPL_RATIONAL_BASIS_IPP

#include <sivid/space/dense.hpp>
#include <sivid/space/exact/detail/rational_basis.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

SIVID_DECL std::optional<std::vector<int>> approximate_integers(Eigen::VectorXd const& v,
                                                                double tolerance, int largest) {
    double const size = v.size() == 0 ? 0.0 : v.cwiseAbs().maxCoeff();
    if (!(size > 0) || !std::isfinite(size)) return std::nullopt;
    for (int whole = 1; whole <= largest; ++whole) {
        Eigen::VectorXd const scaled = v * (whole / size);
        std::vector<int> result;
        double off = 0;
        for (Eigen::Index j = 0; j < v.size(); ++j) {
            double const near = std::round(scaled(j));
            off = std::max(off, std::abs(scaled(j) - near));
            result.push_back(static_cast<int>(near));
        }
        if (off > tolerance * whole) continue;
        auto const first = std::find_if(result.begin(), result.end(), [](int k) { return k != 0; });
        if (*first < 0) {
            for (int& k : result) k = -k;
        }
        return result;
    }
    return std::nullopt;
}

SIVID_DECL std::vector<std::vector<int>> approximate_integer_basis(Eigen::MatrixXd const& basis,
                                                                   double tolerance, int largest) {
    Eigen::MatrixXd m = basis.transpose();
    std::vector<std::pair<Eigen::Index, Eigen::Index>> pivots; // column, row
    for (Eigen::Index r = 0; r < m.rows(); ++r) {
        auto const rest = m.bottomRows(m.rows() - r);
        double const size = rest.cwiseAbs().maxCoeff();
        if (!(size > 0)) break;
        // The first column with a pivot large enough, so that the form does not depend on rounding.
        Eigen::Index column = 0;
        while (!(rest.col(column).cwiseAbs().maxCoeff() > 0.3 * size)) ++column;
        Eigen::Index row = 0;
        rest.col(column).cwiseAbs().maxCoeff(&row);
        m.row(r).swap(m.row(r + row));
        m.row(r) /= m(r, column);
        for (Eigen::Index i = 0; i < m.rows(); ++i) {
            if (i != r) m.row(i) -= m(i, column) * m.row(r);
        }
        pivots.emplace_back(column, r);
    }
    std::sort(pivots.begin(), pivots.end());
    std::vector<std::vector<int>> result;
    for (auto const& [column, row] : pivots) {
        auto found = approximate_integers(m.row(row).transpose(), tolerance, largest);
        if (found) result.push_back(std::move(*found));
    }
    return result;
}

SIVID_DECL Eigen::MatrixXd orthogonal_complement(std::vector<std::vector<int>> const& vectors,
                                                 std::size_t dimension) {
    auto const n = static_cast<Eigen::Index>(dimension);
    if (vectors.empty()) return Eigen::MatrixXd::Identity(n, n);
    Eigen::MatrixXd m(n, static_cast<Eigen::Index>(vectors.size()));
    for (std::size_t k = 0; k < vectors.size(); ++k) {
        for (std::size_t j = 0; j < dimension; ++j) {
            m(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(k)) = vectors[k][j];
        }
    }
    return approximate_complement(m);
}

} // namespace sivid

#endif
