// SPDX-License-Identifier: MIT
#ifndef SIVID_SPACE_FRAME_IMPL_ORTHOGONAL_FRAME_IPP
#define SIVID_SPACE_FRAME_IMPL_ORTHOGONAL_FRAME_IPP

#include <sivid/space/dense.hpp>
#include <sivid/space/frame/orthogonal_frame.hpp>

#include <numeric>

namespace sivid {

SIVID_DECL Eigen::MatrixXd orthogonal_axes(Eigen::MatrixXd const& a,
                                           std::vector<double> const& weights) {
    auto const n = a.rows();
    Eigen::MatrixXd const straight = Eigen::MatrixXd::Identity(n, n);
    if (!a.allFinite()) return straight;
    std::vector<Eigen::Index> order(static_cast<std::size_t>(n));
    std::iota(order.begin(), order.end(), Eigen::Index{0});
    std::vector<double> length(static_cast<std::size_t>(n));
    for (Eigen::Index j = 0; j < n; ++j) {
        auto const k = static_cast<std::size_t>(j);
        length[k] = a.col(j).norm() * weights[k];
        if (!(length[k] >= 0)) return straight;
    }
    std::stable_sort(order.begin(), order.end(), [&](Eigen::Index i, Eigen::Index j) {
        return length[static_cast<std::size_t>(i)] > length[static_cast<std::size_t>(j)];
    });
    Eigen::MatrixXd sorted(n, n);
    for (Eigen::Index j = 0; j < n; ++j) sorted.col(j) = a.col(order[static_cast<std::size_t>(j)]);
    Eigen::MatrixXd q = approximate_orthogonal(sorted);
    return q.allFinite() ? q : straight;
}

} // namespace sivid

#endif
