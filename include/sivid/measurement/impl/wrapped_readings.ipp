// SPDX-License-Identifier: MIT
#ifndef SIVID_MEASUREMENT_IMPL_WRAPPED_READINGS_IPP
#define SIVID_MEASUREMENT_IMPL_WRAPPED_READINGS_IPP

#include <sivid/measurement/wrapped_readings.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace sivid {

namespace measurement_detail {

/// Of one channel, in the order of their times; those without a finite bound say nothing.
[[nodiscard]] inline record readings_of(record const& samples, std::size_t channel) {
    record result;
    for (auto const& m : sorted(samples))
        if (m.channel == channel && std::isfinite(mag(m.bound))) result.push_back(m);
    return result;
}

[[nodiscard]] inline std::vector<double> steps_between(record const& readings) {
    std::vector<double> steps;
    for (std::size_t k = 1; k < readings.size(); ++k)
        steps.push_back(mid(readings[k].bound) - mid(readings[k - 1].bound));
    return steps;
}

} // namespace measurement_detail

SIVID_DECL std::vector<double> steps_of(record const& samples, std::size_t channel) {
    return measurement_detail::steps_between(measurement_detail::readings_of(samples, channel));
}

SIVID_DECL sampled_signal wraps_of(record const& samples, std::size_t channel, double least,
                                   double begin, std::optional<double> start, double turn) {
    if (!(turn > 0)) turn = 2 * least;
    auto const own = measurement_detail::readings_of(samples, channel);
    auto const steps = measurement_detail::steps_between(own);
    bool const known = start && !own.empty() && std::isfinite(*start);
    double const first = known ? std::round((*start - mid(own[0].bound)) / turn) : 0;
    std::vector<double> times{begin}, counts{first};
    for (std::size_t k = 0; k < steps.size(); ++k) {
        if (!(std::abs(steps[k]) >= least)) continue;
        double const at = std::midpoint(own[k].time, own[k + 1].time);
        if (!(at > times.back())) continue; // two readings at one time
        times.push_back(at);
        counts.push_back(counts.back() - std::copysign(1.0, steps[k]));
    }
    return {std::move(times), std::move(counts), interpolation::hold};
}

SIVID_DECL double wrapping_range(std::vector<record> const& records, std::size_t channel,
                                 double turn) {
    constexpr double least = 0.6, ordinary = 1.0 / 3; // of the largest step
    std::vector<std::vector<double>> all;
    std::vector<double> sizes;
    for (auto const& r : records) {
        all.push_back(steps_of(r, channel));
        for (double const s : all.back()) sizes.push_back(std::abs(s));
    }
    std::sort(sizes.begin(), sizes.end());
    double const most = sizes.empty() ? 0 : sizes.back();
    std::size_t leaps = 0;
    int lasting = 0, net = 0; // those that the next step does not undo; down less up
    int farthest = 0;         // turns that a record goes through
    for (auto const& steps : all) {
        auto const leap = [&](std::size_t k) {
            return k < steps.size() && std::abs(steps[k]) >= least * most ? steps[k] : 0.0;
        };
        int turns = 0, lowest = 0, highest = 0;
        for (std::size_t k = 0; k < steps.size(); ++k) {
            if (leap(k) == 0) continue;
            ++leaps;
            bool const undone = leap(k) * leap(k + 1) < 0 || (k > 0 && leap(k - 1) * leap(k) < 0);
            if (undone) continue;
            ++lasting;
            turns += leap(k) < 0 ? 1 : -1;
            lowest = std::min(lowest, turns);
            highest = std::max(highest, turns);
        }
        net += turns;
        farthest = std::max(farthest, highest - lowest);
    }
    // What leaps more often than it moves on is no angle that is followed.
    if (lasting == 0 || 4 * leaps > sizes.size()) return 0;
    auto const first = sizes.size() - leaps;
    if (first > 0 && sizes[first - 1] >= ordinary * most) return 0;
    double const range = sizes[first + leaps / 2];
    if (turn > 0) return std::abs(range - turn) < turn / 4 ? range : 0;
    bool const one_way = lasting > 1 && std::abs(net) == lasting;
    return farthest > 1 || one_way ? range : 0;
}

} // namespace sivid

#endif
