// SPDX-License-Identifier: MIT
// The sums over the order in time that a step is made of, against exact numbers.
#include "support/catch.hpp"
#include "support/taylor_models.hpp"

#include <sivid/enclosure/series/detail/power_sum.hpp>

#include <cmath>
#include <cstddef>
#include <vector>

using namespace sivid;
using support::draws;
using support::rational;

TEST_CASE("coefficients at the end of a step, for a length known up to a unit") {
    draws d(21);
    for (int trial = 0; trial < 200; ++trial) {
        std::size_t const K = d.below(12);
        std::vector<support::sized_model<2, 2>> a;
        for (std::size_t k = 0; k <= K; ++k) {
            a.push_back(support::random_model<2, 2>(d, std::pow(10.0, d.uniform(-2, 2)), 1, 0));
            a.back().r() = 0;
        }
        // The computed difference of two times and the exact one.
        double const from = d.uniform(0, 100);
        double const to = from + std::pow(10.0, d.uniform(-6, 0));
        double const h = to - from;
        rational const exact_h = rational(to) - rational(from);
        auto const sum = at_time(
            model_shape<double>::of(2, 2),
            [&](std::size_t k) -> taylor_model<double> const& { return a[k]; }, K, h);
        support::any_polynomial exact;
        rational power = 1;
        for (std::size_t k = 0; k <= K; ++k) {
            exact = support::sum(exact, support::exact(a[k]), power);
            power *= exact_h;
        }
        CAPTURE(trial, K, h);
        REQUIRE(support::covers(sum, exact));
        REQUIRE(sum.r() <= 1e-13 * sum.polynomial_norm() * static_cast<double>(K + 1) + 1e-200);
        a[0].r() = 0.25; // radii are carried
        auto const wide = at_time(
            model_shape<double>::of(2, 2),
            [&](std::size_t k) -> taylor_model<double> const& { return a[k]; }, K, h);
        REQUIRE(wide.r() >= 0.25 + sum.r() * 0.5);
    }
}

TEST_CASE("a polynomial in time as a function of the place in the step") {
    draws d(22);
    for (int trial = 0; trial < 100; ++trial) {
        std::size_t const K = d.below(8);
        std::vector<support::sized_model<2, 3>> a;
        for (std::size_t k = 0; k <= K; ++k) {
            a.push_back(support::random_model<2, 3>(d, 1, 0.7, 0.01));
        }
        double const h = d.uniform(0.1, 0.9);
        auto const path = polynomials_in_time<double>(model_shape<double>::of(2, 3),
                                                      model_shape<double>::of(3, 2))(
            [&](std::size_t k) -> taylor_model<double> const& { return a[k]; }, K, h);
        for (int sample = 0; sample < 30; ++sample) {
            auto q = support::short_point(d, 3);
            rational const s = rational(h) * (1 + rational(q[2])) / 2;
            std::vector<double> const place{q[0], q[1]};
            rational x = 0, power = 1;
            for (std::size_t k = 0; k <= K; ++k) {
                x += power * support::member<rational>(d, a[k], place);
                power *= s;
            }
            CAPTURE(trial, K, sample);
            REQUIRE(support::holds(path, q, x));
        }
    }
}
