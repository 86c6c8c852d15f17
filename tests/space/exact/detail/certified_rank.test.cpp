// SPDX-License-Identifier: MIT
// Ranks proved of interval matrices: never above the rank of a member, and sharp where it is clear.
#include <sivid/space/exact/detail/certified_rank.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cmath>

using namespace sivid;
using support::draws;

namespace {

interval_matrix<interval> widened_matrix(Eigen::MatrixXd const& m, double radius) {
    auto const rows = static_cast<std::size_t>(m.rows());
    interval_matrix<interval> a(rows, static_cast<std::size_t>(m.cols()));
    for (std::size_t i = 0; i < rows; ++i) {
        for (std::size_t j = 0; j < a.cols(); ++j) {
            a(i, j) = support::around(m(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)),
                                      radius);
        }
    }
    return a;
}
/// Integers, so that the planted rank is exact.
Eigen::MatrixXd integers(draws& d, Eigen::Index rows, Eigen::Index cols) {
    Eigen::MatrixXd m(rows, cols);
    for (Eigen::Index i = 0; i < rows; ++i) {
        for (Eigen::Index j = 0; j < cols; ++j) m(i, j) = static_cast<double>(d.below(21)) - 10;
    }
    return m;
}

} // namespace

TEST_CASE("a proved rank never exceeds that of a member, and reaches it for thin matrices") {
    draws d(611);
    int reached = 0, fewer = 0;
    for (int round = 0; round < 600; ++round) {
        auto const columns = static_cast<Eigen::Index>(1 + d.below(6));
        auto const rows = static_cast<Eigen::Index>(1 + d.below(12));
        auto const rank = static_cast<Eigen::Index>(
            d.below(static_cast<std::size_t>(std::min(rows, columns) + 1)));
        // A product of integers has rank `rank` at most, exactly.
        Eigen::MatrixXd m = integers(d, rows, rank) * integers(d, rank, columns);
        std::vector<double> weights;
        for (Eigen::Index i = 0; i < rows; ++i) weights.push_back(std::exp(d.uniform(-5, 5)));
        for (Eigen::Index j = 0; j < columns; ++j) {
            m.col(j) *= std::ldexp(1.0, static_cast<int>(d.below(40)) - 20);
        }
        double const radius = d.coin() ? 0 : std::ldexp(1.0, -static_cast<int>(d.below(40)));
        auto const proved = certified_rank(widened_matrix(m, radius), weights);
        REQUIRE(proved <= static_cast<std::size_t>(rank));
        if (radius == 0) {
            (proved == static_cast<std::size_t>(rank) ? reached : fewer) += 1;
        }
    }
    CHECK(reached > 9 * fewer); // the product of integers may lack rank itself
    CHECK(reached > 200);
}

TEST_CASE("a member of lower rank anywhere in the intervals is respected") {
    draws d(612);
    int full = 0;
    for (int round = 0; round < 300; ++round) {
        Eigen::MatrixXd m = integers(d, 5, 3);
        // A singular member is planted at most `radius` away.
        double const radius = std::ldexp(1.0, -static_cast<int>(d.below(12)));
        auto a = widened_matrix(m, radius);
        Eigen::MatrixXd singular = m;
        singular.col(2) = m.col(0) - m.col(1);
        for (std::size_t i = 0; i < 5; ++i) {
            a(i, 2) = hull(a(i, 2), interval(singular(static_cast<Eigen::Index>(i), 2)));
        }
        REQUIRE(certified_rank(a) <= 2);
        full += certified_rank(widened_matrix(m, 1e-9)) == 3 ? 1 : 0;
    }
    CHECK(full > 280);
}

TEST_CASE("unbounded and empty rows prove nothing and spoil nothing") {
    using traits = interval_traits<interval>;
    interval_matrix<interval> a(4, 2);
    a(0, 0) = traits::entire();
    a(1, 0) = interval(1.0);
    a(2, 1) = interval(2.0);
    a(3, 0) = traits::empty();
    CHECK(certified_rank(a) == 2);
    a(2, 1) = traits::entire();
    CHECK(certified_rank(a) == 1);
    CHECK(certified_rank(interval_matrix<interval>(3, 2)) == 0);
    CHECK(certified_rank(interval_matrix<interval>(0, 2)) == 0);
    CHECK_THROWS_AS(certified_rank(a, {1.0}), std::invalid_argument);
}
