// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_POLYNOMIAL_MONOMIALS_HPP
#define SIVID_NUMBER_POLYNOMIAL_MONOMIALS_HPP

#include <array>
#include <cstddef>
#include <cstdint>

namespace sivid {

/// \f$ \binom{n}{k} \f$
[[nodiscard]] constexpr std::size_t binomial(std::size_t n, std::size_t k) {
    std::size_t result = 1;
    for (std::size_t i = 1; i <= k; ++i) result = result * (n - k + i) / i;
    return result;
}

namespace number_detail {

/// Builds the tables of `monomials`.
template <std::size_t N, std::size_t D>
struct monomial_builder {
    static constexpr std::size_t count = binomial(N + D, D);
    /// Pairs (i, j) whose product has degree at most D.
    static constexpr std::size_t products = binomial(2 * N + D, D);

    struct product {
        std::uint16_t left, right, result;
    };
    struct factors {
        std::uint16_t left, right;
    };
    struct table {
        std::array<std::array<std::uint8_t, N>, count> exponents{};
        std::array<std::uint8_t, count> degree{};
        /// first[k] .. first[k+1]: the monomials of degree k.
        std::array<std::size_t, D + 2> first{};
        /// sum[k] .. sum[k+1] in `pairs`: the products that make up monomial k.
        std::array<std::size_t, count + 1> sum{};
        std::array<factors, products> pairs{};
        /// Most products that add up in one coefficient.
        std::size_t longest_sum = 0;
        /// Index of each variable alone (degree 1); meaningless when D is 0.
        std::array<std::size_t, N> variable{};
    };

    static constexpr table make() {
        table t;
        std::array<std::uint8_t, N> e{};
        std::size_t next = 0;
        for (std::size_t d = 0; d <= D; ++d) {
            t.first[d] = next;
            e = {};
            e[0] = static_cast<std::uint8_t>(d);
            while (true) { // all exponent vectors of degree d, in reverse lexicographic order
                t.exponents[next] = e;
                t.degree[next] = static_cast<std::uint8_t>(d);
                ++next;
                // move one unit to the right
                std::size_t i = N;
                std::uint8_t tail = e[N - 1];
                for (i = N - 1; i-- > 0;) {
                    if (e[i] > 0) break;
                }
                if (N == 1 || i == static_cast<std::size_t>(-1)) break;
                e[N - 1] = 0;
                --e[i];
                e[i + 1] = static_cast<std::uint8_t>(tail + 1);
            }
        }
        t.first[D + 1] = next;
        auto const before = vectors_before();
        std::array<product, products> triples{};
        std::array<std::size_t, count> lengths{};
        std::size_t k = 0;
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t j = 0; j < t.first[D - t.degree[i] + 1]; ++j) {
                auto const m = find(t, before, i, j);
                triples[k++] = {static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(j),
                                static_cast<std::uint16_t>(m)};
                ++lengths[m];
            }
        }
        for (std::size_t m = 0; m < count; ++m) {
            t.sum[m + 1] = t.sum[m] + lengths[m];
            t.longest_sum = lengths[m] > t.longest_sum ? lengths[m] : t.longest_sum;
        }
        auto place = t.sum;
        for (auto const& x : triples) t.pairs[place[x.result]++] = {x.left, x.right};
        if constexpr (D > 0) {
            for (std::size_t i = t.first[1]; i < t.first[2]; ++i) {
                for (std::size_t v = 0; v < N; ++v) {
                    if (t.exponents[i][v] == 1) t.variable[v] = i;
                }
            }
        }
        return t;
    }

private:
    /// [v][rest][e]: of the exponent vectors with a given head, so many with `rest` to share among
    /// v and the variables behind it, and more than e at v. They stand before.
    using ranks = std::array<std::array<std::array<std::size_t, D + 1>, D + 1>, N>;
    static constexpr ranks vectors_before() {
        ranks before{};
        for (std::size_t v = 0; v + 1 < N; ++v) {
            for (std::size_t rest = 0; rest <= D; ++rest) {
                for (std::size_t e = rest; e-- > 0;) {
                    before[v][rest][e] =
                        before[v][rest][e + 1] + binomial(rest - e - 1 + N - v - 2, N - v - 2);
                }
            }
        }
        return before;
    }
    /// Index of the product of monomials i and j: the rank of its exponents within its degree.
    static constexpr std::size_t find(table const& t, ranks const& before, std::size_t i,
                                      std::size_t j) {
        std::size_t rest = static_cast<std::size_t>(t.degree[i]) + t.degree[j];
        std::size_t rank = t.first[rest];
        for (std::size_t v = 0; v + 1 < N; ++v) {
            std::size_t const e = static_cast<std::size_t>(t.exponents[i][v]) + t.exponents[j][v];
            rank += before[v][rest][e];
            rest -= e;
        }
        return rank;
    }
};

} // namespace number_detail

/// The monomials \f$ q^\alpha \f$, \f$ |\alpha| \le D \f$, of N variables in graded order, with
/// their multiplication table; all of it is computed at compile time.
template <std::size_t N, std::size_t D>
struct monomials : number_detail::monomial_builder<N, D> {
    static constexpr auto data = number_detail::monomial_builder<N, D>::make();
};

} // namespace sivid

#endif
