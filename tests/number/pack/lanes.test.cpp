// SPDX-License-Identifier: MIT
#include "support/catch.hpp"
#include "support/taylor_models.hpp"

#include <sivid/number/pack/lanes.hpp>
#include <sivid/number/polynomial/taylor_model_functions.hpp>

#include <cmath>
#include <cstddef>
#include <vector>

using namespace sivid;
using support::draws;

namespace {

using eight = lanes<8>;

/// Eight models side by side.
taylor_model<eight> together(std::vector<support::sized_model<2, 3>> const& models) {
    taylor_model<eight> m(model_shape<eight>::of(2, 3));
    for (std::size_t l = 0; l < 8; ++l) {
        for (std::size_t i = 0; i < m.terms(); ++i) m.c(i).set(l, models[l].c(i));
        m.r().set(l, models[l].r());
    }
    m.finish();
    return m;
}
std::vector<support::sized_model<2, 3>> random_models(draws& d, double size, double decay,
                                                      double radius) {
    std::vector<support::sized_model<2, 3>> models;
    for (int l = 0; l < 8; ++l) {
        models.push_back(support::random_model<2, 3>(d, size, decay, radius));
    }
    return models;
}

} // namespace

TEST_CASE("lanes compute what doubles compute") {
    draws d(11);
    for (int trial = 0; trial < 500; ++trial) {
        eight a, b;
        for (std::size_t l = 0; l < 8; ++l) {
            a.set(l, d.below(9) == 0 ? 0.0 : d.uniform(-2, 2));
            b.set(l, d.below(9) == 0 ? a[l] : d.uniform(-2, 2));
        }
        auto const sum = a + b;
        auto const difference = a - b;
        auto const product = a * b;
        auto const quotient = a / b;
        auto const negative = -a;
        auto const size = eight::abs(a);
        auto const most = eight::max(a, b);
        auto const least = eight::min(a, b);
        auto const mask = lanes_mask<8>::from_bits(d.below(256));
        auto const mixed = eight::select(mask, a, b);
        for (std::size_t l = 0; l < 8; ++l) {
            REQUIRE(sum[l] == a[l] + b[l]);
            REQUIRE(difference[l] == a[l] - b[l]);
            REQUIRE(product[l] == a[l] * b[l]);
            if (b[l] != 0) REQUIRE(quotient[l] == a[l] / b[l]);
            REQUIRE(negative[l] == -a[l]);
            REQUIRE(size[l] == std::abs(a[l]));
            REQUIRE(most[l] == std::fmax(a[l], b[l]));
            REQUIRE(least[l] == std::fmin(a[l], b[l]));
            REQUIRE(mixed[l] == (mask[l] ? a[l] : b[l]));
            REQUIRE((a < b)[l] == (a[l] < b[l]));
            REQUIRE((a <= b)[l] == (a[l] <= b[l]));
            REQUIRE((a > b)[l] == (a[l] > b[l]));
            REQUIRE((a >= b)[l] == (a[l] >= b[l]));
            REQUIRE((a == b)[l] == (a[l] == b[l]));
        }
    }
    eight nan(0.0);
    nan.set(3, std::nan(""));
    CHECK((nan <= eight(0.0)).bits() == 0xF7);
    CHECK((!(nan < eight(1.0))).bits() == 0x08);
    CHECK(eight::max(nan, eight(1.0))[3] == 1.0);
}

TEST_CASE("masks") {
    using mask = lanes_mask<8>;
    CHECK(mask(true).bits() == 0xFF);
    CHECK((!mask::only(2)).bits() == 0xFB);
    CHECK((mask::only(1) | mask::only(4)).bits() == 0x12);
    CHECK((mask(true) & mask::only(7))[7]);
    CHECK_FALSE((mask(true) & mask::only(7))[0]);
    using both = lane_traits<eight>;
    CHECK(both::any(mask::only(5)));
    CHECK_FALSE(both::all(mask::only(5)));
    CHECK(both::all(mask(true)));
    CHECK_FALSE(both::any(mask(false)));
}

