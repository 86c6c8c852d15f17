// SPDX-License-Identifier: MIT
// Parameters were called entangled, and motions symmetries, because a rank was counted in doubles
// and exponents wrapped around at 2^32: theorems that are wrong.
#include <sivid/model/structure/find_combinations.hpp>
#include <sivid/model/structure/homogeneity.hpp>
#include <sivid/model/structure/symmetry.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"

#include <cstddef>
#include <vector>

using namespace sivid;

namespace {

template <class Rate>
bound_model bound(std::size_t constants, Rate const& rate) {
    return bind(support::model_of({1, constants}, rate), {support::all_constants(constants), {}},
                {});
}

/// p^(2^32), by squaring.
template <class T>
T large_power(T p) {
    for (int k = 0; k < 32; ++k) p = sqr(p);
    return p;
}

} // namespace

TEST_CASE("products whose exponents depend on each other nearly determine all parameters") {
    // The exponents are 1 on the diagonal and 9 beside it: determinant 1, least singular value
    // about 9^-15.
    constexpr std::size_t n = 16;
    auto const model = bound(n, [](auto const&, auto const& x, auto const& p, auto const&) {
        auto rate = p[n - 1] * x[0];
        for (std::size_t j = 0; j + 1 < n; ++j) rate = rate + p[j] * pown(p[j + 1], 9) * sin(x[0]);
        return std::vector{rate};
    });
    auto const found = find_combinations({&model});
    CHECK(found.entangled.empty());
    CHECK(found.combinations.empty());
}

TEST_CASE("a product that closes the chain is known to depend on the others") {
    constexpr std::size_t n = 16;
    auto const model = bound(n, [](auto const&, auto const& x, auto const& p, auto const&) {
        auto rate = x[0];
        for (std::size_t j = 0; j + 1 < n; ++j) rate = rate + p[j] * pown(p[j + 1], 9) * sin(x[0]);
        return std::vector{rate};
    });
    auto const found = find_combinations({&model});
    CHECK(found.entangled.size() == n);
    CHECK(found.combinations.size() == n - 1);
}

TEST_CASE("a parameter to the power of 2^32 is not absent") {
    auto const model = bound(2, [](auto const&, auto const& x, auto const& p, auto const&) {
        return std::vector{large_power(p[0]) * x[0] + p[1] * x[0]};
    });
    CHECK(find_combinations({&model}).entangled.empty());
    CHECK_FALSE(is_symmetry(model, {motion_kind::scaling, {1, 0}, {0}}));
    CHECK_FALSE(is_scale_invariant(model, {1, 0}));
    auto const both = bound(2, [](auto const&, auto const& x, auto const& p, auto const&) {
        return std::vector{large_power(p[0]) * p[1] * x[0]};
    });
    CHECK_FALSE(is_symmetry(both, {motion_kind::scaling, {1, 0}, {0}}));
}
