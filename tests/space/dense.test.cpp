// SPDX-License-Identifier: MIT
#include <sivid/space/dense.hpp>

#include "support/catch.hpp"

#include <cmath>

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

TEST_CASE("triangles of a positive definite matrix solve it, and others are refused") {
    Eigen::MatrixXd a(3, 3), b(3, 2);
    a << 4, 9, 9, // only the lower triangle is read
        2, 5, 9, 1, -1, 6;
    b << 1, 0, 2, -1, 3, 7;
    Eigen::MatrixXd const whole = a.selfadjointView<Eigen::Lower>();
    approximate_cholesky factor;
    CHECK_FALSE(factor.computed());
    REQUIRE(factor.compute(a));
    CHECK((whole * factor.solve(b) - b).norm() < 1e-13);
    CHECK((factor.solve_upper(factor.solve_lower(b)) - factor.solve(b)).norm() < 1e-13);
    Eigen::MatrixXd const lower = factor.solve_lower(whole);
    CHECK((lower.transpose() * lower - whole).norm() < 1e-13); // L^-1 A = L^T
    a(1, 1) = 0;
    CHECK_FALSE(factor.compute(a));
    CHECK_FALSE(factor.computed());
}

TEST_CASE("least squares leave what cannot be told at 0") {
    Eigen::MatrixXd a(4, 3), b(4, 1);
    a << 1, 0, 1, 1, 0, 2, 1, 0, 3, 1, 0, 4;
    b << 3, 5, 7, 9;
    auto const x = approximate_least_squares(a, b);
    CHECK(std::abs(x(0) - 1) < 1e-13);
    CHECK(x(1) == 0);
    CHECK(std::abs(x(2) - 2) < 1e-13);
}

TEST_CASE("what is orthogonal to columns") {
    Eigen::MatrixXd a(4, 2);
    a << 1, 2, 0, 1, -1, 3, 2, 0;
    auto const rest = approximate_complement(a);
    REQUIRE(rest.cols() == 2);
    CHECK((rest.transpose() * a).norm() < 1e-14);
    a.col(1) = 2 * a.col(0);
    CHECK(approximate_complement(a).cols() == 3);
}

TEST_CASE("singular values tell small differences beside large ones") {
    Eigen::Matrix3d axes;
    axes << 0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, 1;
    Eigen::MatrixXd a(20, 3);
    for (int k = 0; k < 20; ++k) {
        a.row(k) = (axes * Eigen::Vector3d(std::cos(0.7 * k) * 1e3, std::sin(1.3 * k),
                                           1e-7 * std::cos(2.1 * k)))
                       .transpose();
    }
    approximate_svd const found(a);
    CHECK((found.values[0] > 1e3 && found.values[1] < 10));
    CHECK((found.values[2] > 1e-8 && found.values[2] < 1e-6));
    for (int j = 0; j < 3; ++j) CHECK(std::abs(found.right.col(j).dot(axes.col(j))) > 1 - 1e-5);
    CHECK((found.left * found.values.asDiagonal() * found.right.transpose() - a).norm() < 1e-10);
    CHECK((found.left.transpose() * found.left - Eigen::MatrixXd::Identity(3, 3)).norm() < 1e-8);
}

TEST_CASE("singular values of more columns than rows, and of none") {
    Eigen::MatrixXd a(1, 3);
    a << 3, 0, 4;
    approximate_svd const found(a);
    CHECK(std::abs(found.values[0] - 5) < 1e-14);
    CHECK(found.values.tail(2).norm() < 1e-14);
    CHECK((found.right.transpose() * found.right - Eigen::MatrixXd::Identity(3, 3)).norm() < 1e-14);
    CHECK((a * found.right.rightCols(2)).norm() < 1e-14);
    CHECK(approximate_svd(Eigen::MatrixXd(4, 0)).values.size() == 0);
    CHECK(approximate_svd(Eigen::MatrixXd(0, 2)).right.cols() == 2);
}
