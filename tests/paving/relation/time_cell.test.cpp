// SPDX-License-Identifier: MIT
#include <sivid/paving/relation/time_cell.hpp>

#include "diagnosis/planted_motion.hpp"
#include "support/catch.hpp"
#include <cmath>
#include <set>

using namespace diagnosis_support;

TEST_CASE("a line holds what it was made from") {
    draws d(60);
    for (int n = 0; n < 200; ++n) {
        double const start = d.uniform(-1e3, 1e3), end = d.uniform(-1, 1);
        auto const line = cell_line::of(start, end, between(-0.1, 0.2), 0.3);
        // The line's middle lies within the centre and the spread, whatever the rounding.
        auto const off = (static_cast<long double>(start) + end) / 2 - line.centre;
        CHECK(line.spread.lower() <= off - 0.1L + 1e-15L);
        CHECK(off + 0.2L - 1e-15L <= line.spread.upper());
        CHECK(width(line.spread) <= 0.3001);
        CHECK(line.drift >= std::abs(end - start) * (1 - 1e-15));
        CHECK(line.departure == 0.3);
    }
}

TEST_CASE("without a drift the range is centre and spread") {
    auto const still = cell_line::still(between(1, 3));
    CHECK(still.centre == 2);
    CHECK(still.drift == 0);
    CHECK(still.departure == 0);
    CHECK(equal(still.spread, between(-1, 1)));
    CHECK(is_entire(cell_line::still(interval_traits<interval>::entire()).spread));
}

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

TEST_CASE("the same fraction of a gap is the same time, however many pieces there are") {
    for (double const unit : {1.0, 1e3, 1 / 3600.0, 0.37}) {
        for (int k = 0; k < 50; ++k) {
            double const from = k * 0.1 * unit, to = (k + 1) * 0.1 * unit, gap = to - from;
            CAPTURE(unit, k);
            auto const four = refined_times({from, to}, gap / 4);
            auto const six = refined_times({from, to}, gap / 6);
            auto const twelve = refined_times({from, to}, gap / 12);
            REQUIRE(six.size() == 7);
            CHECK(four[2] == six[3]);
            for (std::size_t j = 0; j < 5; ++j) CHECK(four[j] == twelve[3 * j]);
            for (std::size_t j = 0; j < 7; ++j) CHECK(six[j] == twelve[2 * j]);
        }
    }
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
