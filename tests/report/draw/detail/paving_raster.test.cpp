// SPDX-License-Identifier: MIT
#include "support/catch.hpp"

#include <sivid/report/draw/paving_plot.hpp>

#include <cstdint>
#include <vector>

using namespace sivid::report;

namespace {

region truth(std::vector<projected_box> const& boxes, double x, double y) {
    region best = region::outside;
    for (projected_box const& b : boxes) {
        if (b.x.lo < x && x < b.x.hi && b.y.lo < y && y < b.y.hi) {
            best = std::max(best, b.verdict);
        }
    }
    return best;
}

std::vector<projected_box> random_boxes(int n, std::uint32_t seed) {
    auto const next = [&] {
        seed = seed * 1664525u + 1013904223u;
        return static_cast<double>(seed >> 8) / 16777216.0;
    };
    std::vector<projected_box> out;
    for (int i = 0; i < n; ++i) {
        double const x = next(), y = next();
        out.push_back({{x, x + 0.2 * next()},
                       {y, y + 0.2 * next()},
                       static_cast<region>(static_cast<int>(4 * next()))});
    }
    return out;
}

} // namespace

TEST_CASE("paving raster: the best region above a point wins, and nothing above is outside") {
    std::vector<projected_box> const boxes{{{0, 1}, {0, 1}, region::outside},
                                           {{0, 0.5}, {0, 1}, region::pending},
                                           {{0, 0.4}, {0, 1}, region::undecided},
                                           {{0.1, 0.3}, {0.2, 0.8}, region::inside}};
    region_raster const r = project_paving(boxes, {0, 1}, {0, 1}, 64);
    REQUIRE(r.exact);
    CHECK(r.columns() == 5);
    CHECK(r.rows() == 3);
    CHECK(r.at(1, 1) == region::inside);
    CHECK(r.at(1, 0) == region::undecided);
    CHECK(r.at(3, 1) == region::pending);
    CHECK(r.at(4, 1) == region::outside);
}

TEST_CASE("paving raster: exact cells agree with the rule at every centre") {
    auto const boxes = random_boxes(60, 7);
    range const x{0.1, 0.9}, y{0.05, 1.1};
    region_raster const r = project_paving(boxes, x, y, 200);
    REQUIRE(r.exact);
    for (std::size_t i = 0; i < r.columns(); ++i) {
        for (std::size_t j = 0; j < r.rows(); ++j) {
            REQUIRE(r.at(i, j) ==
                    truth(boxes, (r.xs[i] + r.xs[i + 1]) / 2, (r.ys[j] + r.ys[j + 1]) / 2));
        }
    }
}

TEST_CASE("paving raster: even cells never paint outside what is not") {
    auto const boxes = random_boxes(3000, 11);
    region_raster const r = project_paving(boxes, {0, 1}, {0, 1}, 50);
    REQUIRE_FALSE(r.exact);
    REQUIRE(r.columns() == 50);
    std::uint32_t seed = 3;
    for (int k = 0; k < 3000; ++k) {
        seed = seed * 1664525u + 1013904223u;
        double const x = static_cast<double>(seed >> 16) / 65536.0,
                     y = static_cast<double>(seed & 0xFFFFu) / 65536.0;
        auto const i = static_cast<std::size_t>(x * 50), j = static_cast<std::size_t>(y * 50);
        REQUIRE(r.at(i, j) >= truth(boxes, x, y));
    }
}

TEST_CASE("paving raster: merged rectangles tile exactly the cells that are not outside") {
    region_raster const r = project_paving(random_boxes(500, 5), {0, 1}, {0, 1}, 80);
    std::vector<int> covered(r.cells.size(), 0);
    auto const rects = merge_cells(r);
    for (region_rect const& q : rects) {
        for (std::size_t j = q.low; j < q.high; ++j) {
            for (std::size_t i = q.left; i < q.right; ++i) {
                ++covered[j * r.columns() + i];
                REQUIRE(r.at(i, j) == q.what);
            }
        }
    }
    std::size_t painted = 0;
    for (std::size_t k = 0; k < r.cells.size(); ++k) {
        REQUIRE(covered[k] == (r.cells[k] == region::outside ? 0 : 1));
        painted += r.cells[k] == region::outside ? 0u : 1u;
    }
    CHECK(rects.size() < painted);
}

TEST_CASE(
    "paving raster: thin boxes stay visible and do not spread, and neighbours do not leak in") {
    region_raster const thin =
        project_paving({{{0.3, 0.3}, {0, 1}, region::inside}}, {0, 1}, {0, 1}, 100);
    std::size_t painted = 0;
    for (region const c : thin.cells) {
        painted += c == region::inside ? 1u : 0u;
    }
    CHECK(painted >= 1);
    CHECK(painted * 100 <= thin.cells.size());
    region_raster const beside = project_paving(
        {{{1, 2}, {0, 1}, region::inside}, {{-1, 0}, {0, 1}, region::inside}}, {0, 1}, {0, 1}, 100);
    CHECK(merge_cells(beside).empty());
    CHECK(merge_cells(project_paving({}, {0, 1}, {0, 1}, 10)).empty());
}
