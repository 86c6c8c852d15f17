// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_POLYNOMIAL_MONOMIAL_SPACE_HPP
#define SIVID_NUMBER_POLYNOMIAL_MONOMIAL_SPACE_HPP

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

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

namespace sivid {

/// The monomials \f$ q^\alpha \f$, \f$ |\alpha| \le D \f$, of N variables for any N and D, in the
/// order of `monomials<N, D>`: by degree, then reverse lexicographic. The first variables are those
/// of a space with fewer, so that a polynomial moves to a space with more by copying degree by
/// degree.
/// There is one object for each pair (N, D); it is made when it is first asked for, and stays.
/// @cost  `of`: a lock and a search; `make`: O(terms N)
class monomial_space {
public:
    struct factors {
        std::uint32_t left, right;
    };
    /// The products of two monomials that stay within the degree: [sum[k], sum[k+1]) are those
    /// which make up monomial k.
    struct product_table {
        std::vector<std::size_t> sum;
        std::vector<factors> pairs;
    };
    /// More monomials than that are refused: a product would take seconds.
    static constexpr std::size_t most_terms = 1'000'000;
    /// So are spaces with more products of two of them, of which there is a table.
    static constexpr std::size_t most_products = 50'000'000;

    /// @throws std::invalid_argument where the space has more than `most_terms` monomials or
    ///         `most_products` products, or a degree above 255
    [[nodiscard]] static monomial_space const& of(std::size_t variables, std::size_t degree) {
        static std::mutex guard;
        static std::map<std::pair<std::size_t, std::size_t>, std::unique_ptr<monomial_space>> made;
        std::scoped_lock const lock(guard);
        auto& place = made[{variables, degree}];
        if (!place) place.reset(new monomial_space(variables, degree));
        return *place;
    }

    [[nodiscard]] std::size_t variables() const { return variables_; }
    [[nodiscard]] std::size_t degree() const { return degree_; }
    [[nodiscard]] std::size_t terms() const { return degrees_.size(); }
    /// The exponents of monomial i, one a variable.
    [[nodiscard]] std::uint8_t const* exponents(std::size_t i) const {
        return exponents_.data() + i * variables_;
    }
    [[nodiscard]] std::size_t degree_of(std::size_t i) const { return degrees_[i]; }
    /// first(k) .. first(k + 1): the monomials of degree k; up to k = degree() + 1.
    [[nodiscard]] std::size_t first(std::size_t k) const { return first_[k]; }
    [[nodiscard]] std::size_t const* firsts() const { return first_.data(); }
    /// Where variable v stands alone. @given  degree() >= 1
    [[nodiscard]] std::size_t variable(std::size_t v) const { return 1 + v; }
    /// Most products that add up in one coefficient.
    [[nodiscard]] std::size_t longest_sum() const { return longest_sum_; }
    /// Index of an exponent vector, or terms() where its degree is too high.
    /// @param e  (v) -> exponent
    template <class Exponents>
    [[nodiscard]] std::size_t find(Exponents const& e) const {
        std::size_t rest = 0;
        for (std::size_t v = 0; v < variables_; ++v) rest += e(v);
        if (rest > degree_) return terms();
        std::size_t rank = first_[rest];
        for (std::size_t v = 0; v + 1 < variables_ && rest > 0; ++v) {
            // Those with more of v stand before: so many ways to share what is left of them.
            auto const mine = static_cast<std::size_t>(e(v));
            std::size_t const others = variables_ - v - 1;
            if (rest > mine) rank += ways(others + 1, rest - mine - 1);
            rest -= mine;
        }
        return rank;
    }
    /// Made when it is first asked for. @cost  O(products N)
    [[nodiscard]] product_table const& products() const {
        std::call_once(multiplied_, [this] { multiply(); });
        return products_;
    }

private:
    monomial_space(std::size_t variables, std::size_t degree)
        : variables_(variables), degree_(degree) {
        if (degree > 255)
            throw std::invalid_argument("monomial_space: the degree " + std::to_string(degree) +
                                        " exceeds 255");
        double count = 1, products = 1; // up to rounding
        for (std::size_t k = 1; k <= degree; ++k) {
            count *= static_cast<double>(variables + k) / static_cast<double>(k);
            products *= static_cast<double>(2 * variables + k) / static_cast<double>(k);
        }
        if (!(count <= 1.001 * static_cast<double>(most_terms)) ||
            (degree > 2 && !(products <= 1.001 * static_cast<double>(most_products)))) {
            throw std::invalid_argument("monomial_space: too many monomials of " +
                                        std::to_string(variables) + " variables to degree " +
                                        std::to_string(degree) + "; take a lower degree");
        }
        for (std::size_t n = 0; n <= variables + 1; ++n) {
            std::vector<std::size_t> row;
            for (std::size_t d = 0; d <= degree; ++d) {
                std::size_t const fewer = n == 0 ? 0 : ways_[n - 1][d];
                std::size_t const lower = n == 0 || d == 0 ? 0 : row[d - 1];
                row.push_back(d == 0 ? 1 : std::min(fewer + lower, 2 * most_terms));
            }
            ways_.push_back(std::move(row));
        }
        std::vector<std::uint8_t> e(variables, 0);
        for (std::size_t d = 0; d <= degree; ++d) {
            first_.push_back(degrees_.size());
            if (variables == 0 && d > 0) continue;
            if (variables > 0) {
                std::fill(e.begin(), e.end(), std::uint8_t{0});
                e[0] = static_cast<std::uint8_t>(d);
            }
            while (true) {
                exponents_.insert(exponents_.end(), e.begin(), e.end());
                degrees_.push_back(static_cast<std::uint8_t>(d));
                std::size_t pairs = 1; // that multiply to this monomial
                for (auto const x : e) pairs *= x + std::size_t{1};
                longest_sum_ = std::max(longest_sum_, pairs);
                if (!next(e)) break;
            }
        }
        first_.push_back(degrees_.size());
    }

