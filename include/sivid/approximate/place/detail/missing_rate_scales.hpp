// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_PLACE_DETAIL_MISSING_RATE_SCALES_HPP
#define SIVID_APPROXIMATE_PLACE_DETAIL_MISSING_RATE_SCALES_HPP

#include <sivid/approximate/fit/detail/campaign.hpp>
#include <sivid/approximate/place/detail/missing_rate.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <variant>
#include <vector>

namespace sivid {

/// What a second is to a motion of twenty seconds, and not less [s]: the time in which a missing
/// rate may change.
[[nodiscard]] inline double rate_time(identification_problem const& problem) {
    double longest = 0;
    for (auto const& e : problem.experiments) {
        for (auto const& m : e.measurements) longest = std::max(longest, m.time - e.begin);
    }
    return std::max(1.0, longest / 20);
}

/// Of states, then of inputs. Typical sizes of the rates along a motion: four times their root mean
/// square. An equation that rests is as uncertain as the others of its unit, or as its errors
/// within `rate_time`.
[[nodiscard]] inline std::vector<missing_rate_scale> missing_rate_scales(campaign& c,
                                                                         arrow_vector const& z) {
    auto const& about = c.problem().model.about;
    std::vector<double> squares(about.states.size(), 0.0);
    double count = 0;
    for (std::size_t e = 0; e < c.experiments(); ++e) {
        simulated_trace seen;
        if (!c.trace(e, z, seen)) continue;
        for (auto const& rate : seen.rates) {
            for (std::size_t i = 0; i < rate.size(); ++i) squares[i] += rate[i] * rate[i];
            ++count;
        }
    }
    std::vector<missing_rate_scale> scales;
    double const time = rate_time(c.problem());
    double error = std::numeric_limits<double>::infinity();
    for (std::size_t e = 0; e < c.experiments(); ++e) {
        for (double const r : c.radii(e)) error = std::min(error, r);
    }
    for (std::size_t i = 0; i < squares.size(); ++i) {
        double largest = squares[i];
        for (std::size_t j = 0; j < squares.size(); ++j) {
            if (about.states[j].unit == about.states[i].unit)
                largest = std::max(largest, squares[j]);
        }
        double const own = std::sqrt(squares[i] / std::max(count, 1.0));
        double const unit = std::sqrt(largest / std::max(count, 1.0));
        double const size = std::max({4 * own, 2 * unit, 20 * error / time});
        scales.push_back({size, 2.0 / 3 * size / std::sqrt(time)});
    }
    for (std::size_t i = 0; i < about.inputs.size(); ++i) {
        double largest = 0;
        for (auto const& e : c.problem().experiments) {
            auto const* samples = std::get_if<sampled_signal>(&e.inputs[i]);
            if (samples == nullptr) continue;
            for (double const u : samples->values()) largest = std::max(largest, std::abs(u));
        }
        double const size = largest > 0 ? largest : 1;
        scales.push_back({size, 2.0 / 3 * size / std::sqrt(time)});
    }
    return scales;
}

} // namespace sivid

#endif
