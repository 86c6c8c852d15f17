// SPDX-License-Identifier: MIT
#include <sivid/space/frame/orthogonal_frame.hpp>

#include "support/catch.hpp"
#include "support/power_series.hpp"
#include "support/random.hpp"

#include <Eigen/QR>

#include <cmath>
#include <limits>
#include <vector>

using namespace sivid;
using support::draws;
using support::encloses;
using support::mp;

namespace {

/// The inverse in 100 digits, by Gauss-Jordan elimination with pivoting.
std::vector<std::vector<mp>> exact_inverse(Eigen::MatrixXd const& q) {
    auto const n = static_cast<std::size_t>(q.rows());
    std::vector<std::vector<mp>> a(n, std::vector<mp>(2 * n, 0));
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
            a[i][j] = q(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
        }
        a[i][n + i] = 1;
    }
    for (std::size_t c = 0; c < n; ++c) {
        std::size_t pivot = c;
        for (std::size_t i = c; i < n; ++i) {
            if (abs(a[i][c]) > abs(a[pivot][c])) pivot = i;
        }
        std::swap(a[c], a[pivot]);
        mp const scale = a[c][c];
        for (auto& v : a[c]) v /= scale;
        for (std::size_t i = 0; i < n; ++i) {
            if (i == c) continue;
            mp const factor = a[i][c];
            for (std::size_t j = 0; j < 2 * n; ++j) a[i][j] -= factor * a[c][j];
        }
    }
    for (auto& row : a) row.erase(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(n));
    return a;
}

void check_inverse(Eigen::MatrixXd const& q, interval_matrix<interval> const& inverse) {
    auto const exact = exact_inverse(q);
    for (std::size_t i = 0; i < exact.size(); ++i) {
        for (std::size_t j = 0; j < exact.size(); ++j) CHECK(encloses(inverse(i, j), exact[i][j]));
    }
}

} // namespace

TEST_CASE("frames of random matrices are orthogonal, their inverses enclosed") {
    draws d(31);
    for (int round = 0; round < 60; ++round) {
        auto const n = static_cast<Eigen::Index>(1 + d.below(6));
        Eigen::MatrixXd a = d.matrix(n, n, 3);
        if (d.below(4) == 0) a.col(0) *= 1e12;
        if (n > 1 && d.below(4) == 0) a.col(n - 1) = a.col(0) * (1 + 1e-15); // nearly singular
        if (n > 1 && d.below(4) == 0) a.col(n - 1).setZero();                // singular
        std::vector<double> weights;
        for (Eigen::Index i = 0; i < n; ++i) weights.push_back(d.uniform(0, 1));
        auto const frame = make_frame<interval>(a, weights);
        check_inverse(frame.axes, frame.inverse);
        Eigen::MatrixXd const defect =
            frame.axes.transpose() * frame.axes - Eigen::MatrixXd::Identity(n, n);
        CHECK(defect.cwiseAbs().maxCoeff() < 1e-13);
        for (std::size_t i = 0; i < frame.inverse.rows(); ++i) {
            CHECK(width(frame.inverse(i, 0)) < 1e-13);
        }
    }
}

TEST_CASE("the first axis follows the column that is longest in the set") {
    Eigen::MatrixXd a(2, 2);
    a << 1, 10, 1, -10;
    auto const second = make_frame<interval>(a, {1, 1}); // (10, -10) is longer
    CHECK(std::abs(second.axes(0, 0) + second.axes(1, 0)) < 1e-14);
    auto const first = make_frame<interval>(a, {1, 1e-3}); // but carries little
    CHECK(std::abs(first.axes(0, 0) - first.axes(1, 0)) < 1e-14);
}

TEST_CASE("axes are orthogonal where rows are measured in sizes of their own") {
    draws d(35);
    for (int round = 0; round < 60; ++round) {
        auto const n = static_cast<Eigen::Index>(2 + d.below(4));
        Eigen::MatrixXd const a = d.matrix(n, n, 3);
        std::vector<double> weights, ones, sizes;
        for (Eigen::Index i = 0; i < n; ++i) {
            weights.push_back(d.uniform(0, 1));
            ones.push_back(1);
            sizes.push_back(std::pow(10, d.uniform(-8, 8)));
        }
        auto const scale = Eigen::Map<Eigen::VectorXd const>(sizes.data(), n);
        auto const plain = make_frame<interval>(a, weights);
        auto const same = make_frame<interval>(a, weights, ones);
        CHECK(plain.axes == same.axes);
        auto const frame = make_frame<interval>(scale.asDiagonal() * a, weights, sizes);
        check_inverse(frame.axes, frame.inverse);
        Eigen::MatrixXd const apart = scale.cwiseInverse().asDiagonal() * frame.axes - plain.axes;
        CHECK(apart.cwiseAbs().maxCoeff() < 1e-9);
    }
}

TEST_CASE("matrices far from orthogonal are inverted or refused, never wrongly") {
    draws d(32);
    int accepted = 0;
    for (int round = 0; round < 300; ++round) {
        auto const n = static_cast<Eigen::Index>(2 + d.below(3));
        Eigen::MatrixXd q = Eigen::HouseholderQR<Eigen::MatrixXd>(d.matrix(n, n)).householderQ();
        q += d.matrix(n, n, d.uniform(0, 0.3));
        interval_matrix<interval> inverse;
        if (!enclose_inverse<interval>(q, inverse)) continue;
        ++accepted;
        check_inverse(q, inverse);
    }
    CHECK(accepted > 20);
    CHECK(accepted < 300);
    interval_matrix<interval> inverse;
    CHECK_FALSE(enclose_inverse<interval>(Eigen::MatrixXd::Zero(2, 2), inverse));
    CHECK_FALSE(enclose_inverse<interval>(2 * Eigen::MatrixXd::Identity(2, 2), inverse));
}

TEST_CASE("matrices that are not finite give the identity or a refusal") {
    for (double const bad : {std::numeric_limits<double>::quiet_NaN(), HUGE_VAL, -HUGE_VAL}) {
        Eigen::MatrixXd a = Eigen::MatrixXd::Identity(2, 2);
        a(1, 0) = bad;
        auto const frame = make_frame<interval>(a, {1, 1});
        CHECK(frame.axes == Eigen::MatrixXd::Identity(2, 2));
        check_inverse(frame.axes, frame.inverse);
        interval_matrix<interval> inverse;
        CHECK_FALSE(enclose_inverse<interval>(a, inverse));
    }
    Eigen::MatrixXd const huge = 1e300 * Eigen::MatrixXd::Ones(2, 2);
    auto const frame = make_frame<interval>(huge, {1e300, 1e300});
    check_inverse(frame.axes, frame.inverse);
    auto const weightless = make_frame<interval>(Eigen::MatrixXd::Identity(2, 2),
                                                 {std::numeric_limits<double>::quiet_NaN(), 1});
    check_inverse(weightless.axes, weightless.inverse);
}
