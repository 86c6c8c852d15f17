// SPDX-License-Identifier: MIT
#include <sivid/paving/curve/detail/parallelepiped.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/sweep.hpp"

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

using namespace sivid;
using paving_detail::parallelepiped;
using paving_detail::strip;
using support::draws;

namespace {

using number = long double;
using matrix = Eigen::Matrix<number, Eigen::Dynamic, Eigen::Dynamic>;

/// d of a point, and how much of it slack may be.
struct coordinates {
    std::vector<number> d;
    double blur = 0;

    coordinates(parallelepiped const& c, std::vector<double> const& p) {
        auto const n = static_cast<Eigen::Index>(c.size());
        matrix sides(n, n), away(n, 1);
        double slack = 0;
        for (Eigen::Index j = 0; j < n; ++j) {
            auto const i = static_cast<std::size_t>(j);
            for (Eigen::Index k = 0; k < n; ++k)
                sides(j, k) = c.side[static_cast<std::size_t>(k)][i];
            away(j, 0) = static_cast<number>(p[i]) - c.middle[i];
            slack = std::max(slack, c.slack[i]);
        }
        matrix const inverse = sides.fullPivLu().inverse();
        matrix const at = inverse * away;
        for (Eigen::Index k = 0; k < n; ++k) d.push_back(at(k, 0));
        blur = 1e-9 + slack * static_cast<double>(inverse.cwiseAbs().rowwise().sum().maxCoeff());
    }
    [[nodiscard]] bool inside() const {
        return std::all_of(d.begin(), d.end(),
                           [this](number x) { return std::abs(x) <= 1 + blur; });
    }
};
bool holds(parallelepiped const& c, std::vector<double> const& p) {
    return coordinates(c, p).inside();
}

} // namespace

TEST_CASE("what strips leave of a parallelepiped stays in a smaller one") {
    draws d(1);
    for (int trial = 0; trial < support::swept(300, 20000); ++trial) {
        std::size_t const n = 1 + d.below(4);
        std::vector<interval> sides;
        std::vector<double> p;
        for (std::size_t j = 0; j < n; ++j) {
            double const low = d.uniform(-10, 10), high = low + std::pow(10, -d.uniform(0, 4));
            sides.push_back(interval(low, high));
            p.push_back(d.below(4) == 0 ? low : d.uniform(low, high));
        }
        box const whole(std::move(sides));
        auto cell = parallelepiped::of(whole);
        CHECK(subset(whole, cell.hull()));
        double const before = cell.volume;
        for (int round = 0; round < 4; ++round) {
            // Strips through the point, some of them thin. Within the slack it may be any: strips
            // hold for all of these, as those of models do.
            coordinates const at(cell, p);
            if (at.blur > 1e-6) break; // so thin that its d could be another one
            std::vector<strip> strips;
            for (std::size_t s = d.below(n + 2); s > 0; --s) {
                strip one{std::vector<double>(n), {}};
                double value = 0, size = 0;
                for (std::size_t k = 0; k < n; ++k) {
                    one.slope[k] = d.below(5) == 0 ? 0 : d.uniform(-1, 1);
                    value += one.slope[k] * static_cast<double>(at.d[k]);
                    size += std::abs(one.slope[k]);
                }
                double const thin = std::pow(10, -d.uniform(0, 3)) * size;
                one.range = interval(value - thin * d.uniform(0, 1) - size * at.blur,
                                     value + thin * d.uniform(0, 1) + size * at.blur);
                strips.push_back(one);
            }
            auto const less = cell.within(strips);
            CAPTURE(trial, round, n);
            REQUIRE(less);
            REQUIRE(holds(*less, p));
            REQUIRE(contains(less->hull(), p));
            CHECK(less->volume <= cell.volume * (1 + 1e-9));
            cell = *less;
            if (d.coin()) {
                auto const [lower, upper] = cell.halves(d.below(n));
                REQUIRE((holds(lower, p) || holds(upper, p)));
                cell = holds(lower, p) ? lower : upper;
            }
        }
        CHECK(cell.volume <= before * (1 + 1e-9));
    }
}

TEST_CASE("a strip that misses leaves nothing, and one without direction nothing less") {
    auto const cell = parallelepiped::of(box{interval(0.0, 1.0), interval(2.0, 4.0)});
    CHECK_FALSE(cell.within({{{1, 1}, interval(2.5, 3.0)}}));
    CHECK(cell.within({{{1, 1}, interval(2.0, 3.0)}})); // a corner
    auto const same = cell.within({{{0, 0}, interval(-1.0, 1.0)}});
    REQUIRE(same);
    CHECK(same->volume == cell.volume);
    CHECK_FALSE(cell.within({{{0, 0}, interval(0.5, 1.0)}}));
    CHECK(cell.at({1, -1}) == std::vector<double>{1, 2});
}
