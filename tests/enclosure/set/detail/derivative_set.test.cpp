// SPDX-License-Identifier: MIT
// Random products of matrices: the set contains every product of members.
#include <sivid/enclosure/set/detail/derivative_set.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"

#include <sivid/number/interval.hpp>

#include <cmath>

using namespace sivid;
using traits = interval_traits<interval>;
using real_matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

namespace {

bool encloses(interval_matrix<interval> const& a, real_matrix const& m, long double slack) {
    for (Eigen::Index i = 0; i < m.rows(); ++i) {
        for (Eigen::Index c = 0; c < m.cols(); ++c) {
            auto const& x = a(static_cast<std::size_t>(i), static_cast<std::size_t>(c));
            long double const room = slack * (1 + std::fabs(m(i, c)));
            if (!(x.lower() <= m(i, c) + room && m(i, c) - room <= x.upper())) return false;
        }
    }
    return true;
}

} // namespace

TEST_CASE("the begin is one and zero") {
    derivative_set<interval> const s(2, 1);
    for (std::size_t i = 0; i < 2; ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            CHECK(s.hull()(i, c).lower() == (i == c ? 1 : 0));
            CHECK(s.hull()(i, c).upper() == (i == c ? 1 : 0));
        }
    }
}

TEST_CASE("products of members are in the product of sets") {
    support::draws d(5);
    for (int round = 0; round < 200; ++round) {
        auto const n = 1 + d.below(4), m = d.below(3);
        derivative_set<interval> set(n, m);
        std::vector<real_matrix> members(
            4, real_matrix::Zero(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n + m)));
        for (auto& s : members) s.leftCols(static_cast<Eigen::Index>(n)).setIdentity();
        double const width = std::pow(10, -d.uniform(0, 8));
        for (int step = 0; step < 12; ++step) {
            interval_matrix<interval> j(n, n + m);
            for (std::size_t i = 0; i < n; ++i) {
                for (std::size_t c = 0; c < n + m; ++c) {
                    double const centre = (i == c ? 1 : 0) + d.uniform(-0.4, 0.4);
                    j(i, c) = traits::bounds(centre - width, centre + width);
                }
            }
            set = set.mapped(j);
            for (auto& s : members) {
                real_matrix one(n, n + m);
                for (std::size_t i = 0; i < n; ++i) {
                    for (std::size_t c = 0; c < n + m; ++c) {
                        one(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c)) =
                            d.coin() ? j(i, c).lower() : d.in(j(i, c));
                    }
                }
                s = (one.leftCols(static_cast<Eigen::Index>(n)) * s).eval();
                s.rightCols(static_cast<Eigen::Index>(m)) +=
                    one.rightCols(static_cast<Eigen::Index>(m));
                CAPTURE(round, step);
                REQUIRE(encloses(set.hull(), s, 1e-17L));
            }
        }
    }
}

TEST_CASE("rotations do not wrap") {
    // 400 turns of 0.1 rad that are known to 1e-9: boxes would grow by (cos + sin)^400 = 1e16.
    interval_matrix<interval> j(2, 2);
    double const c = std::cos(0.1), s = std::sin(0.1);
    double const entries[2][2]{{c, -s}, {s, c}};
    for (std::size_t i = 0; i < 2; ++i) {
        for (std::size_t k = 0; k < 2; ++k) {
            j(i, k) = traits::bounds(entries[i][k] - 1e-9, entries[i][k] + 1e-9);
        }
    }
    derivative_set<interval> set(2, 0);
    for (int step = 0; step < 400; ++step) set = set.mapped(j);
    CHECK(width(set.hull()(0, 0)) < 1e-5);
    CHECK(width(set.hull()(0, 0)) > 4e-7);
    CHECK(set.hull()(0, 0).lower() <= std::cos(40.0));
    CHECK(set.hull()(0, 0).upper() >= std::cos(40.0));
}

TEST_CASE("what is unbounded stays unbounded") {
    interval_matrix<interval> j(2, 2);
    j(0, 0) = traits::entire();
    j(1, 1) = traits::point(2.0);
    auto const set = derivative_set<interval>(2, 0).mapped(j);
    CHECK(std::isinf(width(set.hull()(0, 0))));
    CHECK(set.hull()(1, 1).lower() <= 2);
    CHECK(set.hull()(1, 1).upper() >= 2);
}
