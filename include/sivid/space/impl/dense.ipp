// SPDX-License-Identifier: MIT
#ifndef SIVID_SPACE_IMPL_DENSE_IPP
#define SIVID_SPACE_IMPL_DENSE_IPP

#include <sivid/space/dense.hpp>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace sivid {

SIVID_DECL Eigen::MatrixXd approximate_inverse(Eigen::MatrixXd const& a) {
    return a.partialPivLu().inverse();
}

SIVID_DECL Eigen::MatrixXd approximate_solution(Eigen::MatrixXd const& a,
                                                Eigen::MatrixXd const& b) {
    return a.partialPivLu().solve(b);
}

SIVID_DECL Eigen::MatrixXd approximate_least_squares(Eigen::MatrixXd const& a,
                                                     Eigen::MatrixXd const& b) {
    return a.colPivHouseholderQr().solve(b);
}

SIVID_DECL Eigen::MatrixXd approximate_complement(Eigen::MatrixXd const& a) {
    auto const qr = a.colPivHouseholderQr();
    Eigen::MatrixXd const q = qr.householderQ();
    return q.rightCols(a.rows() - qr.rank());
}

SIVID_DECL bool approximate_cholesky::compute(Eigen::MatrixXd const& a) {
    lower_ = a;
    computed_ = Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>>(lower_).info() == Eigen::Success;
    return computed_;
}

SIVID_DECL Eigen::MatrixXd approximate_cholesky::solve_lower(Eigen::MatrixXd const& b) const {
    return lower_.triangularView<Eigen::Lower>().solve(b);
}

SIVID_DECL Eigen::MatrixXd approximate_cholesky::solve_upper(Eigen::MatrixXd const& b) const {
    return lower_.transpose().triangularView<Eigen::Upper>().solve(b);
}

SIVID_DECL Eigen::MatrixXd approximate_cholesky::solve(Eigen::MatrixXd const& b) const {
    return solve_upper(solve_lower(b));
}

SIVID_DECL approximate_svd::approximate_svd(Eigen::MatrixXd const& a) {
    auto const n = a.cols();
    Eigen::MatrixXd u = a, v = Eigen::MatrixXd::Identity(n, n);
    auto const turn = [](Eigen::MatrixXd& m, Eigen::Index i, Eigen::Index j, double c, double s) {
        for (Eigen::Index k = 0; k < m.rows(); ++k) {
            double const old = m(k, i);
            m(k, i) = c * old - s * m(k, j);
            m(k, j) = s * old + c * m(k, j);
        }
    };
    bool turned = true;
    for (int sweep = 0; sweep < 30 && turned; ++sweep) {
        turned = false;
        for (Eigen::Index i = 0; i < n; ++i) {
            for (Eigen::Index j = i + 1; j < n; ++j) {
                double const p = u.col(i).dot(u.col(j));
                double const x = u.col(i).squaredNorm(), y = u.col(j).squaredNorm();
                if (!(std::abs(p) > 1e-15 * std::sqrt(x * y))) continue;
                double const zeta = (y - x) / (2 * p);
                double const t = (zeta < 0 ? -1.0 : 1.0) / (std::abs(zeta) + std::hypot(1.0, zeta));
                double const c = 1 / std::hypot(1.0, t);
                turn(u, i, j, c, c * t);
                turn(v, i, j, c, c * t);
                turned = true;
            }
        }
    }
    Eigen::VectorXd const norms = u.colwise().norm();
    std::vector<Eigen::Index> order(static_cast<std::size_t>(n));
    std::iota(order.begin(), order.end(), Eigen::Index{0});
    std::sort(order.begin(), order.end(),
              [&](Eigen::Index i, Eigen::Index j) { return norms[i] > norms[j]; });
    values.resize(n);
    left.resize(u.rows(), n);
    right.resize(n, n);
    for (Eigen::Index k = 0; k < n; ++k) {
        auto const j = order[static_cast<std::size_t>(k)];
        values[k] = norms[j];
        left.col(k) =
            norms[j] > 0 ? Eigen::VectorXd(u.col(j) / norms[j]) : Eigen::VectorXd(u.col(j));
        right.col(k) = v.col(j);
    }
}

} // namespace sivid

#endif
