// SPDX-License-Identifier: MIT
#include "support/catch.hpp"
#include "support/rounding_modes.hpp"
#include "support/taylor_models.hpp"

#include <sivid/number/decimal.hpp>
#include <sivid/number/polynomial/detail/bernstein.hpp>
#include <sivid/number/taylor_model.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

using namespace sivid;
using support::any_polynomial;
using support::covers;
using support::draws;
using support::exact;
using support::holds;
using support::monomials_of;
using support::random_model;
using support::rational;
using support::sized_model;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Numbers of all sizes: ordinary, tiny, subnormal, huge.
template <std::size_t N, std::size_t D>
sized_model<N, D> wild_model(draws& d) {
    constexpr double sizes[] = {1, 1e-3, 1e-160, 1e-300, 1e-310, 5e-324, 1e150, 1e160};
    auto a = random_model<N, D>(d, sizes[d.below(8)], 1, 0);
    for (auto& c : a.coefficients()) {
        if (d.below(6) == 0) c *= sizes[d.below(8)];
    }
    a.finish();
    return a;
}

bool all_finite(taylor_model<double> const& a) {
    for (double const c : a.coefficients()) {
        if (!std::isfinite(c)) return false;
    }
    return true;
}

/// A finite radius promises that the coefficients are finite and right.
bool right(taylor_model<double> const& a, any_polynomial const& p) {
    return !std::isfinite(a.r()) || (all_finite(a) && covers(a, p));
}

template <std::size_t N, std::size_t D>
void check_rounding(std::uint64_t seed, int trials) {
    draws d(seed);
    for (int trial = 0; trial < trials; ++trial) {
        auto const a = wild_model<N, D>(d);
        auto const b = wild_model<N, D>(d);
        double const m = wild_model<N, D>(d).c()[0];
        if (!all_finite(a) || !all_finite(b) || !std::isfinite(m)) continue;
        auto const p = exact(a);
        auto const s = exact(b);
        for (int const mode : support::rounding_modes) {
            sized_model<N, D> sum, difference, times, twice, negative;
            support::in_mode(mode, [&] {
                sum = a + b;
                difference = a - b;
                times = a * b;
                twice = scaled(a, m);
                negative = -a;
            });
            CAPTURE(N, D, trial, mode);
            REQUIRE(right(sum, support::sum(p, s)));
            REQUIRE(right(difference, support::sum(p, s, rational(-1))));
            REQUIRE(right(times, support::product(p, s)));
            REQUIRE(right(twice, support::sum(any_polynomial{}, p, rational(m))));
            REQUIRE(right(negative, support::sum(any_polynomial{}, p, rational(-1))));
        }
    }
}

template <std::size_t N, std::size_t D>
void check_containment(std::uint64_t seed, int trials) {
    draws d(seed);
    for (int trial = 0; trial < trials; ++trial) {
        auto const a = random_model<N, D>(d, 2, 0.8, 0.3);
        auto const b = random_model<N, D>(d, 2, 0.8, 0.3);
        auto const sum = a + b;
        auto const difference = a - b;
        auto const times = a * b;
        auto const negative = -a;
        double const m = d.uniform(-3, 3);
        double const rho = d.coin() ? 0 : d.uniform(0, 0.5);
        auto const multiple = scaled(a, m, rho);
        auto const wide = widened(a, rho);
        product_sum<double> total;
        total.add(a, b);
        total.add(b);
        total.add(a, a);
        auto const many = total.result();
        for (int sample = 0; sample < 8; ++sample) {
            auto const q = support::short_point(d, N);
            auto const x = support::member<rational>(d, a, q);
            auto const y = support::member<rational>(d, b, q);
            CAPTURE(N, D, trial, sample);
            REQUIRE(holds(sum, q, rational(x + y)));
            REQUIRE(holds(difference, q, rational(x - y)));
            REQUIRE(holds(times, q, rational(x * y)));
            REQUIRE(holds(negative, q, rational(-x)));
            REQUIRE(holds(many, q, rational(x * y + y + x * x)));
            for (double const end : {-1.0, 1.0}) {
                rational const factor = rational(m) + rational(end) * rational(rho);
                REQUIRE(holds(multiple, q, rational(factor * x)));
                REQUIRE(holds(wide, q, rational(x + rational(end) * rational(rho))));
            }
            REQUIRE(rational(rough_range(times).lower()) <= x * y);
            REQUIRE(x * y <= rational(rough_range(times).upper()));
            REQUIRE(abs(rational(x * y)) <= rational(times.norm()));
        }
    }
}

} // namespace