    /// The next exponent vector of the same degree.
    static bool next(std::vector<std::uint8_t>& e) {
        if (e.size() < 2) return false;
        std::uint8_t const tail = e.back();
        for (std::size_t i = e.size() - 1; i-- > 0;) {
            if (e[i] == 0) continue;
            e.back() = 0;
            --e[i];
            e[i + 1] = static_cast<std::uint8_t>(tail + 1);
            return true;
        }
        return false;
    }
    /// Exponent vectors of n variables with a sum of d.
    [[nodiscard]] std::size_t ways(std::size_t n, std::size_t d) const {
        return n == 0 ? (d == 0 ? 1 : 0) : ways_[n][d];
    }
    void multiply() const {
        auto& t = products_;
        std::vector<std::uint32_t> target;
        std::vector<std::size_t> length(terms(), 0);
        for (std::size_t i = 0; i < terms(); ++i) {
            for (std::size_t j = 0; j < first_[degree_ - degrees_[i] + 1]; ++j) {
                auto const* const a = exponents(i);
                auto const* const b = exponents(j);
                auto const m = find([&](std::size_t v) { return std::size_t{a[v]} + b[v]; });
                target.push_back(static_cast<std::uint32_t>(m));
                ++length[m];
            }
        }
        t.sum.assign(terms() + 1, 0);
        for (std::size_t m = 0; m < terms(); ++m) t.sum[m + 1] = t.sum[m] + length[m];
        t.pairs.resize(target.size());
        auto place = t.sum;
        std::size_t k = 0;
        for (std::size_t i = 0; i < terms(); ++i) {
            for (std::size_t j = 0; j < first_[degree_ - degrees_[i] + 1]; ++j, ++k) {
                t.pairs[place[target[k]]++] = {static_cast<std::uint32_t>(i),
                                               static_cast<std::uint32_t>(j)};
            }
        }
    }

    std::size_t variables_, degree_;
    std::vector<std::uint8_t> exponents_, degrees_;
    std::vector<std::size_t> first_;
    std::size_t longest_sum_ = 1;
    std::vector<std::vector<std::size_t>> ways_; ///< [n][d], of n variables
    mutable std::once_flag multiplied_;
    mutable product_table products_;
};

} // namespace sivid

#endif
