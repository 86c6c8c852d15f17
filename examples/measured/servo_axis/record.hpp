// SPDX-License-Identifier: MIT
#ifndef SERVO_AXIS_RECORD_HPP
#define SERVO_AXIS_RECORD_HPP

#include <sivid/io/text/csv_table.hpp>
#include <sivid/io/text/exact_decimal.hpp>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace servo {

/// A record of the axis: time [s], motor force [N], position [m].
struct recording {
    std::vector<double> time;
    std::vector<double> force;
    std::vector<sivid::exact_decimal> position; ///< as the file states it
    std::vector<double> nearest_position;

    [[nodiscard]] std::size_t size() const { return time.size(); }
};

/// Reads the columns t_s, force_N and position_m; others are not looked at.
/// @throws sivid::input_error with file, line and column
[[nodiscard]] inline recording read_recording(std::filesystem::path const& file) {
    auto const table = sivid::csv_table::read(file);
    auto const t = table.required_column("t_s");
    auto const f = table.required_column("force_N");
    auto const q = table.required_column("position_m");
    recording result;
    for (auto const& row : table.rows()) {
        auto const time = *nearest(table.number(row, t));
        if (!result.time.empty() && !(result.time.back() < time))
            table.fail(row.line, t, "the time does not increase",
                       "correct it, or leave the row out");
        result.time.push_back(time);
        result.force.push_back(*nearest(table.number(row, f)));
        result.position.push_back(table.number(row, q));
        result.nearest_position.push_back(*nearest(result.position.back()));
    }
    return result;
}

/// Velocity at sample k by a zero-phase low-pass filter: the slope there of the cubic that fits the
/// samples k - half .. k + half best (Savitzky and Golay). Not a proof: its bound is stated.
///   sum_i (S6 i - S4 i^3) q_{k+i} / (S2 S6 - S4^2) / h,  S_n = sum i^n
/// @given  half <= k < size - half, evenly spaced samples there (checked by `evenly_spaced`)
[[nodiscard]] inline double approximate_velocity(recording const& r, std::size_t k,
                                                 std::size_t half) {
    double s2 = 0, s4 = 0, s6 = 0, sum = 0;
    for (std::size_t i = 1; i <= half; ++i) {
        double const x = static_cast<double>(i);
        s2 += 2 * x * x;
        s4 += 2 * std::pow(x, 4);
        s6 += 2 * std::pow(x, 6);
    }
    for (std::size_t i = 1; i <= half; ++i) {
        double const x = static_cast<double>(i);
        sum += (s6 * x - s4 * x * x * x) * (r.nearest_position[k + i] - r.nearest_position[k - i]);
    }
    double const h = (r.time[k + half] - r.time[k - half]) / static_cast<double>(2 * half);
    return sum / (s2 * s6 - s4 * s4) / h;
}

[[nodiscard]] inline bool evenly_spaced(recording const& r, std::size_t from, std::size_t to) {
    double const h = (r.time[to] - r.time[from]) / static_cast<double>(to - from);
    for (std::size_t k = from; k < to; ++k) {
        if (std::abs(r.time[k + 1] - r.time[k] - h) > 1e-3 * h) return false;
    }
    return true;
}

/// Which windows of the record are used.
struct window_choice {
    double length = 1;           ///< [s]
    double first = 1;            ///< start of the first one [s]
    double every = 2;            ///< from start to start [s]
    std::size_t filter_half = 5; ///< samples on each side, for the start's velocity
};

/// Samples from .. to of the record.
struct sample_range {
    std::size_t from = 0, to = 0;
};

/// The windows that fit into the record, with the filter's samples around the start.
/// @throws sivid::input_error when there is none
[[nodiscard]] inline std::vector<sample_range>
cut_windows(recording const& r, window_choice const& c, std::filesystem::path const& file) {
    std::vector<sample_range> result;
    auto const fail = [&](std::string problem, std::string remedy) {
        throw sivid::input_error{{.file = file.string()}, std::move(problem), std::move(remedy)};
    };
    std::size_t k = 0;
    for (std::size_t i = 0; k < r.size(); ++i) {
        double const start = c.first + static_cast<double>(i) * c.every;
        while (k < r.size() && r.time[k] < start - 1e-9) ++k;
        auto last = k;
        while (last + 1 < r.size() && r.time[last + 1] <= start + c.length + 1e-9) ++last;
        if (k >= r.size() || r.time.back() < start + c.length - 1e-9) break;
        if (k < c.filter_half || k + c.filter_half >= r.size() || last < k + 8) continue;
        if (!evenly_spaced(r, k - c.filter_half, k + c.filter_half))
            fail("the samples about " + std::to_string(start) + " s are not evenly spaced",
                 "resample the record; the velocity filter needs equal steps");
        result.push_back({k, last});
    }
    if (result.empty())
        fail("no window fits into the record", "choose a shorter window or an earlier first one");
    return result;
}

} // namespace servo

#endif
