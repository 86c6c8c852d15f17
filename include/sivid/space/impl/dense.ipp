// SPDX-License-Identifier: MIT
#ifndef SIVID_SPACE_IMPL_DENSE_IPP
#define SIVID_SPACE_IMPL_DENSE_IPP

#include <sivid/space/dense.hpp>

#include <Eigen/LU>

namespace sivid {

SIVID_DECL Eigen::MatrixXd approximate_inverse(Eigen::MatrixXd const& a) {
    return a.partialPivLu().inverse();
}

SIVID_DECL Eigen::MatrixXd approximate_solution(Eigen::MatrixXd const& a,
                                                Eigen::MatrixXd const& b) {
    return a.partialPivLu().solve(b);
}

} // namespace sivid

#endif
