// SPDX-License-Identifier: MIT
#include <sivid/space/eigen_support.hpp>

#include "support/catch.hpp"
#include "support/oracle.hpp"

#include <boost/multiprecision/gmp.hpp>

#include <cstddef>
#include <limits>
#include <vector>

using sivid::interval;
using rational = boost::multiprecision::mpq_rational;

namespace {

using traits = sivid::interval_traits<interval>;
template <int N>
using interval_matrix = Eigen::Matrix<interval, N, N>;
template <int N>
using interval_vector = Eigen::Matrix<interval, N, 1>;

bool holds(interval const& x, rational const& exact) {
    if (sivid::is_empty(x)) return false;
    bool const above =
        lower(x) == -std::numeric_limits<double>::infinity() || rational{lower(x)} <= exact;
    bool const below =
        upper(x) == std::numeric_limits<double>::infinity() || exact <= rational{upper(x)};
    return above && below;
}

/// Exact arithmetic on small dense matrices.
struct exact_matrix {
    std::size_t n;
    std::vector<rational> entries;
    explicit exact_matrix(std::size_t size) : n{size}, entries(size * size) {}
    rational& operator()(std::size_t i, std::size_t j) { return entries[i * n + j]; }

    /// Gauss-Jordan; false if singular.
    bool inverted(exact_matrix& inverse) const {
        exact_matrix a = *this;
        for (std::size_t i = 0; i < n; ++i) inverse(i, i) = 1;
        for (std::size_t k = 0; k < n; ++k) {
            std::size_t p = k;
            while (p < n && a(p, k) == 0) ++p;
            if (p == n) return false;
            for (std::size_t j = 0; j < n; ++j) {
                std::swap(a(p, j), a(k, j));
                std::swap(inverse(p, j), inverse(k, j));
            }
            rational const pivot = a(k, k);
            for (std::size_t j = 0; j < n; ++j) {
                a(k, j) /= pivot;
                inverse(k, j) /= pivot;
            }
            for (std::size_t i = 0; i < n; ++i) {
                rational const factor = a(i, k);
                if (i == k || factor == 0) continue;
                for (std::size_t j = 0; j < n; ++j) {
                    a(i, j) -= factor * a(k, j);
                    inverse(i, j) -= factor * inverse(k, j);
                }
            }
        }
        return true;
    }
};

/// A random interval matrix and a point matrix in it.
template <int N>
void random_matrices(oracle::inputs& in, double radius, interval_matrix<N>& box,
                     exact_matrix& point) {
    for (int i = 0; i < N; ++i)
        for (int j = 0; j < N; ++j) {
            double const middle = in.uniform(-3.0, 3.0), r = radius * in.uniform(0.0, 1.0);
            box(i, j) = traits::bounds(middle - r, middle + r);
            double const member = in.below(2) == 0 ? middle - r : middle;
            point(static_cast<std::size_t>(i), static_cast<std::size_t>(j)) = rational{member};
        }
}

template <int N>
void check_inverse_and_lu(double radius, int times) {
    oracle::inputs in{static_cast<std::uint64_t>(N)};
    for (int k = 0; k < times; ++k) {
        interval_matrix<N> box;
        exact_matrix point{N}, exact{N};
        random_matrices<N>(in, radius, box, point);
        if (!point.inverted(exact)) continue;
        interval_matrix<N> const inverse = box.inverse();
        interval_matrix<N> const solved = box.partialPivLu().solve(interval_matrix<N>::Identity());
        for (int i = 0; i < N; ++i)
            for (int j = 0; j < N; ++j) {
                rational const& e = exact(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
                REQUIRE(holds(inverse(i, j), e));
                REQUIRE(holds(solved(i, j), e));
            }
    }
}

} // namespace

TEST_CASE("absolute values, squares and norms of interval matrices") {
    interval_vector<2> v;
    v << traits::bounds(-2, -1), traits::bounds(-3, 1);
    CHECK(equal(v.cwiseAbs()(0), traits::bounds(1, 2)));
    CHECK(equal(v.cwiseAbs()(1), traits::bounds(0, 3)));
    CHECK(equal(v.cwiseAbs2()(1), traits::bounds(0, 9)));
    CHECK(equal(v.squaredNorm(), traits::bounds(1, 13)));
    CHECK(equal(v.lpNorm<1>(), traits::bounds(1, 5)));
    CHECK(contains(v.norm(), 1.0));
    CHECK(equal(v.array().square().matrix()(0), traits::bounds(1, 4)));
}

TEST_CASE("products of interval matrices contain the exact product") {
    oracle::inputs in{3};
    // 40: large enough for the blocked kernels
    for (int const n : {2, 5, 40}) {
        Eigen::Matrix<interval, Eigen::Dynamic, Eigen::Dynamic> a(n, n), b(n, n);
        Eigen::MatrixXd p(n, n), q(n, n);
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                p(i, j) = in.uniform(-1.0, 1.0);
                q(i, j) = in.uniform(-1.0, 1.0);
                a(i, j) = traits::bounds(p(i, j) - 0.01, p(i, j));
                b(i, j) = traits::bounds(q(i, j), q(i, j) + 0.01);
            }
        auto const c = (a * b).eval(), points = (a * q).eval(), other = (p * b).eval();
        auto const v = (a * b.col(0)).eval();
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                rational exact = 0;
                for (int k = 0; k < n; ++k) exact += rational{p(i, k)} * rational{q(k, j)};
                REQUIRE(holds(c(i, j), exact));
                REQUIRE(holds(points(i, j), exact));
                REQUIRE(holds(other(i, j), exact));
                if (j == 0) REQUIRE(holds(v(i), exact));
            }
    }
}

