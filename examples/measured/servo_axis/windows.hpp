// SPDX-License-Identifier: MIT
#ifndef SERVO_AXIS_WINDOWS_HPP
#define SERVO_AXIS_WINDOWS_HPP

#include "linear_axis.hpp"
#include "record.hpp"

#include <sivid/model/problem.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace servo {

/// What is stated about windows that every model is measured by.
struct window_bounds {
    sivid::exact_decimal model_error, start_position, start_velocity;
    std::size_t every_sample = 1; ///< every so many samples are compared
};

inline sivid::interval about(sivid::exact_decimal const& value, sivid::exact_decimal const& bound) {
    return *sivid::enclose(value - bound, value + bound);
}

/// A window of a record as an experiment: it starts at the measured position and the filter's
/// velocity, each with its bound.
inline sivid::experiment window_experiment(recording const& r, sample_range const& w,
                                           std::size_t filter_half, window_bounds const& b) {
    using difference = std::vector<double>::difference_type;
    auto const part = [&](std::vector<double> const& all) {
        return std::vector<double>(all.begin() + static_cast<difference>(w.from),
                                   all.begin() + static_cast<difference>(w.to + 1));
    };
    sivid::experiment e;
    e.name = sivid::exact_decimal::shortest(r.time[w.from]).text() + " s";
    e.begin = r.time[w.from];
    e.inputs = {sivid::sampled_signal(part(r.time), part(r.force), sivid::interpolation::linear)};
    auto const v = sivid::exact_decimal::shortest(approximate_velocity(r, w.from, filter_half));
    e.initial = sivid::box{about(r.position[w.from], b.start_position), about(v, b.start_velocity)};
    for (std::size_t k = w.from + b.every_sample; k <= w.to; k += b.every_sample) {
        e.measurements.push_back({r.time[k], 0, about(r.position[k], b.model_error)});
    }
    return e;
}

/// All windows of a record.
inline std::vector<sivid::experiment> window_experiments(recording const& r,
                                                         std::vector<sample_range> const& windows,
                                                         std::size_t filter_half,
                                                         window_bounds const& b) {
    std::vector<sivid::experiment> all;
    for (auto const& w : windows) all.push_back(window_experiment(r, w, filter_half, b));
    return all;
}

/// The mass and its viscous friction, to be found from windows.
inline sivid::identification_problem linear_problem(std::vector<sivid::experiment> windows) {
    sivid::identification_problem problem;
    problem.model = sivid::record_model(linear_axis{});
    problem.choice.unknown = {"M", "F_v"};
    problem.prior = sivid::box{sivid::interval(50, 200), sivid::interval(50, 500)};
    problem.experiments = std::move(windows);
    return problem;
}

} // namespace servo

#endif
