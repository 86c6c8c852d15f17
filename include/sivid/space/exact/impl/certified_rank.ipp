// SPDX-License-Identifier: MIT
#ifndef SIVID_SPACE_EXACT_IMPL_CERTIFIED_RANK_IPP
#define SIVID_SPACE_EXACT_IMPL_CERTIFIED_RANK_IPP

#include <sivid/number/text/needed_given.hpp>
#include <sivid/space/dense.hpp>
#include <sivid/space/exact/detail/certified_rank.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sivid {

namespace space_detail {

/// A without the rows that say nothing: unbounded or empty ones.
SIVID_DECL interval_matrix<interval> bounded_rows(interval_matrix<interval> const& a,
                                                  std::vector<double>& weights) {
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < a.rows(); ++i) {
        bool bounded = true;
        for (std::size_t j = 0; j < a.cols(); ++j) bounded = bounded && std::isfinite(mag(a(i, j)));
        if (bounded) kept.push_back(i);
    }
    interval_matrix<interval> result(kept.size(), a.cols());
    std::vector<double> w(kept.size());
    for (std::size_t i = 0; i < kept.size(); ++i) {
        w[i] = weights[kept[i]];
        for (std::size_t j = 0; j < a.cols(); ++j) result(i, j) = a(kept[i], j);
    }
    weights = std::move(w);
    return result;
}

/// An upper bound of \f$ \| 1 - B \|_\infty \f$ over the leading r x r block of B.
SIVID_DECL double distance_from_identity(interval_matrix<interval> const& b, std::size_t r) {
    using traits = interval_traits<interval>;
    double largest = 0;
    for (std::size_t i = 0; i < r; ++i) {
        auto sum = traits::point(0.0);
        for (std::size_t j = 0; j < r; ++j) {
            auto const off = traits::sub(b(i, j), traits::point(i == j ? 1.0 : 0.0));
            sum = traits::add(sum, traits::abs(off));
        }
        if (!std::isfinite(sum.upper())) return HUGE_VAL;
        largest = std::max(largest, sum.upper());
    }
    return largest;
}

} // namespace space_detail

SIVID_DECL std::size_t certified_rank(interval_matrix<interval> const& a,
                                      std::vector<double> weights) {
    using traits = interval_traits<interval>;
    if (weights.empty()) weights.assign(a.rows(), 1.0);
    if (weights.size() != a.rows())
        throw std::invalid_argument("certified_rank: one weight per row" +
                                    needed_given(a.rows(), weights.size()));
    auto const kept = space_detail::bounded_rows(a, weights);
    if (kept.rows() == 0 || kept.cols() == 0) return 0;
    auto centre = approximate_mid(kept);
    for (Eigen::Index i = 0; i < centre.rows(); ++i) {
        centre.row(i) *= weights[static_cast<std::size_t>(i)];
    }
    Eigen::VectorXd scale(centre.cols());
    for (Eigen::Index j = 0; j < centre.cols(); ++j) {
        double const size = centre.col(j).norm();
        scale(j) = size > 0 && std::isfinite(1 / size) ? 1 / size : 1.0;
        centre.col(j) *= scale(j);
    }
    if (!centre.allFinite()) return 0;
    approximate_svd const svd(centre);
    auto const& sigma = svd.values;
    std::size_t most = 0;
    while (static_cast<Eigen::Index>(most) < sigma.size() &&
           sigma(static_cast<Eigen::Index>(most)) > 1e-15 * sigma(0)) {
        ++most;
    }
    auto const count = static_cast<Eigen::Index>(most);
    Eigen::MatrixXd const w = scale.asDiagonal() * svd.right.leftCols(count);
    auto const turned = product(kept, w);
    interval_matrix<interval> b(most, most);
    for (Eigen::Index i = 0; i < count; ++i) {
        for (std::size_t k = 0; k < kept.rows(); ++k) {
            double const c = svd.left(static_cast<Eigen::Index>(k), i) * weights[k] / sigma(i);
            if (!std::isfinite(c)) return 0;
            for (std::size_t j = 0; j < most; ++j) {
                auto& sum = b(static_cast<std::size_t>(i), j);
                sum = traits::add(sum, traits::mul(traits::point(c), turned(k, j)));
            }
        }
    }
    std::size_t r = most;
    while (r > 0 && !(space_detail::distance_from_identity(b, r) < 1)) --r;
    return r;
}

} // namespace sivid

#endif
