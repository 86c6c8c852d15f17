// SPDX-License-Identifier: MIT
#include <sivid/paving/relation/time_grid.hpp>

#include "support/catch.hpp"

#include <cmath>
#include <set>

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

TEST_CASE("windows are of many lengths, up to all, and few") {
    CHECK(sivid::spread_windows(0).empty());
    CHECK(sivid::spread_windows(1).empty());
    CHECK(sivid::spread_windows(2) == std::vector<std::pair<std::size_t, std::size_t>>{{0, 1}});
    for (auto const n : {3u, 10u, 100u, 5000u, 100000u}) {
        auto const all = sivid::spread_windows(n);
        CHECK(all.back() == std::pair<std::size_t, std::size_t>{0, n - 1});
        CHECK(all.size() <= 130 * 30);
        std::set<std::size_t> lengths;
        for (auto const& [a, b] : all) {
            CHECK(a < b);
            CHECK(b < n);
            lengths.insert(b - a);
        }
        CHECK(lengths.count(1) == 1);
        CHECK(std::exp2(lengths.size() + 1) >= n);
    }
}
