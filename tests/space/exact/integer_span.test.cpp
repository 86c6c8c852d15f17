// SPDX-License-Identifier: MIT
#include <sivid/space/exact/integer_span.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <climits>
#include <cstddef>
#include <cstdint>
#include <vector>

using namespace sivid;
using support::draws;
using rows = std::vector<std::vector<int>>;

namespace {

/// Gauss's elimination in fractions.
std::size_t exact_rank(rows const& list) {
    using fraction = boost::multiprecision::cpp_rational;
    std::vector<std::vector<fraction>> m;
    for (auto const& r : list) m.emplace_back(r.begin(), r.end());
    std::size_t rank = 0;
    for (std::size_t j = 0; !m.empty() && j < m[0].size() && rank < m.size(); ++j) {
        auto const at = std::find_if(m.begin() + static_cast<std::ptrdiff_t>(rank), m.end(),
                                     [j](auto const& r) { return r[j] != 0; });
        if (at == m.end()) continue;
        std::swap(*at, m[rank]);
        for (std::size_t i = rank + 1; i < m.size(); ++i) {
            fraction const factor = m[i][j] / m[rank][j];
            for (std::size_t k = j; k < m[i].size(); ++k) m[i][k] -= factor * m[rank][k];
        }
        ++rank;
    }
    return rank;
}
std::size_t rank_of(rows const& list, std::size_t columns) {
    integer_span span(columns);
    for (auto const& r : list) span.add(r);
    return span.rank();
}

} // namespace

TEST_CASE("ranks are those of elimination in fractions") {
    draws d(81);
    std::size_t deficient = 0;
    for (int trial = 0; trial < 400; ++trial) {
        std::size_t const n = 1 + d.below(7), count = 1 + d.below(9);
        int const size = d.coin() ? 2 : d.coin() ? 30 : 2000000000;
        rows list(count, std::vector<int>(n));
        for (auto& r : list) {
            for (auto& v : r) {
                auto const drawn = d.below(2 * static_cast<std::size_t>(size) + 1);
                v = static_cast<int>(static_cast<std::int64_t>(drawn) - size);
            }
        }
        if (size <= 30 && count > 2 && d.coin()) { // a row that depends on two others
            for (std::size_t j = 0; j < n; ++j) list[2][j] = 7 * list[0][j] - 3 * list[1][j];
        }
        auto const exact = exact_rank(list);
        deficient += exact < std::min(n, count) ? 1 : 0;
        CHECK(rank_of(list, n) == exact);
    }
    CHECK(deficient > 30);
}

TEST_CASE("determinants that are large, small, and divisible by the first primes") {
    CHECK(rank_of({{100000000, 100000001}, {99999999, 100000000}}, 2) == 2); // determinant 1
    constexpr int first = 2147483647, second = 2147483629;
    CHECK(rank_of({{first, 0}, {0, second}}, 2) == 2);
    CHECK(rank_of({{first, second}, {first, second}}, 2) == 1);
    CHECK(rank_of({{first, 0, 0}, {0, first, 0}, {first, first, 0}, {0, 0, second}}, 3) == 3);
    CHECK(rank_of({{INT_MIN, INT_MAX}, {INT_MAX, INT_MIN}}, 2) == 2);
    constexpr std::size_t n = 40;
    rows chain(n, std::vector<int>(n, 0));
    for (std::size_t i = 0; i < n; ++i) {
        chain[i][i] = 1;
        if (i + 1 < n) chain[i][i + 1] = 9;
    }
    CHECK(rank_of(chain, n) == n);
    integer_span span(n);
    for (std::size_t i = 0; i + 1 < n; ++i) CHECK(span.add(chain[i]));
    CHECK_FALSE(span.contains(chain[n - 1]));
    auto sum = chain[0];
    for (std::size_t j = 0; j < n; ++j) sum[j] -= 5 * chain[7][j];
    CHECK(span.contains(sum));
    CHECK_FALSE(span.add(sum));
    CHECK(span.rank() == n - 1);
}

TEST_CASE("nothing spans the zero row alone, and lengths have to agree") {
    integer_span const none(2);
    CHECK(none.contains({0, 0}));
    CHECK_FALSE(none.contains({0, 1}));
    CHECK(integer_span(0).contains({}));
    CHECK_THROWS_AS(none.contains({1}), std::invalid_argument);
}
