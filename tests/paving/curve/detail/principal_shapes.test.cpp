// SPDX-License-Identifier: MIT
#include <sivid/paving/curve/detail/principal_shapes.hpp>

#include "support/catch.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

using namespace sivid::paving_detail;

namespace {

double value_of(std::vector<double> const& powers, double x) {
    double sum = 0;
    for (std::size_t k = powers.size(); k-- > 0;) sum = sum * x + powers[k];
    return sum;
}

} // namespace

TEST_CASE("values at Chebyshev's nodes give the polynomial through them") {
    std::vector<double> values;
    for (double const x : chebyshev_nodes(14)) values.push_back(std::sin(x) + 0.5);
    auto const powers = by_powers(chebyshev_coefficients(values), 13);
    for (double const x : {-1.0, -0.3, 0.0, 0.77, 1.0}) {
        CHECK(std::abs(value_of(powers, x) - std::sin(x) - 0.5) < 1e-12);
    }
    // What is nothing beside the rest is left out: a sine has no even powers.
    values.clear();
    for (double const x : chebyshev_nodes(14)) values.push_back(std::sin(x));
    auto const odd = by_powers(chebyshev_coefficients(values), 13);
    for (std::size_t k = 0; k < odd.size(); k += 2) CHECK(odd[k] == 0);
}

TEST_CASE("a sum of powers is the same in whole and in half steps") {
    for (auto const& c : {std::vector<double>{1, 2, 3},
                          {0, 2, 0, 3},
                          {1, 0, 3, 0},
                          {4},
                          {0, 5},
                          {0},
                          {0, 0, 0},
                          {1, 0}}) {
        for (double const x : {-2.0, 0.0, 0.5}) {
            double const sum = horner(
                c, [&c](std::size_t k) { return c[k] == 0; }, x);
            CHECK(sum == value_of(c, x));
        }
    }
}
