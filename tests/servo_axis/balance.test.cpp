// SPDX-License-Identifier: MIT
#include "balance.hpp"
#include "simulated_axis.hpp"
#include "support/catch.hpp"

#include <sivid/number/decimal.hpp>

#include <cmath>
#include <random>
#include <string>
#include <vector>

using sivid::box;
using sivid::interval;
using namespace sivid::literals;

namespace {

/// A window over samples from .. to whose bounds contain the simulated motion, off centre.
servo::window window_of(servo_test::simulated_axis const& axis, std::size_t from, std::size_t to,
                        double bound, double shift) {
    servo::window w;
    for (auto k = from; k <= to; ++k) {
        w.times.push_back(axis.time[k]);
        w.force.push_back(axis.force[k]);
        double const e = k == from ? 1e-6 : bound;
        double const middle = axis.position[k] + (k == from ? 0 : shift * bound);
        w.position.push_back(interval(middle - e, middle + e));
    }
    w.velocity = interval(axis.velocity[from] - 1e-3, axis.velocity[from] + 5e-4);
    return w;
}

} // namespace

TEST_CASE("the balance never removes the true parameters", "[servo_axis]") {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(0, 1);
    std::size_t smaller = 0;
    for (int trial = 0; trial < 60; ++trial) {
        std::vector<double> const truth{60 + 120 * unit(random), 60 + 400 * unit(random),
                                        45 * unit(random), -15 + 30 * unit(random)};
        servo_test::simulated_axis const axis(truth, 2.0, 6 * unit(random));
        auto const from = static_cast<std::size_t>(150 * unit(random));
        double const shift = 1.9 * unit(random) - 0.95;
        servo::balance_test test({window_of(axis, from, from + 200, 1e-3, shift),
                                  window_of(axis, from + 100, from + 243, 1e-3, -shift)},
                                 sivid::enclose(0.001_dec));
        // The whole prior, a box about the truth, and the truth itself.
        double const prior[4][2]{{50, 200}, {50, 500}, {0, 50}, {-20, 20}};
        for (double const share : {1.0, 0.3, 0.03, 0.0}) {
            box p(4);
            for (std::size_t j = 0; j < 4; ++j) {
                double const size = share * (prior[j][1] - prior[j][0]);
                double const low = truth[j] - size * unit(random);
                p[j] = interval(std::max(low, prior[j][0]), std::max(low + size, truth[j]));
            }
            INFO("trial " << trial << ", share " << share);
            auto const says = test(p);
            REQUIRE(says.verdict == sivid::box_verdict::undecided);
            double before = 1, after = 1;
            for (std::size_t j = 0; j < 4; ++j) {
                CHECK(contains(says.rest[j], truth[j]));
                before *= width(p[j]);
                after *= width(says.rest[j]);
            }
            smaller += share > 0.1 && after < 0.5 * before ? 1 : 0;
        }
    }
    CHECK(smaller > 40); // of 120
}

TEST_CASE("the balance refutes parameters that cannot explain the motion", "[servo_axis]") {
    std::vector<double> const truth{95, 200, 20, -3};
    servo_test::simulated_axis const axis(truth, 2.0);
    servo::balance_test test({window_of(axis, 20, 220, 1e-3, 0.3)}, sivid::enclose(0.001_dec));
    for (std::size_t j = 0; j < 4; ++j) {
        double const far[4]{30, 150, 15, 12};
        for (double const sign : {-1.0, 1.0}) {
            box p = sivid::point_box(truth);
            p[j] = interval(truth[j] + sign * far[j]);
            INFO("parameter " << j);
            CHECK(test(p).verdict == sivid::box_verdict::outside);
        }
    }
}

TEST_CASE("the balance holds where the axis rests", "[servo_axis]") {
    // Friction larger than any force: the axis creeps, s(v) takes every value between -1 and 1.
    std::vector<double> const truth{100, 100, 50, 0};
    servo_test::simulated_axis axis(truth, 1.0);
    for (auto& f : axis.force) f *= 0.2;
    auto const line = axis.simulated({0.1, 0.02}, truth);
    for (std::size_t k = 0; k < axis.time.size(); ++k) {
        axis.position[k] = line.states[k][0];
        axis.velocity[k] = line.states[k][1];
    }
    servo::balance_test test({window_of(axis, 0, 200, 1e-4, 0.5)}, sivid::enclose(0.001_dec));
    auto const says = test(box{interval(50.0, 200.0), interval(50.0, 500.0), interval(0.0, 50.0),
                               interval(-20.0, 20.0)});
    REQUIRE(says.verdict == sivid::box_verdict::undecided);
    for (std::size_t j = 0; j < 4; ++j) CHECK(contains(says.rest[j], truth[j]));
    CHECK(test(sivid::point_box(truth)).verdict == sivid::box_verdict::undecided);
}
