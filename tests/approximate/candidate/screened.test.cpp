// SPDX-License-Identifier: MIT
#include <sivid/approximate/candidate/screened.hpp>

#include "support/catch.hpp"

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

using namespace sivid;

TEST_CASE("fits are alike where every residual is, and never where one is no number") {
    std::vector<std::vector<double>> const a{{0.1, 0.2}, {0.3}};
    auto b = a;
    CHECK(alike(a, b));
    b[1][0] += 1e-6;
    CHECK(alike(a, b));
    CHECK_FALSE(alike(a, b, 1e-7));
    b[1][0] = std::numeric_limits<double>::quiet_NaN();
    CHECK_FALSE(alike(a, b));
    CHECK_FALSE(alike(a, {{0.1, 0.2}}));
}

TEST_CASE("partners are single effects that act everywhere, the closest first") {
    std::vector<effect> catalogue(4);
    catalogue[2].only_in = {"S1"};
    std::vector<screened> candidates(5);
    double const inflation[]{3, 1, 0.5, 2, 0.1};
    std::vector<std::size_t> const of[]{{0}, {1}, {2}, {3}, {0, 1}};
    for (std::size_t k = 0; k < 5; ++k) {
        candidates[k].figures.effects = of[k];
        candidates[k].fit.inflation = inflation[k];
    }
    CHECK(closest_singles(candidates, catalogue, 10) == std::vector<std::size_t>{1, 3, 0});
    CHECK(closest_singles(candidates, catalogue, 2) == std::vector<std::size_t>{1, 3});
}
