// SPDX-License-Identifier: MIT
// Sizes at run time against sizes at compile time, and the product kernels against each other.
#include "support/catch.hpp"
#include "support/sized_models.hpp"

#include <sivid/number/bernstein.hpp>
#include <sivid/number/lanes.hpp>
#include <sivid/number/sized_bernstein.hpp>
#include <sivid/number/sized_model_functions.hpp>
#include <sivid/number/taylor_model_functions.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

using namespace sivid;
using support::draws;

namespace {

template <std::size_t N, std::size_t D, class C>
struct both {
    taylor_model<N, D, C> fixed;
    sized_model<C> sized{model_shape<C>::of(N, D)};

    both(draws& d, double centre) {
        using side_by_side = lane_traits<C>;
        for (std::size_t i = 0; i < fixed.terms; ++i) {
            double const s = std::pow(0.6, monomials<N, D>::data.degree[i]);
            for (std::size_t l = 0; l < side_by_side::count; ++l) {
                double const x = i == 0 ? centre + d.uniform(-1, 1) : d.uniform(-0.1, 0.1) * s;
                side_by_side::put(fixed.c[i], l, x);
                side_by_side::put(sized.c(i), l, x);
            }
        }
        fixed.r = sized.r() = d.coin() ? 0 : d.uniform(0, 0.1);
        fixed.finish();
        sized.finish();
    }
};

/// Coefficients up to roundings that depend on what is fused, radii and norms up to a few units.
template <std::size_t N, std::size_t D, class C>
bool same(taylor_model<N, D, C> const& a, sized_model<C> const& number_or_model) {
    using side_by_side = lane_traits<C>;
    auto const b = in_shape(number_or_model, model_shape<C>::of(N, D));
    bool equal = true;
    for (std::size_t l = 0; l < side_by_side::count; ++l) {
        auto const get = [l](C const& x) { return side_by_side::get(x, l); };
        double const size = get(a.polynomial_norm());
        auto const near = [](double x, double y, double room) {
            return std::abs(x - y) <= room || (!std::isfinite(x) && !std::isfinite(y));
        };
        for (std::size_t i = 0; i < a.terms; ++i) {
            equal = equal && near(get(a.c[i]), get(b.c(i)), 1e-14 * size);
        }
        equal = equal && near(get(a.r), get(b.r()), 1e-10 * get(a.r) + 1e-13 * size);
        equal = equal && near(size, get(b.polynomial_norm()), 1e-12 * size);
    }
    return equal;
}

template <std::size_t N, std::size_t D, class C>
void check_same(std::uint64_t seed, int trials) {
    using fixed = taylor_model<N, D, C>;
    using sized = sized_model<C>;
    using mask = typename lane_traits<C>::mask;
    draws d(seed);
    for (int trial = 0; trial < trials; ++trial) {
        both<N, D, C> const a(d, 3), b(d, -2);
        C const m = d.uniform(-2, 2);
        CAPTURE(N, D, lane_traits<C>::count, trial);
        REQUIRE(same(a.fixed + b.fixed, a.sized + b.sized));
        REQUIRE(same(a.fixed - b.fixed, a.sized - b.sized));
        REQUIRE(same(-a.fixed, -a.sized));
        REQUIRE(same(a.fixed * b.fixed, a.sized * b.sized));
        REQUIRE(same(scaled(a.fixed, m, C(0.1)), scaled(a.sized, m, C(0.1))));
        REQUIRE(same(widened(a.fixed, m * m), widened(a.sized, m * m)));
        // Numbers, whose size is another.
        REQUIRE(same(a.fixed + fixed::constant(m), a.sized + sized::constant(m)));
        REQUIRE(same(fixed::constant(m) - a.fixed, sized::constant(m) - a.sized));
        REQUIRE(same(fixed::constant(m) * a.fixed, sized::constant(m) * a.sized));
        product_sum<N, D, C> sum;
        sized_sum<C> other;
        for (double const factor : {1.0, -3.0}) {
            sum.add(fixed::constant(m), factor);
            other.add(sized::constant(m), factor);
            sum.add(a.fixed, b.fixed, factor);
            other.add(a.sized, b.sized, factor);
            sum.add(b.fixed);
            other.add(b.sized);
        }
        REQUIRE(same(sum.result(), other.result()));
        mask one{}, two{};
        REQUIRE(same(reciprocal(a.fixed, one), reciprocal(a.sized, two)));
        REQUIRE(same(sqrt(a.fixed, one), sqrt(a.sized, two)));
        for (auto const f : {univariate::exp, univariate::log, univariate::sin, univariate::cos,
                             univariate::atan, univariate::tanh}) {
            REQUIRE(same(apply(f, a.fixed, one), apply(f, a.sized, two)));
        }
        (void)sqrt(b.fixed, one);
        (void)sqrt(b.sized, two);
        REQUIRE(one == two);
        auto const x = bounds(a.fixed), y = bounds(a.sized);
        for (std::size_t l = 0; l < lane_traits<C>::count; ++l) {
            auto const get = [l](C const& v) { return lane_traits<C>::get(v, l); };
            REQUIRE(std::abs(get(x.lower) - get(y.lower)) <= 1e-12);
            REQUIRE(std::abs(get(x.upper) - get(y.upper)) <= 1e-12);
            REQUIRE(same(lane_of(a.fixed, l), lane_of(a.sized, l)));
        }
    }
}

/// All kernels that fit a size, on the same numbers.
template <std::size_t N, std::size_t D>
void check_kernels(std::uint64_t seed) {
    using namespace product_detail;
    auto const& space = monomial_space::of(N, D);
    draws d(seed);
    std::vector<double> a(space.terms()), b(space.terms());
    for (std::size_t i = 0; i < space.terms(); ++i) {
        a[i] = std::ldexp(static_cast<double>(d.below(1000)), -5); // products are exact
        b[i] = std::ldexp(static_cast<double>(d.below(1000)), -5);
    }
    auto const product = [&]<class Kernel>() {
        std::vector<double> sum(space.terms(), 1.0);
        accumulate_product<Kernel>(space, sum.data(), a.data(), b.data(), -3);
        return sum;
    };
    auto const by_table = product.template operator()<tabled_product>();
    REQUIRE(product.template operator()<unrolled_product<N, D>>() == by_table);
    if constexpr (D <= 2) REQUIRE(product.template operator()<low_degree_product<D>>() == by_table);
    std::vector<double> sum(space.terms(), 1.0);
    model_shape<double>::of(N, D).multiply(space, sum.data(), a.data(), b.data(), -3);
    REQUIRE(sum == by_table);
}

} // namespace