TEST_CASE("Taylor models: operations contain all products of members") {
    check_containment<1, 3>(1, 40);
    check_containment<3, 2>(2, 40);
    check_containment<2, 4>(3, 20);
    check_containment<2, 1>(4, 40);
}

TEST_CASE("Taylor models: the radius covers each coefficient's error in every rounding mode") {
    check_rounding<1, 3>(5, 60);
    check_rounding<3, 2>(6, 60);
    check_rounding<2, 1>(7, 60);
}

TEST_CASE("Taylor models: one rounding bound for hundreds of products") {
    using model = sized_model<2, 3>;
    for (std::size_t const addends : {1U, 20U, 400U}) {
        for (int const mode : support::rounding_modes) {
            draws d(addends);
            std::vector<model> a, b;
            any_polynomial p;
            for (std::size_t k = 0; k < addends; ++k) {
                // of one sign, so that directed rounding errs on one side all the time
                auto x = random_model<2, 3>(d, 1, 1, 0);
                for (auto& c : x.coefficients()) c = std::abs(c);
                x.finish();
                a.push_back(x);
                b.push_back(d.coin() ? x : random_model<2, 3>(d, 1e-3, 1, 0));
                p = support::sum(p, support::product(exact(a[k]), exact(b[k])));
                p = support::sum(p, exact(b[k]));
            }
            model result;
            support::in_mode(mode, [&] {
                product_sum<double> sum;
                for (std::size_t k = 0; k < addends; ++k) {
                    sum.add(a[k], b[k]);
                    sum.add(b[k]);
                }
                result = sum.result();
            });
            CAPTURE(addends, mode);
            REQUIRE(covers(result, p));
        }
    }
}

TEST_CASE("Taylor models: products without truncation lose rounding errors only") {
    draws d(9);
    for (int trial = 0; trial < 30; ++trial) {
        auto a = random_model<2, 4>(d, 1, 1, 0);
        auto b = random_model<2, 4>(d, 1, 1, 0);
        a.r() = b.r() = 0;
        for (std::size_t i = monomials_of(a).first[3]; i < a.terms(); ++i) a.c()[i] = b.c()[i] = 0;
        a.finish();
        b.finish();
        auto const product = a * b;
        REQUIRE(covers(product, support::product(exact(a), exact(b))));
        REQUIRE(product.r() <= 1e-14 * (1 + a.norm() * b.norm()));
    }
}

TEST_CASE("Taylor models: norms are upper bounds in every rounding mode") {
    draws d(10);
    for (int trial = 0; trial < 100; ++trial) {
        auto const a = wild_model<3, 3>(d);
        if (!std::isfinite(a.norm())) continue;
        for (int const mode : support::rounding_modes) {
            auto b = a;
            b.r() = 0.25;
            double spread = 0, polynomial = 0, norm = 0;
            support::in_mode(mode, [&] {
                b.finish();
                spread = b.spread();
                polynomial = b.polynomial_norm();
                norm = b.norm();
            });
            CAPTURE(trial, mode);
            rational all = 0;
            for (std::size_t k = 0; k <= 3; ++k) {
                rational exact_norm = 0;
                for (auto i = monomials_of(b).first[k]; i < monomials_of(b).first[k + 1]; ++i) {
                    exact_norm += abs(rational(b.c()[i]));
                }
                REQUIRE(exact_norm <= rational(b.norms()[k]));
                REQUIRE(b.norms()[k] <= static_cast<double>(exact_norm) * (1 + 1e-12) + 1e-323);
                all += k > 0 ? exact_norm : rational(0);
            }
            REQUIRE(all <= rational(spread));
            all += abs(rational(b.c()[0]));
            REQUIRE(all <= rational(polynomial));
            REQUIRE(all + rational(b.r()) <= rational(norm));
        }
    }
}

