// SPDX-License-Identifier: MIT
// A record of a simulated axis, for tests that must not depend on the real one.
#ifndef SERVO_AXIS_TESTS_SIMULATED_AXIS_HPP
#define SERVO_AXIS_TESTS_SIMULATED_AXIS_HPP

#include "model.hpp"

#include <sivid/approximate/simulate/simulate.hpp>
#include <sivid/model/bound_model.hpp>

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace servo_test {

struct simulated_axis {
    std::vector<double> time, force, position, velocity;

    /// @param p  M, F_v, F_c, offset
    simulated_axis(std::vector<double> const& p, double seconds, double phase = 0) {
        auto const count = static_cast<std::size_t>(std::lround(200 * seconds));
        for (std::size_t k = 0; k <= count; ++k) {
            double const t = static_cast<double>(k) / 200;
            time.push_back(t);
            // What a table with four decimals holds.
            double const f = 100 * std::sin(4.2 * t + phase) + 30 * std::sin(17 * t) + p[3];
            force.push_back(std::round(1e4 * f) / 1e4);
        }
        auto const line = simulated({0.1, 0.05}, p);
        for (auto const& x : line.states) {
            position.push_back(x[0]);
            velocity.push_back(x[1]);
        }
    }

    /// The motion under the force.
    [[nodiscard]] sivid::approximate_trajectory simulated(std::vector<double> const& start,
                                                          std::vector<double> const& p) const {
        std::vector<sivid::signal> const inputs{
            sivid::sampled_signal(time, force, sivid::interpolation::linear)};
        sivid::parameter_choice const unknown{{"M", "F_v", "F_c", "offset"}, {}};
        return sivid::simulate(std::make_shared<sivid::approximate_model const>(
                                   sivid::record_model(servo_axis{}), unknown, inputs),
                               inputs, start, p, 0, time, {1e-11});
    }

    [[nodiscard]] std::string csv() const {
        std::string text = "t_s,force_N,position_m\n";
        for (std::size_t k = 0; k < time.size(); ++k) {
            char row[80];
            std::snprintf(row, sizeof row, "%.3f,%.4f,%.8f\n", time[k], force[k], position[k]);
            text += row;
        }
        return text;
    }
};

} // namespace servo_test

#endif
