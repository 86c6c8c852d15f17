// SPDX-License-Identifier: MIT
#ifndef SIVID_SPACE_EXACT_INTEGER_SPAN_HPP
#define SIVID_SPACE_EXACT_INTEGER_SPAN_HPP

#include <sivid/number/text/needed_given.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sivid {

/// The space that rows of integers span over the rationals.
///   Rows are eliminated modulo primes below \f$ 2^{31} \f$. A minor that is not zero modulo one of
///   them is not zero; and one that is zero modulo primes whose product exceeds the product of its
///   rows' lengths is zero, since it is no larger than that (Hadamard).
/// @guarantee  exact, whatever the rows
/// @cost  O(rank columns) for each prime and question; about one prime for 31 bits of that bound,
///   one alone where the row is found to be independent
class integer_span {
public:
    explicit integer_span(std::size_t columns) : columns_(columns) {}

    [[nodiscard]] std::size_t rank() const { return rows_.size(); }

    /// Takes a row in unless it lies in the span already.
    /// @returns whether it did not
    /// @throws std::invalid_argument for a row of another length
    bool add(std::vector<int> const& row) {
        if (contains(row)) return false;
        rows_.push_back(row);
        bits_ += bits_of(row);
        for (auto& m : moduli_) take(m, row);
        return true;
    }
    /// Whether a row is a sum of those taken in, with rational factors.
    [[nodiscard]] bool contains(std::vector<int> const& row) const {
        if (row.size() != columns_)
            throw std::invalid_argument("integer_span: a row of another length" +
                                        needed_given(columns_, row.size()));
        if (std::all_of(row.begin(), row.end(), [](int v) { return v == 0; })) return true;
        double known = 0; // bits of the primes by which every minor can be divided
        double const enough = bits_ + bits_of(row) + 1;
        for (std::size_t k = 0; known <= enough; ++k) {
            if (k == moduli_.size()) add_modulus();
            auto const& m = moduli_[k];
            known += 30.9;
            if (!m.independent) continue;
            auto const rest = reduced(m, row);
            if (std::any_of(rest.begin(), rest.end(), [](auto v) { return v != 0; })) return false;
        }
        return true;
    }

private:
    using number = std::uint64_t;
    struct echelon_row {
        std::size_t pivot;
        std::vector<number> entries; ///< 1 at the pivot
    };
    /// What is left of the rows modulo a prime.
    struct modulus {
        number prime;
        bool independent = true; ///< the rows are, modulo the prime
        std::vector<echelon_row> rows{};
    };

    /// More than the length of a row, as a power of two.
    static double bits_of(std::vector<int> const& row) {
        double square = 0;
        for (int const v : row) square += static_cast<double>(v) * v;
        return 0.5 * std::log2(square) + 1e-6;
    }
    static bool is_prime(number n) {
        for (number k = 3; k * k <= n; k += 2) {
            if (n % k == 0) return false;
        }
        return n % 2 == 1;
    }
    void add_modulus() const {
        number p = moduli_.empty() ? (number{1} << 31) - 1 : moduli_.back().prime - 2;
        while (!is_prime(p)) p -= 2;
        modulus m{p};
        for (auto const& row : rows_) take(m, row);
        moduli_.push_back(std::move(m));
    }
    static number power(number base, number exponent, number p) {
        number result = 1;
        for (; exponent > 0; exponent /= 2, base = base * base % p) {
            if (exponent % 2 == 1) result = result * base % p;
        }
        return result;
    }
    /// The row without what the rows before it explain.
    static std::vector<number> reduced(modulus const& m, std::vector<int> const& row) {
        auto const p = m.prime;
        std::vector<number> rest;
        for (int const v : row) {
            auto const size = static_cast<number>(std::abs(std::int64_t{v})) % p;
            rest.push_back(v < 0 && size > 0 ? p - size : size);
        }
        for (auto const& [pivot, entries] : m.rows) {
            number const factor = rest[pivot];
            if (factor == 0) continue;
            for (std::size_t j = 0; j < rest.size(); ++j) {
                rest[j] = (rest[j] + (p - factor) * entries[j]) % p;
            }
        }
        return rest;
    }
    static void take(modulus& m, std::vector<int> const& row) {
        if (!m.independent) return;
        auto rest = reduced(m, row);
        auto const at = std::find_if(rest.begin(), rest.end(), [](number v) { return v != 0; });
        if (at == rest.end()) {
            m.independent = false;
            return;
        }
        auto const pivot = static_cast<std::size_t>(at - rest.begin());
        number const inverse = power(rest[pivot], m.prime - 2, m.prime);
        for (auto& v : rest) v = v * inverse % m.prime;
        m.rows.push_back({pivot, std::move(rest)});
    }

    std::size_t columns_;
    std::vector<std::vector<int>> rows_; ///< independent
    double bits_ = 0;                    ///< of the product of their lengths
    mutable std::vector<modulus> moduli_;
};

} // namespace sivid

#endif