TEST_CASE("Taylor models: the norms of a multiple bound what became of its coefficients") {
    draws d(12);
    for (int trial = 0; trial < 300; ++trial) {
        auto const a = wild_model<3, 3>(d);
        constexpr double factors[] = {1, -3, 1e-3, 1e-290, 1e-310, 5e-324, 1e150, 0};
        double const m = factors[d.below(8)] * d.uniform(0.5, 1);
        for (int const mode : support::rounding_modes) {
            sized_model<3, 3> b;
            support::in_mode(mode, [&] { b = scaled(a, m); });
            if (!std::isfinite(b.r())) continue;
            CAPTURE(trial, mode, m);
            rational spread = 0;
            for (std::size_t k = 0; k <= 3; ++k) {
                rational norm = 0;
                for (auto i = monomials_of(b).first[k]; i < monomials_of(b).first[k + 1]; ++i) {
                    norm += abs(rational(b.c()[i]));
                }
                REQUIRE(norm <= rational(b.norms()[k]));
                REQUIRE(rational(b.norms()[k]) <=
                        rational(a.norms()[k]) * abs(rational(m)) * rational(1 + 1e-12) +
                            rational(2 * b.tiny));
                spread += k > 0 ? norm : rational(0);
            }
            REQUIRE(spread <= rational(b.spread()));
        }
    }
    // What no variable enters stays so.
    REQUIRE(scaled(sized_model<2, 2>::constant(3), 1.0 / 3).is_constant());
}

TEST_CASE("Taylor models: constants and variables") {
    using model = sized_model<2, 2>;
    auto const x = model::variable(1, 3.0, 0.25);
    REQUIRE(x.r() == 0);
    REQUIRE(support::value<rational>(x, {0.5, 1}) == rational(3.25));
    auto const c = model::constant(hull(0.1_dec, 0.3_dec));
    REQUIRE(rational(c.c()[0]) - rational(c.r()) <= rational(1) / 10);
    REQUIRE(rational(c.c()[0]) + rational(c.r()) >= rational(3) / 10);
    REQUIRE_FALSE(std::isfinite(model::constant(interval_traits<interval>::entire()).r()));
    REQUIRE_FALSE(std::isfinite(model::constant(interval_traits<interval>::empty()).r()));
}

TEST_CASE("Taylor models: a growing vector moves them") {
    using model = taylor_model<double>;
    static_assert(std::is_nothrow_move_constructible_v<model>);
    auto const x = model::variable(model_shape<double>::of(3, 2), 1, 3.0, 0.25);
    std::vector<model> all;
    all.reserve(1);
    all.push_back(x);
    auto const* const block = all.front().c();
    for (int k = 0; k < 20; ++k) all.push_back(x);
    CHECK(all.front().c() == block);
    auto const moved = std::move(all.front());
    CHECK(moved.c() == block);
    CHECK(support::value<rational>(moved, {0, 1, 0}) == rational(3.25));
    // What is held within itself is copied: it has no block.
    auto number = model::constant(2.5);
    auto const other = std::move(number);
    CHECK(other.c(0) == 2.5);
}

