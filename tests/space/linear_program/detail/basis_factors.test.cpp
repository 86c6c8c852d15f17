// SPDX-License-Identifier: MIT
#include <sivid/space/linear_program/detail/basis_factors.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

using namespace sivid;
using support::draws;

namespace {

using vector = std::vector<double>;

vector random_vector(draws& d, std::size_t n) {
    vector v(n);
    for (auto& x : v) x = d.uniform(-1, 1);
    return v;
}
/// Largest entry of B x - b, or of its transpose.
double residual(vector const& m, vector const& x, vector const& b, bool transposed) {
    auto const n = b.size();
    double worst = 0;
    for (std::size_t i = 0; i < n; ++i) {
        double sum = -b[i];
        for (std::size_t j = 0; j < n; ++j)
            sum += (transposed ? m[j * n + i] : m[i * n + j]) * x[j];
        worst = std::max(worst, std::abs(sum));
    }
    return worst;
}

} // namespace

TEST_CASE("a basis solves for both sides, also after columns were replaced") {
    draws d(11);
    std::size_t replaced = 0;
    for (int trial = 0; trial < 200; ++trial) {
        std::size_t const n = 1 + d.below(12);
        auto m = random_vector(d, n * n);
        for (std::size_t i = 0; i < n; ++i) m[i * n + (i + 1) % n] += 3; // well-conditioned
        basis_factors f;
        REQUIRE(f.factorise(m, n));
        for (int change = 0; change < 6; ++change) {
            auto const b = random_vector(d, n);
            auto x = b;
            f.solve(x);
            CHECK(residual(m, x, b, false) < 1e-9);
            x = b;
            f.solve_transposed(x);
            CHECK(residual(m, x, b, true) < 1e-9);
            auto const k = d.below(n);
            auto column = random_vector(d, n);
            column[(k + n - 1) % n] += 3;
            auto solved = column;
            f.solve(solved);
            if (!f.replace(k, solved)) continue;
            ++replaced;
            for (std::size_t i = 0; i < n; ++i) m[i * n + k] = column[i];
        }
    }
    CHECK(replaced > 600);
}

TEST_CASE("columns replaced with small pivots cost digits, not the solution") {
    draws d(12);
    std::size_t small = 0;
    for (int trial = 0; trial < 100; ++trial) {
        std::size_t const n = 8;
        vector m(n * n, 0.0);
        for (std::size_t i = 0; i < n; ++i) m[i * n + i] = 1;
        basis_factors f;
        REQUIRE(f.factorise(m, n));
        for (std::size_t change = 0; change < 4; ++change) {
            auto const k = d.below(n);
            auto column = random_vector(d, n);
            column[k] *= 1e-4;
            auto solved = column;
            f.solve(solved);
            if (!f.replace(k, solved)) continue;
            ++small;
            for (std::size_t i = 0; i < n; ++i) m[i * n + k] = column[i];
        }
        auto const b = random_vector(d, n);
        for (bool const transposed : {false, true}) {
            auto x = b;
            transposed ? f.solve_transposed(x) : f.solve(x);
            double largest = 1;
            for (double const v : x) largest = std::max(largest, std::abs(v));
            CHECK(residual(m, x, b, transposed) < 1e-9 * largest);
        }
    }
    CHECK(small > 200);
}

TEST_CASE("what cannot be factorised is told") {
    basis_factors f;
    CHECK_FALSE(f.factorise({1, 2, 2, 4}, 2));
    CHECK_FALSE(f.factorise({0}, 1));
    CHECK_FALSE(f.factorise({std::numeric_limits<double>::quiet_NaN(), 1, 1, 1}, 2));
    CHECK(f.factorise({}, 0));
    REQUIRE(f.factorise({1, 0, 0, 1}, 2));
    CHECK_FALSE(f.replace(0, {1e-9, 1}));
    CHECK_FALSE(f.replace(0, {std::numeric_limits<double>::quiet_NaN(), 1}));
}
