// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/relation/time_grid.hpp>

#include "support/catch.hpp"

using namespace sivid;

TEST_CASE("times are refined and each of them stays") {
    auto const grid = refined_times({0.5, 0.0, 0.1, 0.1}, 0.1);
    for (double const t : {0.0, 0.1, 0.5}) {
        CHECK(std::find(grid.begin(), grid.end(), t) != grid.end());
    }
    for (std::size_t k = 0; k + 1 < grid.size(); ++k) {
        CHECK(grid[k] < grid[k + 1]);
        CHECK(grid[k + 1] - grid[k] < 0.1001);
    }
    CHECK(refined_times({2.0}, 1) == std::vector<double>{2.0});
}