TEST_CASE("Taylor models: conversion moves what does not fit into the radius") {
    draws d(12);
    for (int trial = 0; trial < 60; ++trial) {
        auto const a = random_model<2, 4>(d, 1, 1, 0.1);
        auto const lower = converted(a, sized_model<2, 2>::size());
        auto const wider = converted(a, sized_model<3, 3>::size());
        auto const same = converted(a, sized_model<3, 5>::size());
        REQUIRE(same.r() <= a.r() * (1 + 1e-12));
        for (int sample = 0; sample < 6; ++sample) {
            auto q = support::short_point(d, 2);
            auto const x = support::member<rational>(d, a, q);
            REQUIRE(holds(lower, q, x));
            q.push_back(d.uniform(-1, 1));
            REQUIRE(holds(wider, q, x));
            REQUIRE(holds(same, q, x));
        }
    }
}

TEST_CASE("Taylor models: forgetting the last variable keeps all its values") {
    draws d(13);
    for (int trial = 0; trial < 60; ++trial) {
        auto const a = random_model<3, 3>(d, 1, 1, 0.1);
        auto const b = without_last_variable(a, sized_model<2, 3>::size());
        auto const c = without_last_variable(a, sized_model<2, 1>::size());
        auto const e = without_last_variable(a, sized_model<2, 4>::size());
        for (int sample = 0; sample < 8; ++sample) {
            auto const q = support::short_point(d, 3);
            auto const x = support::member<rational>(d, a, q);
            std::vector<double> const head{q[0], q[1]};
            REQUIRE(holds(b, head, x));
            REQUIRE(holds(c, head, x));
            REQUIRE(holds(e, head, x));
        }
    }
}

TEST_CASE("Taylor models: overflow is never a finite radius with a wrong polynomial") {
    using model = sized_model<1, 2>;
    auto const hidden = [](model const& a) { return std::isfinite(a.r()) && !all_finite(a); };
    double const big = 1e155;
    REQUIRE_FALSE(hidden(scaled(model::constant(big), big)));
    REQUIRE_FALSE(hidden(model::variable(0, big, big) * model::variable(0, big, 1)));
    REQUIRE_FALSE(hidden(model::constant(1.7e308) + model::constant(1.7e308)));
    REQUIRE_FALSE(hidden(model::constant(1.7e308) - model::constant(-1.7e308)));
    REQUIRE_FALSE(hidden(scaled(model::constant(big), infinity)));
    REQUIRE_FALSE(hidden(model::constant(infinity)));
    REQUIRE_FALSE(hidden(model::constant(std::nan(""))));

    // The product's range is [0.8e308, 2.8e308]: no bound may exclude its lower end.
    auto const product = scaled(model::variable(0, 1.8e154, 1e154), 1e154);
    for (auto const& values : {rough_range(product), range(product)}) {
        REQUIRE(values.lower() <= 0.8e308);
        REQUIRE(values.upper() == infinity);
    }
}

TEST_CASE("Taylor models: a radius that is not finite stays so, and says nothing") {
    using model = sized_model<2, 2>;
    for (double const r : {infinity, std::nan("")}) {
        auto a = model::variable(0, 1, 0.5);
        a.r() = r;
        for (auto const& b : {model::variable(1, 2, 0.5), model::constant(0.0)}) {
            CAPTURE(r, b.c()[0]);
            REQUIRE_FALSE(std::isfinite((a + b).r()));
            REQUIRE_FALSE(std::isfinite((a - b).r()));
            REQUIRE_FALSE(std::isfinite((a * b).r()));
            REQUIRE_FALSE(std::isfinite((b * a).r()));
        }
        REQUIRE_FALSE(std::isfinite(scaled(a, 0.0).r()));
        REQUIRE_FALSE(std::isfinite(widened(a, 1.0).r()));
        REQUIRE_FALSE(std::isfinite(converted(a, sized_model<2, 1>::size()).r()));
        REQUIRE_FALSE(std::isfinite(without_last_variable(a, sized_model<1, 1>::size()).r()));
        REQUIRE(width(rough_range(a)) == infinity);
        REQUIRE(width(range(a)) == infinity);
    }
}
