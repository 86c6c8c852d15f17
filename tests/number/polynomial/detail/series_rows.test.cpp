// SPDX-License-Identifier: MIT
#include <sivid/number/taylor_model.hpp>

#include "support/catch.hpp"
#include "support/rounding_modes.hpp"
#include "support/taylor_models.hpp"

#include <sivid/number/polynomial/detail/series_columns.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <vector>

using namespace sivid;
using support::any_polynomial;
using support::covers;
using support::draws;
using support::random_model;
using support::rational;
using support::sized_model;

namespace {

/// Two series of models, in rows and one by one. What stands beyond their orders is NaN.
template <std::size_t N, std::size_t D>
struct two_series {
    static constexpr std::size_t orders = 26;
    using model = sized_model<N, D>;
    std::vector<model> a, b;
    series_rows rows{2, orders, model::size()};

    two_series(draws& d, std::size_t known, double radius, bool wild) {
        constexpr double sizes[] = {1, 1e-3, 1e-160, 1e-310, 5e-324, 1e150};
        auto unknown = model::constant(std::numeric_limits<double>::quiet_NaN());
        unknown.r() = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < orders; ++k) {
            for (auto* s : {&a, &b}) {
                auto const size = wild ? sizes[d.below(6)] : 2.0;
                s->push_back(k < known ? random_model<N, D>(d, size, 0.8, radius) : unknown);
                rows.put(s == &a ? 0 : 1, k, s->back());
            }
        }
    }
};

struct range_of_orders {
    std::size_t k, from, to;
};
range_of_orders draw_range(draws& d, std::size_t most) {
    auto const k = d.below(most);
    auto const from = d.below(k + 1);
    return {k, from, from + d.below(k - from + 1)};
}

template <std::size_t N, std::size_t D>
void check_rounding(std::uint64_t seed, int trials) {
    draws d(seed);
    for (int trial = 0; trial < trials; ++trial) {
        bool const wild = d.coin();
        auto const r = draw_range(d, 24);
        // Coefficients that are not used may be anything: those above k, and with from > 0 also
        // those of b above k - from.
        two_series<N, D> const s(d, r.k + 1, 0, wild);
        double const factor = std::array{1.0, -1.0, 2.0}[d.below(3)];
        auto const weight = d.coin() ? convolved_by::one : convolved_by::order;
        bool const more = d.coin();
        any_polynomial expected;
        for (std::size_t j = r.from; j <= r.to; ++j) {
            auto const p = support::product(support::exact(s.a[j]), support::exact(s.b[r.k - j]));
            double const w = weight == convolved_by::one ? 1 : static_cast<double>(j);
            expected = support::sum(expected, p, rational(factor * w));
        }
        if (more) { // other addends in the same sum, another convolution among them
            expected = support::sum(expected, support::exact(s.a[0]), rational(-1));
            for (std::size_t j = 0; j <= r.k; ++j) {
                expected = support::sum(expected, support::product(support::exact(s.b[j]),
                                                                   support::exact(s.a[r.k - j])));
            }
        }
        for (int const mode : support::rounding_modes) {
            sized_model<N, D> result;
            support::in_mode(mode, [&] {
                product_sum<double> sum;
                sum.add_convolution(s.rows, 0, 1, r.k, r.from, r.to, factor, weight);
                if (more) {
                    sum.add(s.a[0], -1);
                    sum.add_convolution(s.rows, 1, 0, r.k, 0, r.k);
                }
                result = sum.result();
            });
            CAPTURE(N, D, trial, mode, r.k, r.from, r.to, factor, more);
            if (!wild) REQUIRE(std::isfinite(result.r()));
            if (std::isfinite(result.r())) REQUIRE(covers(result, expected));
        }
    }
}

