// SPDX-License-Identifier: MIT
#include <sivid/space/exact/detail/rational_basis.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"

#include <Eigen/LU>

#include <cmath>

using namespace sivid;
using support::draws;

namespace {

Eigen::VectorXd vector_of(std::initializer_list<double> entries) {
    Eigen::VectorXd v(static_cast<Eigen::Index>(entries.size()));
    Eigen::Index i = 0;
    for (double const x : entries) v(i++) = x;
    return v;
}

} // namespace

TEST_CASE("small integers in the proportions of a vector") {
    CHECK(approximate_integers(vector_of({-0.5, 0.25, 0}), 1e-9) == std::vector{2, -1, 0});
    CHECK(approximate_integers(vector_of({1.0, -1.0 / 3}), 1e-9) == std::vector{3, -1});
    CHECK_FALSE(approximate_integers(vector_of({1.0, std::sqrt(0.5)}), 1e-4));
    CHECK(approximate_integers(vector_of({1.0, 0.97}), 0.05) == std::vector{1, 1});
    CHECK_FALSE(approximate_integers(vector_of({0, 0}), 1e-9));
}

TEST_CASE("a space spanned by small integers is found from any basis of it") {
    draws d(621);
    for (int round = 0; round < 300; ++round) {
        auto const n = static_cast<Eigen::Index>(2 + d.below(6));
        auto const k = static_cast<Eigen::Index>(1 + d.below(static_cast<std::size_t>(n - 1)));
        // Signs on top of an identity: independent, and their echelon form stays small.
        Eigen::MatrixXd planted = Eigen::MatrixXd::Zero(n, k);
        for (Eigen::Index c = 0; c < k; ++c) {
            planted(c, c) = 1;
            for (Eigen::Index i = k; i < n; ++i)
                planted(i, c) = static_cast<double>(d.below(3)) - 1;
        }
        Eigen::MatrixXd mixed = planted * d.matrix(k, k);
        if (std::abs((planted.transpose() * mixed).determinant()) < 1e-3) continue;
        auto const found = approximate_integer_basis(mixed, 1e-7);
        REQUIRE(found.size() == static_cast<std::size_t>(k));
        auto const complement = orthogonal_complement(found, static_cast<std::size_t>(n));
        REQUIRE(complement.cols() == n - k);
        CHECK((complement.transpose() * planted).norm() < 1e-9);
    }
}

TEST_CASE("rows that are no small integers are left out, the others stay") {
    Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(4, 2);
    basis.col(0) << 1, -1, 0, 0;
    basis.col(1) << 0, 0, 1, 0.7071;
    Eigen::MatrixXd turn(2, 2);
    turn << 0.6, -0.8, 0.8, 0.6;
    auto const found = approximate_integer_basis(basis * turn, 1e-6);
    REQUIRE(found.size() == 1);
    CHECK(found[0] == std::vector{1, -1, 0, 0});
    CHECK(orthogonal_complement({}, 3).cols() == 3);
}
