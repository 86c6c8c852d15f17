// SPDX-License-Identifier: MIT
#include "support/catch.hpp"
#include "support/random.hpp"

#include <sivid/space/frame/detail/lane_frame.hpp>

#include <Eigen/Core>
#include <Eigen/LU>

#include <cmath>
#include <cstddef>
#include <vector>

using namespace sivid;
using support::draws;

namespace {

using eight = lanes<8>;
using matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using vector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

matrix axes_of(lane_frame<eight> const& frame, std::size_t lane) {
    auto const n = static_cast<Eigen::Index>(frame.axis.size());
    matrix q(n, n);
    for (Eigen::Index k = 0; k < n; ++k) {
        for (Eigen::Index i = 0; i < n; ++i) {
            q(i, k) = frame.axis[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)][lane];
        }
    }
    return q;
}

} // namespace

TEST_CASE("the defect bounds what the transpose lacks of an inverse") {
    draws d(5);
    for (int trial = 0; trial < 100; ++trial) {
        std::size_t const n = 1 + d.below(6);
        std::size_t const m = d.below(10);
        std::vector<std::vector<eight>> directions(m + 1, std::vector<eight>(n));
        for (auto& v : directions) {
            for (auto& x : v) {
                for (std::size_t l = 0; l < 8; ++l) {
                    // Lane 5 has nothing, lane 6 is no number, lane 7 nearly parallel directions.
                    double value = d.uniform(-1, 1) * std::pow(10.0, d.uniform(-3, 3));
                    if (l == 5) value = 0;
                    if (l == 6) value = std::nan("");
                    if (l == 7) value = 1 + 1e-12 * d.uniform(-1, 1);
                    x.set(l, value);
                }
            }
        }
        auto const frame = make_lane_frame(directions);
        REQUIRE(frame.axis.size() == n);
        for (std::size_t l = 0; l < 8; ++l) {
            auto const q = axes_of(frame, l);
            double const defect = frame.defect[l];
            REQUIRE(defect >= 0);
            REQUIRE(defect < 0.02);
            for (int sample = 0; sample < 5; ++sample) {
                vector g(static_cast<Eigen::Index>(n));
                for (auto& x : g) x = d.uniform(-1, 1);
                vector const exact = q.fullPivLu().solve(g);
                vector const transposed = q.transpose() * g;
                long double const room =
                    static_cast<long double>(defect) * transposed.lpNorm<Eigen::Infinity>() +
                    1e-17L;
                REQUIRE((exact - transposed).lpNorm<Eigen::Infinity>() <= room);
            }
        }
        if (n > 1) CHECK(frame.defect[0] < 1e-8);
        CHECK(axes_of(frame, 6) ==
              matrix::Identity(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n)));
    }
}

TEST_CASE("the first axis is the longest direction") {
    std::vector<std::vector<double>> const directions{{1, 1}, {-6, 8}, {0, 2}};
    auto const frame = make_lane_frame(directions);
    CHECK_THAT(frame.axis[0][0], WithinAbs(-0.6, 1e-15));
    CHECK_THAT(frame.axis[0][1], WithinAbs(0.8, 1e-15));
    CHECK_THAT(std::abs(frame.axis[1][0]), WithinAbs(0.8, 1e-15));
    CHECK(frame.defect < 1e-13);
}

TEST_CASE("each lane has its own frame, and no rounding chooses it") {
    draws d(6);
    for (int trial = 0; trial < 20; ++trial) {
        // A direction is 0 in the lanes that were not there when it came up.
        std::vector<std::vector<eight>> all(6, std::vector<eight>(2)), nudged;
        for (std::size_t j = 0; j < all.size(); ++j)
            for (std::size_t l = 0; l < 8; ++l)
                if ((j + l) % 3 != 0)
                    for (auto& x : all[j]) x.set(l, d.uniform(-1, 1));
        nudged = all;
        for (auto& v : nudged)
            for (auto& x : v)
                for (std::size_t l = 0; l < 8; ++l) x.set(l, x[l] * (1 + 1e-14 * d.uniform(-1, 1)));
        auto const together = make_lane_frame(all), near = make_lane_frame(nudged);
        for (std::size_t l = 0; l < 8; ++l) {
            std::vector<std::vector<double>> own;
            for (auto const& v : all) own.push_back({v[0][l], v[1][l]});
            auto const alone = make_lane_frame(own);
            for (std::size_t k = 0; k < 2; ++k)
                for (std::size_t i = 0; i < 2; ++i) {
                    CHECK(together.axis[k][i][l] == alone.axis[k][i]);
                    CHECK_THAT(near.axis[k][i][l], WithinAbs(alone.axis[k][i], 1e-11));
                }
        }
    }
}

TEST_CASE("of equally long directions the first is an axis") {
    std::vector<std::vector<double>> const directions{{3, 4}, {4 * (1 + 1e-15), 3}};
    auto const frame = make_lane_frame(directions);
    CHECK_THAT(frame.axis[0][0], WithinAbs(0.6, 1e-14));
}
