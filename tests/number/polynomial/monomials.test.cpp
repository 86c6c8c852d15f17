// SPDX-License-Identifier: MIT
#include "support/catch.hpp"

#include <sivid/number/polynomial/monomial_space.hpp>

#include <array>
#include <cstddef>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

using sivid::binomial;
using sivid::monomials;

namespace {

template <std::size_t N, std::size_t D>
void check_table() {
    using basis = monomials<N, D>;
    auto const& t = basis::data;
    INFO("N = " << N << ", D = " << D);
    // Every exponent vector of degree at most D once, in graded order.
    std::set<std::array<std::uint8_t, N>> seen;
    for (std::size_t i = 0; i < basis::count; ++i) {
        auto const& e = t.exponents[i];
        auto const degree = std::accumulate(e.begin(), e.end(), std::size_t{0});
        REQUIRE(degree == t.degree[i]);
        REQUIRE(degree <= D);
        REQUIRE(i >= t.first[degree]);
        REQUIRE(i < t.first[degree + 1]);
        seen.insert(e);
    }
    REQUIRE(seen.size() == basis::count);
    REQUIRE(t.first[0] == 0);
    REQUIRE(t.first[D + 1] == basis::count);
    if constexpr (D > 0) {
        for (std::size_t v = 0; v < N; ++v) {
            REQUIRE(t.exponents[1 + v][v] == 1);
        }
    }
    // Every pair of monomials whose product is in the table stands once, under its product.
    std::set<std::pair<std::size_t, std::size_t>> pairs;
    std::size_t longest = 0;
    REQUIRE(t.sum[0] == 0);
    for (std::size_t m = 0; m < basis::count; ++m) {
        longest = std::max(longest, t.sum[m + 1] - t.sum[m]);
        for (std::size_t k = t.sum[m]; k < t.sum[m + 1]; ++k) {
            auto const [a, b] = t.pairs[k];
            for (std::size_t v = 0; v < N; ++v) {
                REQUIRE(t.exponents[a][v] + t.exponents[b][v] == t.exponents[m][v]);
            }
            pairs.insert({a, b});
        }
    }
    REQUIRE(t.sum[basis::count] == basis::products);
    REQUIRE(t.longest_sum == longest);
    std::size_t expected = 0;
    for (std::size_t a = 0; a < basis::count; ++a) {
        for (std::size_t b = 0; b < basis::count; ++b) {
            expected += t.degree[a] + t.degree[b] <= D ? 1 : 0;
        }
    }
    REQUIRE(pairs.size() == expected);
    REQUIRE(basis::products == expected);
}

} // namespace

TEST_CASE("binomial coefficients by Pascal's rule") {
    for (std::size_t n = 1; n < 25; ++n) {
        REQUIRE(binomial(n, 0) == 1);
        REQUIRE(binomial(n, n) == 1);
        for (std::size_t k = 1; k < n; ++k) {
            REQUIRE(binomial(n, k) == binomial(n - 1, k - 1) + binomial(n - 1, k));
        }
    }
    STATIC_REQUIRE(binomial(22, 4) == 7315);
}

TEST_CASE("the tables of monomials and of their products are complete") {
    check_table<1, 0>();
    check_table<1, 1>();
    check_table<1, 6>();
    check_table<2, 3>();
    check_table<2, 4>();
    check_table<3, 4>();
    check_table<4, 3>();
    check_table<6, 2>();
    check_table<10, 2>();
}
