// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_PLACE_DETAIL_MISSING_RATE_HPP
#define SIVID_APPROXIMATE_PLACE_DETAIL_MISSING_RATE_HPP

#include <sivid/approximate/fit/detail/approximate_campaign.hpp>
#include <sivid/model/sampling.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <variant>
#include <vector>

namespace sivid {

/// Knots of the missing rates of an experiment: every second sample, denser at the begin, where
/// filters of unknown inputs settle.
[[nodiscard]] inline std::vector<double> missing_rate_knots(experiment const& e,
                                                            std::size_t most = 64) {
    std::vector<double> times;
    for (auto const& m : e.measurements) times.push_back(m.time);
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    double const end = times.back();
    double const whole = end - e.begin;
    if (!(whole > 0)) return {e.begin, e.begin + 1};
    double step = whole;
    std::vector<double> gaps;
    for (std::size_t k = 1; k < times.size(); ++k) gaps.push_back(times[k] - times[k - 1]);
    if (!gaps.empty()) {
        auto const middle = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2);
        std::nth_element(gaps.begin(), middle, gaps.end());
        step = 2 * *middle;
    }
    step = std::clamp(step, whole / static_cast<double>(most), whole);
    std::vector<double> knots{e.begin};
    while (knots.back() < end - 1e-9 * whole) {
        double const passed = knots.back() - e.begin;
        double const own = passed < 0.99 * step ? step / 4 : passed < 4.99 * step ? step / 2 : step;
        knots.push_back(knots.back() + own);
    }
    // The last piece is not shorter than half a step.
    if (knots.size() > 2 && end - knots[knots.size() - 2] < 0.25 * step) knots.pop_back();
    knots.back() = std::max(end, knots.back());
    return knots;
}

/// How large a missing rate may well be, per state: spread of the rates along a fit.
struct missing_rate_scale {
    double size = 1; ///< standard deviation of d
    double walk = 1; ///< of its change within a unit of time
};

/// The quadratic form sum d^2/size^2 + sum (delta d)^2/(walk^2 delta t) of several equations whose
/// knot values alternate, after `starts` other variables: the lower triangle.
[[nodiscard]] inline Eigen::MatrixXd
missing_rate_prior(std::vector<double> const& knots, std::vector<missing_rate_scale> const& scales,
                   std::size_t starts) {
    auto const count = scales.size();
    auto const n = static_cast<Eigen::Index>(starts + knots.size() * count);
    Eigen::MatrixXd r = Eigen::MatrixXd::Zero(n, n);
    for (std::size_t c = 0; c < count; ++c) {
        for (std::size_t k = 0; k < knots.size(); ++k) {
            auto const i = static_cast<Eigen::Index>(starts + k * count + c);
            r(i, i) += 1 / (scales[c].size * scales[c].size);
            if (k == 0) continue;
            auto const j = i - static_cast<Eigen::Index>(count);
            double const w = 1 / (scales[c].walk * scales[c].walk * (knots[k] - knots[k - 1]));
            r(i, i) += w;
            r(j, j) += w;
            r(i, j) -= w;
        }
    }
    return r;
}

/// The time in which a missing rate may change: ten gaps between samples, or the twentieth part of
/// a long record.
[[nodiscard]] inline double rate_time(identification_problem const& problem) {
    return sampling_of(problem.experiments).span(10, 0.05);
}

/// By how much each state may be off where a channel shows it within its bounds: the finest of
/// these over the channel's slope; of others the finest of states in their unit, then a millionth
/// of what they may be.
[[nodiscard]] inline std::vector<double> errors_of_states(approximate_campaign const& c) {
    auto const& states = c.problem().model.about.states;
    std::vector<double> shown(states.size(), std::numeric_limits<double>::infinity());
    for (std::size_t e = 0; e < c.experiments(); ++e) {
        auto const own = c.shown_within(e);
        for (std::size_t i = 0; i < own.size(); ++i) shown[i] = std::min(shown[i], own[i]);
    }
    auto result = shown;
    for (std::size_t i = 0; i < result.size(); ++i) {
        for (std::size_t j = 0; j < shown.size() && !std::isfinite(shown[i]); ++j)
            if (states[j].unit == states[i].unit) result[i] = std::min(result[i], shown[j]);
        if (!std::isfinite(result[i])) result[i] = 1e-6 * states[i].limit;
    }
    return result;
}

/// Of states, then of inputs. Typical sizes of the rates along a motion: four times their root mean
/// square. An equation that rests is as uncertain as the others of its unit, or as the errors of
/// its state within `rate_time`.
[[nodiscard]] inline std::vector<missing_rate_scale> missing_rate_scales(approximate_campaign& c,
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
    double time = rate_time(c.problem());
    if (!(time > 0)) time = 1; // all is measured at the begin: no rate acts
    auto const error = errors_of_states(c);
    for (std::size_t i = 0; i < squares.size(); ++i) {
        double largest = squares[i];
        for (std::size_t j = 0; j < squares.size(); ++j) {
            if (about.states[j].unit == about.states[i].unit)
                largest = std::max(largest, squares[j]);
        }
        double const own = std::sqrt(squares[i] / std::max(count, 1.0));
        double const unit = std::sqrt(largest / std::max(count, 1.0));
        double const size = std::max({4 * own, 2 * unit, 20 * error[i] / time});
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
