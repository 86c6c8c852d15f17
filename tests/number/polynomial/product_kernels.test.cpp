// SPDX-License-Identifier: MIT
// The product kernels against each other, and models of any size.
#include "support/catch.hpp"
#include "support/taylor_models.hpp"

#include <sivid/number/pack/lanes.hpp>
#include <sivid/number/polynomial/detail/bernstein.hpp>
#include <sivid/number/polynomial/taylor_model_functions.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

using namespace sivid;
using support::draws;

namespace {

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
            auto const a = support::random_model(d, shape, 1, 0.5, 0.1);
            auto const b = support::random_model(d, shape, 1, 0.5, 0.1);
            auto const product = a * b;
            for (int sample = 0; sample < 3; ++sample) {
                auto const q = support::short_point(d, shape.variables);
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
    taylor_models<double> places(3, shape);
    auto const a = support::random_model(d, shape, 1, 1, 0.1);
    auto const b = support::random_model(d, shape, 1, 1, 0.1);
    REQUIRE(places[1].is_number());
    places[0] = a;
    places[1] = b;
    auto copy = places[0];
    places[0] = std::move(places[1]);
    places[1] = taylor_model<double>::constant(2.0);
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
    auto const large = taylor_model<double>::variable(model_shape<double>::of(4, 4), 0, 0, 1);
    REQUIRE_THROWS_AS(moved[2] = large, std::logic_error);
    REQUIRE_THROWS_AS(a + large, std::logic_error);
    REQUIRE_THROWS_AS(a * large, std::logic_error);
    REQUIRE_THROWS_AS(converted(large, shape), std::logic_error);
}
