// SPDX-License-Identifier: MIT
// Convolutions with all columns at once against rational arithmetic, members, and the same sums
// product by product.
#include <sivid/number/polynomial/detail/series_columns.hpp>

#include "support/catch.hpp"
#include "support/sweep.hpp"
#include "support/taylor_models.hpp"

#include <sivid/number/taylor_model.hpp>

#include <array>
#include <cfenv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

using namespace sivid;
using support::any_polynomial;
using support::covers;
using support::draws;
using support::random_model;
using support::rational;
using support::sized_model;

namespace {

constexpr std::size_t orders = 24;

/// Two single series, and two rows of columns; what stands beyond the orders known is NaN.
template <std::size_t N, std::size_t D>
struct rows_and_factors {
    using model = sized_model<N, D>;
    std::size_t columns;
    std::array<std::vector<model>, 2> a;
    std::array<std::vector<std::vector<model>>, 2> v; ///< [row][column][k]
    std::array<column_multiplier, 2> factors{column_multiplier(orders, model::size()),
                                             column_multiplier(orders, model::size())};
    series_columns kept;

    rows_and_factors(draws& d, std::size_t many, std::size_t known, double radius, bool wild)
        : columns(many), kept(3, many, orders + 1, model::size()) {
        auto unknown = model::constant(std::numeric_limits<double>::quiet_NaN());
        unknown.r() = std::numeric_limits<double>::infinity();
        constexpr double sizes[] = {1, 1e-3, 1e-160, 1e-310, 5e-324, 1e150};
        auto const next = [&](std::size_t k) {
            auto const size = wild ? sizes[d.below(6)] : 2.0;
            return k < known ? random_model<N, D>(d, size, 0.8, radius) : unknown;
        };
        for (std::size_t s = 0; s < 2; ++s) {
            v[s].resize(columns);
            for (std::size_t k = 0; k < orders; ++k) {
                a[s].push_back(next(k));
                factors[s].put(k, a[s].back());
                for (std::size_t c = 0; c < columns; ++c) {
                    v[s][c].push_back(next(k));
                    kept.put(s, c, k, v[s][c].back());
                }
            }
        }
    }
};

[[gnu::noinline]] void in_mode(int mode, auto const& f) {
    std::fesetround(mode);
    f();
    std::fesetround(FE_TONEAREST);
}

template <std::size_t N, std::size_t D>
void check_rounding(std::uint64_t seed, int trials) {
    draws d(seed);
    for (int trial = 0; trial < trials; ++trial) {
        bool const wild = d.coin();
        std::size_t const k = d.below(orders), columns = 1 + d.below(11);
        std::size_t const to = d.coin() ? k : d.below(k + 1);
        std::size_t const divisor = d.coin() ? 1 : k + 2;
        // Too few expected: the sum has to find out.
        std::size_t const expected = d.coin() ? k + 1 : 1, addends = d.coin() ? 3 : 0;
        rows_and_factors<N, D> s(d, columns, k + 1, 0, wild);
        std::size_t const alone = d.below(columns);
        for (int const mode : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
            in_mode(mode, [&] {
                columns_sum sum(s.kept.groups(), sized_model<N, D>::size());
                for (int again = 0; again < 2; ++again) { // what stood there before does not count
                    sum.start(expected, addends);
                    sum.add(alone, s.a[1][k]);
                    sum.add_convolution(s.factors[0], s.kept, 0, k, k);
                    sum.add_convolution(s.factors[1], s.kept, 1, k, to);
                }
                sum.divide_into(s.kept, 2, k, divisor);
            });
            for (std::size_t c = 0; c < columns; ++c) {
                any_polynomial exact;
                auto const share = rational(1) / rational(static_cast<double>(divisor));
                auto const add = [&](sized_model<N, D> const& x, sized_model<N, D> const& y) {
                    exact = support::sum(
                        exact, support::product(support::exact(x), support::exact(y)), share);
                };
                if (c == alone) exact = support::sum(exact, support::exact(s.a[1][k]), share);
                for (std::size_t j = 0; j <= k; ++j) add(s.a[0][j], s.v[0][c][k - j]);
                for (std::size_t j = 0; j <= to; ++j) add(s.a[1][j], s.v[1][c][k - j]);
                auto const result = s.kept.get(2, c, k);
                CAPTURE(N, D, trial, mode, k, to, c, columns, divisor, wild);
                if (!wild) REQUIRE(std::isfinite(result.r()));
                if (std::isfinite(result.r())) REQUIRE(covers(result, exact));
                auto again = result;
                again.finish();
                for (std::size_t n = 0; n <= D; ++n) {
                    REQUIRE(!(result.norms()[n] < again.norms()[n] * (1 - 1e-12)));
                }
            }
        }
    }
}

template <std::size_t N, std::size_t D>
void check_members(std::uint64_t seed, int trials) {
    draws d(seed);
    for (int trial = 0; trial < trials; ++trial) {
        std::size_t const k = d.below(orders), columns = 1 + d.below(9);
        rows_and_factors<N, D> s(d, columns, k + 1, 0.2, false);
        columns_sum sum(s.kept.groups(), sized_model<N, D>::size());
        sum.start(k + 1, 1);
        sum.add_convolution(s.factors[0], s.kept, 0, k, k);
        sum.divide_into(s.kept, 2, k, 4); // exact
        for (std::size_t c = 0; c < columns; ++c) {
            product_sum<double> single;
            for (std::size_t j = 0; j <= k; ++j) single.add(s.a[0][j], s.v[0][c][k - j]);
            auto const reference = single.result();
            auto const result = s.kept.get(2, c, k);
            CAPTURE(N, D, trial, k, c);
            // Not wider than product by product.
            REQUIRE(result.r() * 4 <= reference.r() * (1 + 1e-12) + 1e-12);
            for (int sample = 0; sample < 3; ++sample) {
                auto const q = support::short_point(d, N);
                rational y = 0;
                for (std::size_t j = 0; j <= k; ++j) {
                    y += support::member<rational>(d, s.a[0][j], q) *
                         support::member<rational>(d, s.v[0][c][k - j], q);
                }
                REQUIRE(support::holds(result, q, y / rational(4)));
            }
        }
    }
}

template <std::size_t N, std::size_t D>
void check_radii() {
    using model = sized_model<N, D>;
    auto const convolve = [](std::vector<taylor_model<double>> const& a,
                             std::vector<taylor_model<double>> const& b, std::size_t k) {
        constexpr std::size_t columns = 9;
        series_columns v(2, columns, orders, sized_model<N, D>::size());
        column_multiplier factor(orders, sized_model<N, D>::size());
        for (std::size_t j = 0; j <= k; ++j) {
            factor.put(j, a[j]);
            for (std::size_t c = 0; c < columns; ++c) v.put(0, c, j, b[j]);
        }
        columns_sum sum(v.groups(), sized_model<N, D>::size());
        sum.start(k + 1, 1);
        sum.add_convolution(factor, v, 0, k, k);
        sum.divide_into(v, 1, k, 1);
        std::vector<taylor_model<double>> result;
        for (std::size_t c = 0; c < columns; ++c) result.push_back(v.get(1, c, k));
        return result;
    };
    for (std::size_t const k : {0U, 1U, 3U, 4U, 7U, 8U, 15U, 23U}) {
        support::check_radii_of_orders(model::size(), k, convolve);
    }
}

} // namespace

