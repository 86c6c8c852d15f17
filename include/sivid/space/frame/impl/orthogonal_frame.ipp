// SPDX-License-Identifier: MIT
#ifndef SIVID_SPACE_FRAME_IMPL_ORTHOGONAL_FRAME_IPP
#define SIVID_SPACE_FRAME_IMPL_ORTHOGONAL_FRAME_IPP

#include <sivid/space/frame/orthogonal_frame.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace sivid {

namespace space_detail {
/// Length of column k from row k on.
[[nodiscard]] inline double column_norm(Eigen::MatrixXd const& a, Eigen::Index k) {
    double largest = 0, sum = 0;
    for (Eigen::Index i = k; i < a.rows(); ++i) largest = std::max(largest, std::abs(a(i, k)));
    if (!(largest > 0)) return 0;
    for (Eigen::Index i = k; i < a.rows(); ++i) sum += (a(i, k) / largest) * (a(i, k) / largest);
    return largest * std::sqrt(sum);
}
/// The orthogonal factor Q of A = Q R by Householder's reflections, for square A. Not proved. (By
/// hand: Eigen's decompositions cost every user of first-order sets seconds.)
/// @cost  8/3 n^3
[[nodiscard]] inline Eigen::MatrixXd approximate_orthogonal(Eigen::MatrixXd a) {
    auto const n = a.rows();
    Eigen::MatrixXd q = Eigen::MatrixXd::Identity(n, n);
    std::vector<double> v(static_cast<std::size_t>(n));
    // A becomes H A and Q becomes Q H, with H = 1 - 2 v v^T / (v^T v) and v 0 before row k.
    for (Eigen::Index k = 0; k + 1 < n; ++k) {
        double const size = column_norm(a, k);
        if (!(size > 0)) continue;
        double square = 0;
        for (Eigen::Index i = k; i < n; ++i) {
            double const own = a(i, k) / size;
            double const moved = i > k ? own : own >= 0 ? own + 1 : own - 1;
            v[static_cast<std::size_t>(i)] = moved;
            square += moved * moved;
        }
        auto const reflect = [&](auto const& entry) {
            double dot = 0;
            for (Eigen::Index i = k; i < n; ++i) dot += v[static_cast<std::size_t>(i)] * entry(i);
            double const factor = 2 * dot / square;
            for (Eigen::Index i = k; i < n; ++i)
                entry(i) -= factor * v[static_cast<std::size_t>(i)];
        };
        for (Eigen::Index j = k; j < n; ++j)
            reflect([&](Eigen::Index i) -> double& { return a(i, j); });
        for (Eigen::Index j = 0; j < n; ++j)
            reflect([&](Eigen::Index i) -> double& { return q(j, i); });
    }
    return q;
}
} // namespace space_detail

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
    Eigen::MatrixXd q = space_detail::approximate_orthogonal(std::move(sorted));
    return q.allFinite() ? q : straight;
}

} // namespace sivid

#endif