template <std::size_t N, std::size_t D>
void check_members(std::uint64_t seed, int trials) {
    draws d(seed);
    for (int trial = 0; trial < trials; ++trial) {
        auto const r = draw_range(d, 20);
        two_series<N, D> const s(d, r.k + 1, 0.2, false);
        product_sum<double> rows, single;
        rows.add_convolution(s.rows, 0, 1, r.k, r.from, r.to);
        for (std::size_t j = r.from; j <= r.to; ++j) single.add(s.a[j], s.b[r.k - j]);
        auto const result = rows.result();
        for (std::size_t i = result.terms(); i < result.shape().radius; ++i)
            REQUIRE(result.c(i) == 0); // vectors of coefficients are read whole
        auto const reference = single.result();
        CAPTURE(N, D, trial, r.k, r.from, r.to);
        // Not wider than product by product.
        REQUIRE(result.r() <= reference.r() * (1 + 1e-12) + 1e-12);
        for (int sample = 0; sample < 6; ++sample) {
            auto const q = support::short_point(d, N);
            rational y = 0;
            for (std::size_t j = r.from; j <= r.to; ++j) {
                y += support::member<rational>(d, s.a[j], q) *
                     support::member<rational>(d, s.b[r.k - j], q);
            }
            REQUIRE(support::holds(result, q, y));
        }
    }
}

template <std::size_t N, std::size_t D>
void check_radii() {
    using model = sized_model<N, D>;
    auto const convolve = [](std::vector<taylor_model<double>> const& a,
                             std::vector<taylor_model<double>> const& b, std::size_t k) {
        series_rows rows(2, k + 1, model::size());
        for (std::size_t j = 0; j <= k; ++j) {
            rows.put(0, j, a[j]);
            rows.put(1, j, b[j]);
        }
        product_sum<double> sum;
        sum.add_convolution(rows, 0, 1, k, 0, k);
        return std::vector<taylor_model<double>>{sum.result()};
    };
    for (std::size_t const k : {0U, 3U, 7U, 8U, 15U, 16U, 23U}) {
        support::check_radii_of_orders(model::size(), k, convolve);
    }
}

} // namespace

TEST_CASE("Series rows: the radius covers what a convolution rounds and cuts off") {
    check_rounding<1, 0>(1, 150);
    check_rounding<2, 1>(2, 100);
    check_rounding<3, 2>(3, 40);
    check_rounding<2, 4>(4, 20);
    check_rounding<4, 3>(5, 8); // its products are not unrolled
}

TEST_CASE("Series rows: a convolution contains all products of members") {
    check_members<1, 0>(11, 60);
    check_members<2, 2>(12, 40);
    check_members<3, 3>(13, 10);
}

TEST_CASE("Series rows: every order's radius counts") {
    check_radii<1, 0>();
    check_radii<2, 1>();
}

TEST_CASE("Series of one size take no model of another") {
    auto const& announced = model_shape<double>::of(4, 1);
    taylor_model<double> const other(model_shape<double>::of(1, 4)); // as many coefficients
    series_rows rows(1, 2, announced);
    CHECK_THROWS_AS(rows.put(0, 1, other), std::logic_error);
    series_columns columns(1, 1, 2, announced);
    CHECK_THROWS_AS(columns.put(0, 0, 1, other), std::logic_error);
    column_multiplier multiplier(2, announced);
    CHECK_THROWS_AS(multiplier.put(1, other), std::logic_error);
}

TEST_CASE("Series rows: a radius that is not finite stays so") {
    draws d(31);
    for (std::size_t const lost : {0U, 4U, 9U}) {
        two_series<2, 1> s(d, 10, 0.1, false);
        s.a[lost].r() = std::numeric_limits<double>::infinity();
        s.rows.put(0, lost, s.a[lost]);
        product_sum<double> sum, other;
        sum.add_convolution(s.rows, 0, 1, 9, 0, 9);
        REQUIRE(!std::isfinite(sum.result().r()));
        // A convolution that leaves it out knows its value.
        if (lost == 0) other.add_convolution(s.rows, 0, 1, 9, 1, 9);
        if (lost == 4) other.add_convolution(s.rows, 0, 1, 9, 5, 9);
        if (lost == 9) other.add_convolution(s.rows, 0, 1, 9, 0, 8);
        REQUIRE(std::isfinite(other.result().r()));
    }
}