TEST_CASE("sizes at run time compute what sizes at compile time do") {
    check_same<1, 3, double>(1, 20);
    check_same<2, 4, double>(2, 20);
    check_same<3, 2, double>(3, 20);
    check_same<6, 2, double>(4, 10);
    check_same<5, 1, double>(5, 10);
    check_same<2, 5, double>(6, 10); // by the table
    check_same<3, 4, lanes<8>>(7, 5);
    check_same<9, 2, lanes<8>>(8, 3);
    check_same<3, 2, lanes<8>>(9, 5);
}

TEST_CASE("product kernels agree") {
    check_kernels<1, 0>(1);
    check_kernels<4, 1>(2);
    check_kernels<3, 2>(3);
    check_kernels<9, 2>(4);
    check_kernels<2, 4>(5);
    check_kernels<3, 4>(6);
    check_kernels<4, 3>(7);
}

TEST_CASE("products of many variables contain all products of members") {
    draws d(11);
    using size = std::pair<std::size_t, std::size_t>;
    for (auto const& [n, degree] : {size{24, 2}, size{30, 1}, size{10, 3}}) {
        auto const& shape = model_shape<double>::of(n, degree);
        for (int trial = 0; trial < 3; ++trial) {
            auto const a = support::random_sized(d, shape, 1, 0.5, 0.1);
            auto const b = support::random_sized(d, shape, 1, 0.5, 0.1);
            auto const product = a * b;
            for (int sample = 0; sample < 3; ++sample) {
                auto const q = support::short_place(d, shape.variables);
                auto const x = support::member<support::mp>(d, a, q);
                auto const y = support::member<support::mp>(d, b, q);
                REQUIRE(support::holds(product, q, support::mp(x * y), 1e-40));
                REQUIRE(support::mp(range(product).lower()) <= x * y);
                REQUIRE(support::mp(range(product).upper()) >= x * y);
            }
        }
    }
}

TEST_CASE("models that borrow their memory are copied, not shared") {
    auto const& shape = model_shape<double>::of(2, 3);
    draws d(12);
    sized_models<double> places(3, shape);
    auto const a = support::random_sized(d, shape, 1, 1, 0.1);
    auto const b = support::random_sized(d, shape, 1, 1, 0.1);
    REQUIRE(places[1].is_number());
    places[0] = a;
    places[1] = b;
    auto copy = places[0];
    places[0] = std::move(places[1]);
    places[1] = sized_model<double>::constant(2.0);
    REQUIRE(copy.c(3) == a.c(3));
    REQUIRE(places[0].c(3) == b.c(3));
    REQUIRE(places[1].c(0) == 2);
    copy = std::move(places[0]);
    REQUIRE(copy.c(3) == b.c(3));
    REQUIRE(places[0].c(3) == b.c(3));
    auto moved = std::move(places); // the memory stays where it is
    REQUIRE(moved[0].c(3) == b.c(3));
    moved[2] = a;
    REQUIRE(moved[2].r() == a.r());
    auto const large = sized_model<double>::variable(model_shape<double>::of(4, 4), 0, 0, 1);
    REQUIRE_THROWS_AS(moved[2] = large, std::logic_error);
    REQUIRE_THROWS_AS(a + large, std::logic_error);
    REQUIRE_THROWS_AS(a * large, std::logic_error);
    REQUIRE_THROWS_AS(converted(large, shape), std::logic_error);
}
