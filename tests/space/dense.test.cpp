// SPDX-License-Identifier: MIT
#include <sivid/space/dense.hpp>

#include "support/catch.hpp"

using namespace sivid;

TEST_CASE("inverses and solutions are those of the matrix up to rounding") {
    Eigen::MatrixXd a(3, 3), b(3, 2);
    a << 0, 2, 1, // the first pivot has to come from another row
        4, -1, 3, 2, 2, 5;
    b << 1, 0, 2, -1, 3, 7;
    CHECK((a * approximate_inverse(a) - Eigen::MatrixXd::Identity(3, 3)).norm() < 1e-14);
    CHECK((a * approximate_solution(a, b) - b).norm() < 1e-14);
    CHECK_FALSE(approximate_inverse(Eigen::MatrixXd::Zero(2, 2)).allFinite());
}
