// SPDX-License-Identifier: MIT
#include "support/catch.hpp"

#include <sivid/number/polynomial/monomial_space.hpp>

#include <cstddef>
#include <set>
#include <stdexcept>
#include <vector>

using namespace sivid;

namespace {

/// The tables of the space are those of compile time.
template <std::size_t N, std::size_t D>
void check_tables() {
    using fixed = monomials<N, D>;
    auto const& s = monomial_space::of(N, D);
    CAPTURE(N, D);
    REQUIRE(&s == &monomial_space::of(N, D));
    REQUIRE(s.variables() == N);
    REQUIRE(s.degree() == D);
    REQUIRE(s.terms() == fixed::count);
    REQUIRE(s.longest_sum() == fixed::data.longest_sum);
    for (std::size_t i = 0; i < fixed::count; ++i) {
        REQUIRE(s.degree_of(i) == fixed::data.degree[i]);
        for (std::size_t v = 0; v < N; ++v) {
            REQUIRE(s.exponents(i)[v] == fixed::data.exponents[i][v]);
        }
        REQUIRE(s.find([&](std::size_t v) { return s.exponents(i)[v]; }) == i);
    }
    for (std::size_t k = 0; k <= D + 1; ++k) REQUIRE(s.first(k) == fixed::data.first[k]);
    auto const& t = s.products();
    REQUIRE(t.pairs.size() == fixed::products);
    for (std::size_t k = 0; k <= fixed::count; ++k) REQUIRE(t.sum[k] == fixed::data.sum[k]);
    for (std::size_t k = 0; k < fixed::products; ++k) {
        REQUIRE(t.pairs[k].left == fixed::data.pairs[k].left);
        REQUIRE(t.pairs[k].right == fixed::data.pairs[k].right);
    }
    for (std::size_t v = 0; v < N && D > 0; ++v) {
        REQUIRE(fixed::data.exponents[s.variable(v)][v] == 1);
    }
}

/// Sizes for which there is no table at compile time: by what the order means.
void check_order(std::size_t variables, std::size_t degree) {
    auto const& s = monomial_space::of(variables, degree);
    CAPTURE(variables, degree);
    std::set<std::vector<std::size_t>> seen;
    std::size_t longest = 0;
    for (std::size_t i = 0; i < s.terms(); ++i) {
        std::vector<std::size_t> e(s.exponents(i), s.exponents(i) + variables);
        std::size_t sum = 0, pairs = 1;
        for (auto const x : e) {
            sum += x;
            pairs *= x + 1;
        }
        REQUIRE(sum == s.degree_of(i));
        REQUIRE(s.first(sum) <= i);
        REQUIRE(i < s.first(sum + 1));
        REQUIRE(s.find([&](std::size_t v) { return e[v]; }) == i);
        longest = std::max(longest, pairs);
        REQUIRE(seen.insert(e).second);
    }
    REQUIRE(s.longest_sum() == longest);
    REQUIRE(s.terms() == binomial(variables + degree, degree));
    REQUIRE(s.products().pairs.size() == binomial(2 * variables + degree, degree));
}

} // namespace

TEST_CASE("monomial spaces are those of compile time") {
    check_tables<1, 0>();
    check_tables<1, 5>();
    check_tables<2, 1>();
    check_tables<2, 4>();
    check_tables<3, 4>();
    check_tables<4, 3>();
    check_tables<7, 3>();
    check_tables<12, 2>();
}

TEST_CASE("monomial spaces of any size") {
    check_order(24, 2);
    check_order(40, 1);
    check_order(9, 3);
    auto const& none = monomial_space::of(0, 3);
    REQUIRE(none.terms() == 1);
    REQUIRE(none.find([](std::size_t) { return std::size_t{0}; }) == 0);
    REQUIRE(none.products().pairs.size() == 1);
}

TEST_CASE("monomial spaces: a degree that is too high has no place") {
    auto const& s = monomial_space::of(3, 2);
    REQUIRE(s.find([](std::size_t) { return std::size_t{1}; }) == s.terms());
}

TEST_CASE("monomial spaces that are too large are refused") {
    REQUIRE_THROWS_AS(monomial_space::of(200, 5), std::invalid_argument);
    REQUIRE_THROWS_AS(monomial_space::of(1, 256), std::invalid_argument);
    REQUIRE_THROWS_AS(monomial_space::of(100000, 100), std::invalid_argument);
    REQUIRE_THROWS_AS(monomial_space::of(10, 12), std::invalid_argument); // 226 million products
}
