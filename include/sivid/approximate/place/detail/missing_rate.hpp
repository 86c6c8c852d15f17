// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_PLACE_DETAIL_MISSING_RATE_HPP
#define SIVID_APPROXIMATE_PLACE_DETAIL_MISSING_RATE_HPP

#include <sivid/approximate/fit/detail/campaign.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
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
    double walk = 1; ///< of its change within a second
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

} // namespace sivid

#endif
