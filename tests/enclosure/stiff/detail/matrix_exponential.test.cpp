// SPDX-License-Identifier: MIT
#include <sivid/enclosure/stiff/detail/dissipative_step.hpp>

#include "support/catch.hpp"
#include "support/matrix_exponential.hpp"
#include "support/random.hpp"

#include <cmath>
#include <limits>

using namespace sivid;
using support::draws;
using support::encloses;
using support::exact_exponential;
using support::mp;

TEST_CASE("random matrices of all norms against 100 digits") {
    draws d(631);
    for (int round = 0; round < 60; ++round) {
        auto const n = static_cast<Eigen::Index>(1 + d.below(5));
        double const size = std::pow(10, d.uniform(-3, 1.2));
        Eigen::MatrixXd const a = d.matrix(n, n, size);
        double const h = d.uniform(0, 2);
        auto const e = enclose_exponential<interval>(a, interval(h));
        REQUIRE(e);
        auto const exact = exact_exponential(a, mp(h));
        double largest = 1;
        for (auto const& row : exact) {
            for (auto const& x : row) largest = std::max(largest, std::abs(x.convert_to<double>()));
        }
        for (std::size_t i = 0; i < exact.size(); ++i) {
            for (std::size_t j = 0; j < exact.size(); ++j) {
                CAPTURE(n, size, h, i, j);
                CHECK(encloses((*e)(i, j), exact[i][j], 1e-30));
                CHECK(width((*e)(i, j)) < 1e-8 * largest);
            }
        }
    }
}

TEST_CASE("the remainder of the series alone") {
    // With few terms it is far above the rounding. At a norm of 0.4 nothing is squared.
    draws d(633);
    for (std::size_t terms = 1; terms <= 12; ++terms) {
        for (double const size : {0.4, 3.0}) {
            Eigen::MatrixXd const a = d.matrix(2, 2, size / 2);
            auto const e = enclose_exponential<interval>(a, interval(1.0), terms);
            REQUIRE(e);
            auto const exact = exact_exponential(a, mp(1));
            for (std::size_t i = 0; i < 2; ++i) {
                for (std::size_t j = 0; j < 2; ++j) {
                    CAPTURE(terms, size, i, j);
                    CHECK(encloses((*e)(i, j), exact[i][j], 1e-40));
                }
            }
            if (terms <= 4) CHECK(width((*e)(0, 0)) > 1e-9);
        }
    }
    Eigen::MatrixXd a(1, 1);
    a << 0.4;
    CHECK(encloses((*enclose_exponential<interval>(a, interval(1.0)))(0, 0), exp(mp(0.4))));
    CHECK(width((*enclose_exponential<interval>(a, interval(1.0)))(0, 0)) < 4e-15);
}

TEST_CASE("an interval of times, and stiff matrices") {
    Eigen::MatrixXd a(2, 2);
    a << -1000, 999, 1, -2;
    auto const e = enclose_exponential<interval>(a, interval(0.5, 0.501));
    REQUIRE(e);
    for (double const h : {0.5, 0.5005, 0.501}) {
        auto const exact = exact_exponential(a, mp(h));
        for (std::size_t i = 0; i < 2; ++i) {
            for (std::size_t j = 0; j < 2; ++j) CHECK(encloses((*e)(i, j), exact[i][j], 1e-30));
        }
    }
    auto const point = enclose_exponential<interval>(a, interval(0.5));
    REQUIRE(point);
    CHECK(width((*point)(0, 0)) < 1e-9);
    CHECK(mag((*point)(0, 0)) < 1);
}

TEST_CASE("an exponential is as sharp whatever the units of the rows") {
    Eigen::MatrixXd a(3, 3);
    a << -1, 2, 0.5, -3, -0.5, 1, 0, 0, 0; // the last acts on the others alone
    auto const plain = enclose_exponential<interval>(a, interval(2.0));
    REQUIRE(plain);
    for (double const size : {0x1p30, 1e9, 1e-7}) {
        Eigen::VectorXd const d{{1, size, 1 / size}};
        Eigen::MatrixXd const scaled = d.asDiagonal() * a * d.cwiseInverse().asDiagonal();
        auto const e = enclose_exponential<interval>(scaled, interval(2.0));
        REQUIRE(e);
        auto const exact = exact_exponential(scaled, mp(2.0));
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) {
                double const ratio =
                    d[static_cast<Eigen::Index>(i)] / d[static_cast<Eigen::Index>(j)];
                CHECK(encloses((*e)(i, j), exact[i][j], 1e-28 * ratio));
                CHECK(width((*e)(i, j)) <= ratio * (4 * width((*plain)(i, j)) + 1e-13));
            }
        }
    }
}

TEST_CASE("upper bounds for matrices without negative entries off the diagonal") {
    draws d(632);
    for (int round = 0; round < 40; ++round) {
        auto const n = static_cast<Eigen::Index>(1 + d.below(4));
        Eigen::MatrixXd m = d.matrix(n, n, 3).cwiseAbs();
        for (Eigen::Index i = 0; i < n; ++i) m(i, i) = d.uniform(-200, 2);
        double const h = d.uniform(0, 1);
        auto const bound = bound_exponential<interval>(m, interval(h));
        REQUIRE(bound);
        auto const exact = exact_exponential(m, mp(h));
        for (Eigen::Index i = 0; i < n; ++i) {
            for (Eigen::Index j = 0; j < n; ++j) {
                auto const& x = exact[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
                CHECK(mp((*bound)(i, j)) >= x);
                CHECK(mp((*bound)(i, j)) <= x * (1 + mp(1e-8)) + 1e-9);
            }
        }
    }
}

TEST_CASE("what is not finite or too large is refused") {
    Eigen::MatrixXd a(1, 1);
    a << std::numeric_limits<double>::infinity();
    CHECK_FALSE(enclose_exponential<interval>(a, interval(1.0)));
    a << std::numeric_limits<double>::quiet_NaN();
    CHECK_FALSE(enclose_exponential<interval>(a, interval(1.0)));
    a << 1e300;
    CHECK_FALSE(enclose_exponential<interval>(a, interval(1.0)));
    a << 800; // overflows
    CHECK_FALSE(bound_exponential<interval>(a, interval(1.0)));
}
