// SPDX-License-Identifier: MIT
#ifndef SIVID_MEASUREMENT_ERROR_BOUND_HPP
#define SIVID_MEASUREMENT_ERROR_BOUND_HPP

#include <sivid/measurement/detail/local_residual.hpp>
#include <sivid/measurement/quantisation.hpp>
#include <sivid/number/nearest_text.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace sivid {

/// What a record says about the error bound of its own instrument. A proposal, not a proof: what it
/// rests on stands in `assumptions`.
struct error_bound_proposal {
    double bound = 0;            ///< 0: none can be proposed, see `refusal`
    double quantum = 0;          ///< step of the readings; 0: none found
    double spread = 0;           ///< robust standard deviation of the noise
    double largest_residual = 0; ///< of the samples that count
    std::size_t support = 0;     ///< samples that count
    std::size_t outliers = 0;    ///< samples left out, too far from their neighbours
    std::string refusal;         ///< why no bound is proposed
    std::vector<std::string> assumptions;
};

/// Proposes an error bound from the quantisation step q of the readings and from their residuals
/// e against a quadratic through the three neighbours on either side:
///   \f$ q + \max(1.25 \max |e|, 4 \sigma) \f$,  \f$ \sigma \f$ = 1.4826 median |e|
/// The residual of a sample is divided by \f$ \sqrt{1 - h} \f$, h its leverage, so that white noise
/// keeps its standard deviation. Residuals beyond 6 sigma + 2 q are outliers, and no neighbour is
/// judged by them; when they are more than 5 % of all samples the motion is not resolved, and all
/// count. Windows across gaps (wider than twice the usual) and the three samples at either end do
/// not count.
/// @given  as many values as times, finite, times strictly increasing (checked)
/// @guarantee  none for the instrument: an offset, a drift, a wrong scale and noise slower than
///             seven samples leave no residual; motion that these do not resolve raises the bound
/// @throws std::invalid_argument
/// @cost  n log n
[[nodiscard]] inline error_bound_proposal propose_error_bound(std::vector<double> const& times,
                                                              std::vector<double> const& values) {
    constexpr std::size_t least_support = 20;
    constexpr double margin = 1.25, sigmas = 4, far = 6;
    if (times.size() != values.size())
        throw std::invalid_argument("propose_error_bound: needs as many values as times");
    for (std::size_t i = 0; i < times.size(); ++i)
        if (!std::isfinite(times[i]) || !std::isfinite(values[i]) ||
            (i > 0 && !(times[i - 1] < times[i])))
            throw std::invalid_argument(
                "propose_error_bound: needs finite values at increasing times");

    error_bound_proposal result;
    auto const refuse = [&](std::string why) {
        result.refusal = std::move(why);
        return result;
    };
    if (distinct_count(values, 3) < 3)
        return refuse("fewer than three different readings say nothing about the instrument");
    result.quantum = quantisation_step(values);

    // Outliers one neighbourhood at a time: the farthest first, since it spoils its neighbours'.
    detail::local_residuals fit{times, values};
    for (int round = 0; round < 50; ++round) {
        result.spread = fit.spread();
        if (fit.leave_out_farthest(far * result.spread + 2 * result.quantum) == 0) break;
    }
    bool const unresolved = 20 * fit.left_out() > times.size();
    if (unresolved)
        fit = detail::local_residuals{times, values}; // these are no outliers: all count
    result.outliers = fit.left_out();
    result.support = fit.support();
    if (result.support < least_support)
        return refuse("only " + std::to_string(result.support) +
                      " samples have three neighbours on either side without a gap; at least " +
                      std::to_string(least_support) + " are needed");
    result.spread = fit.spread();
    result.largest_residual = fit.largest();
    result.bound =
        result.quantum + std::max(margin * result.largest_residual, sigmas * result.spread);
    if (!(result.bound > 0) || !std::isfinite(result.bound))
        return refuse("the readings have neither a step nor residuals");
    result.assumptions = {
        "the error has no part that is slower than seven samples: no offset, drift or wrong scale",
        "errors of neighbouring samples are independent",
        "the largest error of the record is at most 1.25 times the largest residual that counts, "
        "or four standard deviations",
        result.quantum > 0
            ? "readings are rounded or truncated to the step that was found: at most one step"
            : "no step was found: the readings are not quantised"};
    if (result.outliers > 0)
        result.assumptions.push_back("the samples that were left out are outliers: the bound does "
                                     "not hold for them, allow for their share");
    double const usual = std::max(sigmas * result.spread, result.quantum);
    if (!unresolved && margin * result.largest_residual > 1.5 * usual) {
        result.assumptions.push_back(
            "the few samples farthest from their neighbours are errors of the instrument: they set "
            "the bound; step and four standard deviations alone make " +
            nearest_text(result.quantum + sigmas * result.spread, 3) +
            ", so state a bound if they are kinks of the motion, as where an input jumps");
    }
    if (unresolved)
        result.assumptions.push_back(
            "more than 5 % of the samples are far from their neighbours: motion that the samples "
            "do not resolve, or noise of another kind; all count, and the bound is that much "
            "larger");
    return result;
}

} // namespace sivid

#endif
