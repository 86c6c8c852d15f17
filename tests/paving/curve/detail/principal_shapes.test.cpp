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

TEST_CASE("principal directions tell small differences beside large ones") {
    std::vector<double> const first{0.6, 0.8, 0}, second{-0.8, 0.6, 0}, third{0, 0, 1};
    std::vector<std::vector<double>> rows;
    for (int k = 0; k < 20; ++k) {
        double const a = std::cos(0.7 * k) * 1e3, b = std::sin(1.3 * k),
                     c = 1e-7 * std::cos(2.1 * k);
        std::vector<double> row;
        for (std::size_t i = 0; i < 3; ++i)
            row.push_back(a * first[i] + b * second[i] + c * third[i]);
        rows.push_back(row);
    }
    principal_directions const found(rows);
    REQUIRE(found.size.size() == 3);
    CHECK(found.size[0] > 1e3);
    CHECK(found.size[1] < 10);
    CHECK((found.size[2] > 1e-8 && found.size[2] < 1e-6));
    auto const along = [](std::vector<double> const& a, std::vector<double> const& b) {
        return std::abs(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
    };
    CHECK(along(found.direction[0], first) > 1 - 1e-5);
    CHECK(along(found.direction[1], second) > 1 - 1e-5);
    CHECK(along(found.direction[2], third) > 1 - 1e-9);
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
