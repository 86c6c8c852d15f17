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
        // Exponents as digits of one number: products within the degree are sums without carries.
        std::array<std::uint64_t, count> codes{};
        for (std::size_t i = 0; i < count; ++i) {
            for (auto const digit : t.exponents[i]) codes[i] = codes[i] * (D + 1) + digit;
        }
        auto const* const code = codes.data(); // fewer steps of the compiler
        std::size_t k = 0;
        for (std::size_t m = 0; m < count; ++m) {
            for (std::size_t i = 0; i < t.first[t.degree[m] + 1]; ++i) {
                std::uint64_t const wanted = code[m] - code[i];
                std::size_t const rest = static_cast<std::size_t>(t.degree[m]) - t.degree[i];
                std::size_t j = t.first[rest];
                std::size_t const last = t.first[rest + 1];
                while (j < last && code[j] != wanted) ++j;
                if (j < last)
                    t.pairs[k++] = {static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(j)};
            }
            t.sum[m + 1] = k;
            std::size_t const length = k - t.sum[m];
            t.longest_sum = length > t.longest_sum ? length : t.longest_sum;
        }
        return t;
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
