// SPDX-License-Identifier: MIT
// A record of the axis cut into windows that start where a filter says: a data set.
#ifndef SERVO_AXIS_WINDOWS_HPP
#define SERVO_AXIS_WINDOWS_HPP

#include <sivid/io/dataset_value.hpp>
#include <sivid/io/text/csv_table.hpp>
#include <sivid/io/text/exact_decimal.hpp>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace servo {

using sivid::exact_decimal;

inline exact_decimal decimal(char const* text) { return *exact_decimal::parse(text); }

/// What is stated of a record, since no file says it.
struct window_bounds {
    exact_decimal model_error = decimal("0.001");    ///< of the position over a window [m]
    exact_decimal start_position = decimal("2e-6");  ///< the encoder's [m]
    exact_decimal start_velocity = decimal("0.001"); ///< about the filter's [m/s]
};
inline constexpr std::size_t window_samples = 200; ///< one second
inline constexpr std::size_t every_sample = 5;     ///< so many are compared with the model
inline constexpr std::size_t filter_half = 5;      ///< samples on each side of a start

/// A record: time [s], motor force [N], position [m].
struct recording {
    std::vector<exact_decimal> time, position;
    std::vector<double> force;
};

/// Reads the columns t_s, force_N and position_m; others are not looked at.
/// @throws sivid::input_error with file, line and column
inline recording read_recording(std::filesystem::path const& file) {
    auto const table = sivid::csv_table::read(file);
    auto const t = table.required_column("t_s");
    auto const f = table.required_column("force_N");
    auto const q = table.required_column("position_m");
    recording r;
    for (auto const& row : table.rows()) {
        auto const time = table.number(row, t);
        if (!r.time.empty() && !(*nearest(r.time.back()) < *nearest(time)))
            table.fail(row.line, t, "the time does not increase",
                       "correct it, or leave the row out");
        r.time.push_back(time);
        r.force.push_back(*nearest(table.number(row, f)));
        r.position.push_back(table.number(row, q));
    }
    return r;
}

/// Velocity at sample k: the slope there of the cubic that fits the samples k - filter_half ..
/// k + filter_half best (Savitzky and Golay; zero phase). Not a proof: its bound is stated.
///   sum_i (S6 i - S4 i^3) q_{k+i} / (S2 S6 - S4^2) / h,  S_n = sum i^n
/// @given  evenly spaced samples
inline double approximate_velocity(recording const& r, std::size_t k) {
    double s2 = 0, s4 = 0, s6 = 0, sum = 0;
    for (std::size_t i = 1; i <= filter_half; ++i) {
        double const x = static_cast<double>(i);
        s2 += 2 * x * x;
        s4 += 2 * std::pow(x, 4);
        s6 += 2 * std::pow(x, 6);
    }
    for (std::size_t i = 1; i <= filter_half; ++i) {
        double const x = static_cast<double>(i);
        sum += (s6 * x - s4 * x * x * x) * *nearest(r.position[k + i] - r.position[k - i]);
    }
    double const span = *nearest(r.time[k + filter_half] - r.time[k - filter_half]);
    return sum / (s2 * s6 - s4 * s4) * static_cast<double>(2 * filter_half) / span;
}

inline sivid::stated_range about(exact_decimal const& value, exact_decimal const& bound) {
    auto const lower = value - bound, upper = value + bound;
    return {lower, upper, *sivid::enclose(lower, upper)};
}

/// The window from sample `from` on: it starts at the measured position and the filter's velocity,
/// each with its bound. The force is linear between samples.
inline sivid::scenario window(recording const& r, std::size_t from, std::string name,
                              sivid::scenario_role role, window_bounds const& b) {
    sivid::scenario s;
    s.name = std::move(name);
    s.role = role;
    std::vector<double> times, forces;
    for (std::size_t k = from; k <= from + window_samples; ++k) {
        times.push_back(*nearest(r.time[k] - r.time[from]));
        forces.push_back(r.force[k]);
        if (k == from || (k - from) % every_sample != 0) continue;
        s.measurements.push_back({times.back(), 0, about(r.position[k], b.model_error).enclosure});
        s.stated.push_back({r.position[k], b.model_error});
    }
    s.duration = times.back();
    s.inputs = {{sivid::sampled_signal(times, forces, sivid::interpolation::linear), {}, {}}};
    auto const v = exact_decimal::shortest(approximate_velocity(r, from));
    for (auto const& start : {about(r.position[from], b.start_position), about(v, b.start_velocity)})
        s.initial.push_back({start.enclosure, start});
    return s;
}

/// Windows of one second, one after the other from 1 s on, as far as the record and the filter go.
inline void add_windows(sivid::dataset& data, recording const& r, std::string const& record,
                        sivid::scenario_role role, window_bounds const& b) {
    for (std::size_t k = window_samples; k + window_samples + filter_half < r.time.size();
         k += window_samples)
        data.scenarios.push_back(
            window(r, k, record + "-" + std::to_string(k / window_samples) + "s", role, b));
}

/// The unknown mass and its viscous friction, with what the windows rest on.
inline sivid::dataset axis_dataset(window_bounds const& b) {
    auto const range = [](char const* lower, char const* upper) {
        return sivid::stated_range{decimal(lower), decimal(upper),
                                   *sivid::enclose(decimal(lower), decimal(upper))};
    };
    sivid::dataset data;
    data.id = "servo axis";
    data.model = "linear_axis";
    data.parameters = {{0, "M", "kg", range("50", "200")}, {1, "F_v", "N s/m", range("50", "500")}};
    data.max_outlier_fraction = decimal("0");
    data.assumptions = {
        "force linear between samples",
        "position bound " + b.model_error.text() +
            " m stands for the model error over a window of a second (the encoder is good to 2 um)",
        "each window started within " + b.start_position.text() +
            " m of the measured position and within " + b.start_velocity.text() +
            " m/s of the velocity from a zero-phase low-pass filter"};
    return data;
}

} // namespace servo

#endif
