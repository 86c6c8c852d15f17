// SPDX-License-Identifier: MIT
#include <sivid/space/matrix.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/power_series.hpp"
#include "support/random.hpp"

#include <vector>

using namespace sivid;
using support::draws;
using support::encloses;
using support::mp;

namespace {

interval_matrix<interval> random_matrix(draws& d, std::size_t rows, std::size_t cols) {
    interval_matrix<interval> m(rows, cols);
    for (std::size_t i = 0; i < rows; ++i) {
        for (std::size_t j = 0; j < cols; ++j) m(i, j) = d.interval(-3, 3, 1);
    }
    return m;
}
/// A matrix of doubles within `m`.
Eigen::MatrixXd member(draws& d, interval_matrix<interval> const& m) {
    Eigen::MatrixXd r(static_cast<Eigen::Index>(m.rows()), static_cast<Eigen::Index>(m.cols()));
    for (std::size_t i = 0; i < m.rows(); ++i) {
        for (std::size_t j = 0; j < m.cols(); ++j) {
            r(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = d.in(m(i, j));
        }
    }
    return r;
}
mp entry(Eigen::MatrixXd const& a, Eigen::MatrixXd const& b, Eigen::Index i, Eigen::Index j) {
    mp sum = 0;
    for (Eigen::Index k = 0; k < a.cols(); ++k) sum += mp(a(i, k)) * mp(b(k, j));
    return sum;
}

} // namespace

TEST_CASE("products of interval matrices enclose the products of their members") {
    draws d(21);
    for (int round = 0; round < 200; ++round) {
        auto const a = random_matrix(d, 2, 3);
        auto const b = random_matrix(d, 3, 4);
        auto const c = product(a, b);
        REQUIRE((c.rows() == 2 && c.cols() == 4));
        auto const ra = member(d, a);
        auto const rb = member(d, b);
        auto const with_doubles = product(a, rb);
        for (std::size_t i = 0; i < 2; ++i) {
            for (std::size_t j = 0; j < 4; ++j) {
                auto const exact =
                    entry(ra, rb, static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
                CHECK(encloses(c(i, j), exact));
                CHECK(encloses(with_doubles(i, j), exact));
                CHECK(subset(with_doubles(i, j), c(i, j)));
            }
        }
        box x(3);
        Eigen::MatrixXd rx(3, 1);
        for (std::size_t i = 0; i < 3; ++i) {
            x[i] = d.interval(-2, 2, 1);
            rx(static_cast<Eigen::Index>(i), 0) = d.in(x[i]);
        }
        auto const y = product(a, x);
        auto const z = product(ra, x);
        for (std::size_t i = 0; i < 2; ++i) {
            auto const exact = entry(ra, rx, static_cast<Eigen::Index>(i), 0);
            CHECK(encloses(y[i], exact));
            CHECK(encloses(z[i], exact));
        }
    }
}

TEST_CASE("the identity, sums and differences of vectors") {
    auto const one = interval_matrix<interval>::identity(3);
    box const x{support::between(1, 2), support::between(-1, 4), support::between(5, 5)};
    auto const same = product(one, x);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(same[i].lower() == x[i].lower());
        CHECK(same[i].upper() == x[i].upper());
    }
    auto const moved = subtract(x, {1, 1, 1});
    CHECK(moved[0].lower() == 0);
    CHECK(moved[1].upper() == 3);
    auto const back = add(moved, point_box({1, 1, 1}));
    CHECK(back[2].lower() == 5);
    CHECK(back[1].lower() == -1);
    // 0.1 - 1e10 is no double: the difference must have width.
    CHECK(width(subtract(point_box({0.1}), {1e10})[0]) > 0);
}

TEST_CASE("approximate centres lie within the entries") {
    draws d(22);
    auto const a = random_matrix(d, 4, 3);
    auto const m = approximate_mid(a);
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            CHECK(contains(a(i, j), m(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j))));
        }
    }
}