TEST_CASE("products in lanes cover the exact ones, with integer factors and constant operands") {
    draws d(12);
    for (int trial = 0; trial < 60; ++trial) {
        auto a = random_models(d, 1, 0.7, 0);
        auto b = random_models(d, 3, 0.9, 0);
        bool const constant = d.coin();
        double const factor = std::vector<double>{1, -1, 2, 7}[d.below(4)];
        for (auto* list : {&a, &b}) {
            for (auto& m : *list) {
                m.r() = 0;
                if (constant && list == &b) m = support::sized_model<2, 3>::constant(m.c(0));
            }
        }
        product_sum<eight> sum;
        sum.add(together(a), together(b), factor);
        sum.add(together(b), -1);
        auto const result = sum.result();
        for (std::size_t l = 0; l < 8; ++l) {
            product_sum<> sum_alone;
            sum_alone.add(a[l], b[l], factor);
            sum_alone.add(b[l], -1);
            auto const alone = sum_alone.result();
            auto product = support::product(support::exact(a[l]), support::exact(b[l]));
            for (auto& term : product) term.second *= support::rational(factor);
            auto const exact = support::sum(product, support::exact(b[l]), support::rational(-1));
            REQUIRE(support::covers(lane_of(result, l), exact));
            REQUIRE(support::covers(alone, exact));
            // Not needlessly wide either: what is cut off, and some roundings.
            REQUIRE(result.r()[l] <= alone.r() * (1 + 1e-9) + 1e-280);
        }
    }
}

TEST_CASE("functions in lanes enclose the same as alone, undefined lanes apart") {
    draws d(13);
    for (int trial = 0; trial < 40; ++trial) {
        auto models = random_models(d, 0.3, 0.5, 0.01);
        std::size_t const bad = d.below(8);
        for (std::size_t l = 0; l < 8; ++l) {
            models[l].c(0) = l == bad ? 0.01 : d.uniform(1, 3);
            models[l].finish();
        }
        auto const all = together(models);
        auto const compare = [&](auto const& f, bool partial) {
            lanes_mask<8> undefined(false);
            auto const result = f(all, undefined);
            for (std::size_t l = 0; l < 8; ++l) {
                bool alone_undefined = false;
                auto const alone = f(models[l], alone_undefined);
                REQUIRE(undefined[l] == alone_undefined);
                auto const lane = lane_of(result, l);
                if (alone_undefined) {
                    REQUIRE(partial);
                    REQUIRE_FALSE(std::isfinite(lane.r()));
                    continue;
                }
                REQUIRE(lane.r() <= alone.r() * (1 + 1e-6) + 1e-15);
                for (int sample = 0; sample < 6; ++sample) {
                    auto const q = support::short_point(d, 2);
                    double const apart = std::abs(support::value<double>(lane, q) -
                                                  support::value<double>(alone, q));
                    REQUIRE(apart <= lane.r() + alone.r() + 1e-14);
                }
            }
        };
        compare([](auto const& m, auto& undefined) { return reciprocal(m, undefined); }, true);
        compare([](auto const& m, auto& undefined) { return sivid::sqrt(m, undefined); }, true);
        for (auto const f : {univariate::sin, univariate::cos, univariate::exp, univariate::atan,
                             univariate::tanh}) {
            compare([f](auto const& m, auto& undefined) { return apply(f, m, undefined); }, false);
        }
        compare([](auto const& m, auto& undefined) { return apply(univariate::log, m, undefined); },
                true);
        auto const range = bounds(all);
        for (std::size_t l = 0; l < 8; ++l) {
            auto const alone = bounds(models[l]);
            REQUIRE(std::abs(range.lower[l] - alone.lower) <= 1e-14);
            REQUIRE(std::abs(range.upper[l] - alone.upper) <= 1e-14);
        }
    }
}

TEST_CASE("the power of two below each lane") {
    using namespace sivid;
    CHECK(unit_below(1.0) == 1.0);
    CHECK(unit_below(1023.0) == 512.0);
    CHECK(unit_below(0.3) == 0.25);
    for (double const odd : {0.0, -3.0, 1e200, 1e-200, HUGE_VAL, std::nan("")})
        CHECK(unit_below(odd) == 1.0);
    lanes<8> x(5.0);
    lane_traits<lanes<8>>::put(x, 3, 1e-3);
    CHECK(unit_below(x)[0] == 4.0);
    CHECK(unit_below(x)[3] == 0x1p-10);
}
