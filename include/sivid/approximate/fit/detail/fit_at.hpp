// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_FIT_DETAIL_FIT_AT_HPP
#define SIVID_APPROXIMATE_FIT_DETAIL_FIT_AT_HPP

#include <sivid/approximate/approximate_fit.hpp>
#include <sivid/approximate/fit/detail/campaign.hpp>
#include <sivid/approximate/fit/detail/descent.hpp>

#include <cmath>
#include <cstddef>
#include <utility>

namespace sivid {

/// Share of the descents' tolerances with which their results are simulated.
inline constexpr double judged_accuracy = 1e-3;

/// What a descent came to, by its own simulation; only infinite figures where it came to nothing.
[[nodiscard]] inline approximate_fit as_descended(campaign const& c, descent_point here) {
    approximate_fit result;
    if (!std::isfinite(here.inflation)) return result;
    result.inflation = inflation_of(here.residuals, c.outliers());
    result.parameters = c.parameters(here.at);
    for (std::size_t e = 0; e < c.experiments(); ++e) {
        result.starts.push_back(c.start(e, here.at));
    }
    result.residuals = std::move(here.residuals);
    return result;
}

/// The same, simulated once more with care.
[[nodiscard]] inline approximate_fit fit_at(campaign& c, descent_point here) {
    if (!std::isfinite(here.inflation)) return {};
    c.set_accuracy(judged_accuracy);
    residual_lists fine;
    if (c.residuals(here.at, fine)) here.residuals = std::move(fine);
    c.set_accuracy(1);
    return as_descended(c, std::move(here));
}

} // namespace sivid

#endif