TEST_CASE("scalars and intervals multiply matrices") {
    interval_matrix<2> m;
    m << interval{1.0}, traits::bounds(-1, 1), interval{0.0}, interval{2.0};
    CHECK(equal((2.0 * m)(1, 1), traits::bounds(4, 4)));
    CHECK(equal((m * 3)(0, 1), traits::bounds(-3, 3)));
    CHECK(equal((m * interval{2.0})(0, 0), traits::bounds(2, 2)));
    CHECK(equal((m + m.transpose())(0, 1), traits::bounds(-1, 1)));
    CHECK(equal((m / interval{2.0})(1, 1), traits::bounds(1, 1)));
}

TEST_CASE("inverse and LU contain the inverse of every matrix in the set") {
    double const radius = GENERATE(0.0, 1e-8, 0.02, 0.5);
    check_inverse_and_lu<2>(radius, 200);
    check_inverse_and_lu<3>(radius, 200);
    check_inverse_and_lu<4>(radius, 100);
    check_inverse_and_lu<6>(radius, 30);
}

TEST_CASE("a pivot that may be zero gives unbounded results, never wrong ones") {
    interval_matrix<2> m;
    m << traits::bounds(-1, 1), interval{0.0}, interval{0.0}, interval{1.0};
    interval_vector<2> b;
    b << interval{1.0}, interval{1.0};
    interval_vector<2> const x = m.partialPivLu().solve(b);
    CHECK(contains(x(0), 1e6));
    CHECK(contains(x(0), -1e6));
}

TEST_CASE("Householder QR: the factors multiply to the matrix and Q is orthogonal") {
    oracle::inputs in{7};
    for (int k = 0; k < 200; ++k) {
        interval_matrix<4> box;
        exact_matrix point{4};
        random_matrices<4>(in, k % 2 == 0 ? 0.0 : 1e-6, box, point);
        Eigen::HouseholderQR<interval_matrix<4>> const qr(box);
        interval_matrix<4> const q = qr.householderQ();
        interval_matrix<4> const r = qr.matrixQR().triangularView<Eigen::Upper>();
        interval_matrix<4> const product = q * r, identity = q.transpose() * q;
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j) {
                REQUIRE(holds(product(i, j),
                              point(static_cast<std::size_t>(i), static_cast<std::size_t>(j))));
                REQUIRE(contains(identity(i, j), i == j ? 1.0 : 0.0));
                REQUIRE(width(identity(i, j)) < 1.0);
            }
    }
}

TEST_CASE("Householder QR neglects nothing") {
    // Squares of the entries below the diagonal underflow; dropping them would lose the rotation.
    interval_matrix<2> m;
    m << interval{1e-170}, interval{1.0}, interval{1e-170}, interval{2.0};
    Eigen::HouseholderQR<interval_matrix<2>> const qr(m);
    interval_matrix<2> const q = qr.householderQ();
    interval_matrix<2> const r = qr.matrixQR().triangularView<Eigen::Upper>();
    CHECK(contains((q * r).eval()(1, 0), 1e-170));
    CHECK(contains((q * r).eval()(1, 1), 2.0));
}

TEST_CASE("comparisons inside Eigen do not throw") {
    interval_matrix<2> m;
    m << traits::bounds(-1, 1), traits::bounds(0, 2), traits::bounds(-1, 1), traits::bounds(0, 2);
    CHECK_NOTHROW(m.partialPivLu());
    CHECK_NOTHROW(m.isApprox(m));
    CHECK_NOTHROW(Eigen::HouseholderQR<interval_matrix<2>>(m));
    CHECK_NOTHROW(m.determinant());
}
