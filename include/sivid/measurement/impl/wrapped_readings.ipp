// SPDX-License-Identifier: MIT
#ifndef SIVID_MEASUREMENT_IMPL_WRAPPED_READINGS_IPP
#define SIVID_MEASUREMENT_IMPL_WRAPPED_READINGS_IPP

#include <sivid/measurement/wrapped_readings.hpp>

#include <sivid/number/text/nearest_text.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
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
                                   double begin, double first) {
    for (auto const& m : samples)
        if (m.channel == channel &&
            std::isfinite(m.bound.lower()) != std::isfinite(m.bound.upper()))
            throw std::invalid_argument("the reading at t = " + nearest_text(m.time) +
                                        " has one bound, so that its turn cannot be told: state "
                                        "both, or leave it out");
    auto const own = measurement_detail::readings_of(samples, channel);
    auto const steps = measurement_detail::steps_between(own);
    std::vector<double> times{begin}, counts{first};
    for (std::size_t k = 0; k < steps.size(); ++k) {
        if (!(std::abs(steps[k]) >= least)) continue;
        double const before = own[k].time, after = own[k + 1].time;
        double const at = std::midpoint(before, after);
        if (!(before < at && at < after))
            throw std::invalid_argument(
                "there are readings on both sides of a leap at t = " + nearest_text(after) +
                ": leave those on one side out, or follow the turns");
        times.push_back(at);
        counts.push_back(counts.back() - std::copysign(1.0, steps[k]));
    }
    return {std::move(times), std::move(counts), interpolation::hold};
}

SIVID_DECL interval turn_of_leaps(record const& samples, std::size_t channel, double least) {
    using traits = interval_traits<interval>;
    auto const own = measurement_detail::readings_of(samples, channel);
    auto turn = traits::empty();
    for (std::size_t k = 1; k < own.size(); ++k) {
        if (!(std::abs(mid(own[k].bound) - mid(own[k - 1].bound)) >= least)) continue;
        auto const leap = traits::abs(traits::sub(own[k].bound, own[k - 1].bound));
        turn = hull(turn, traits::add(leap, traits::bounds(-least, least)));
    }
    return turn;
}

SIVID_DECL std::optional<double> wraps_before(record const& samples, std::size_t channel,
                                              interval const& start, interval const& turn) {
    using traits = interval_traits<interval>;
    auto const own = measurement_detail::readings_of(samples, channel);
    if (own.empty()) return 0;
    if (!(turn.lower() > 0)) return std::nullopt;
    bool undefined = false;
    auto const turns = traits::add(traits::div(traits::sub(start, own[0].bound), turn, undefined),
                                   traits::bounds(-0.5, 0.5));
    double const least = std::ceil(turns.lower()), most = std::floor(turns.upper());
    return least == most ? std::optional{least} : std::nullopt;
}

SIVID_DECL double wrapping_range(std::vector<record> const& records, std::size_t channel,
                                 double turn) {
    constexpr double least = 0.6, ordinary = 1.0 / 3; // of the largest step, of a leap
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
    double const range = sizes[first + leaps / 2];
    if (first > 0 && sizes[first - 1] >= ordinary * range) return 0;
    if (turn > 0) return std::abs(range - turn) < turn / 4 ? range : 0;
    bool const one_way = lasting > 1 && std::abs(net) == lasting;
    return farthest > 1 || one_way ? range : 0;
}

} // namespace sivid

#endif