TEST_CASE("Series columns: the radius covers what a sum rounds and cuts off") {
    check_rounding<1, 0>(1, support::swept(10, 120));
    check_rounding<2, 1>(2, support::swept(5, 60));
    check_rounding<3, 2>(3, support::swept(2, 15));
    check_rounding<2, 4>(4, support::swept(1, 6));
    check_rounding<4, 3>(5, support::swept(1, 2)); // its products are not unrolled
}

TEST_CASE("Series columns: a convolution contains all products of members") {
    check_members<1, 0>(11, 40);
    check_members<2, 2>(12, 12);
    check_members<3, 3>(13, 2);
}

TEST_CASE("Series columns: every order's radius counts") {
    check_radii<1, 0>();
    check_radii<2, 1>();
}

TEST_CASE("Series columns: a radius that is not finite stays so, in its column") {
    draws d(31);
    for (std::size_t const lost : {0U, 4U, 9U}) {
        rows_and_factors<2, 1> s(d, 10, 10, 0.1, false);
        auto unknown = s.v[0][8][lost];
        unknown.r() = std::numeric_limits<double>::infinity();
        s.kept.put(0, 8, lost, unknown);
        columns_sum sum(s.kept.groups(), sized_model<2, 1>::size());
        sum.start(10, 1);
        sum.add_convolution(s.factors[0], s.kept, 0, 9, 9);
        sum.divide_into(s.kept, 2, 9, 10);
        for (std::size_t c = 0; c < 10; ++c) {
            CHECK(std::isfinite(s.kept.get(2, c, 9).r()) == (c != 8));
        }
        unknown = s.a[1][lost];
        unknown.r() = std::numeric_limits<double>::quiet_NaN();
        s.factors[1].put(lost, unknown);
        sum.start(10, 1);
        sum.add_convolution(s.factors[1], s.kept, 1, 9, 9);
        sum.divide_into(s.kept, 2, 9, 10);
        for (std::size_t c = 0; c < 10; ++c) CHECK(!std::isfinite(s.kept.get(2, c, 9).r()));
    }
}

TEST_CASE("Series columns: what may have overflowed on the way is not known") {
    using model = sized_model<1, 0>;
    for (int const mode : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
        series_columns v(2, 1, 2, sized_model<1, 0>::size());
        column_multiplier a(2, sized_model<1, 0>::size());
        a.put(0, model::constant(1e200));
        a.put(1, model::constant(-1e200));
        v.put(0, 0, 0, model::constant(1e200));
        v.put(0, 0, 1, model::constant(1e200));
        in_mode(mode, [&] {
            columns_sum sum(v.groups(), sized_model<1, 0>::size());
            sum.start(2, 1);
            sum.add_convolution(a, v, 0, 1, 1);
            sum.divide_into(v, 1, 1, 1);
        });
        CHECK(v.get(1, 0, 1).r() == std::numeric_limits<double>::infinity());
    }
}
