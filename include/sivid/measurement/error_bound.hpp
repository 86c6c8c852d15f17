// SPDX-License-Identifier: MIT
#ifndef SIVID_MEASUREMENT_ERROR_BOUND_HPP
#define SIVID_MEASUREMENT_ERROR_BOUND_HPP

#include <sivid/measurement/detail/local_residual.hpp>
#include <sivid/measurement/quantisation.hpp>
#include <sivid/number/text/nearest_text.hpp>
#include <sivid/number/text/needed_given.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
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
    /// By how much the correlation of neighbouring residuals differs at most from what independent
    /// errors leave: about the share of the residuals' square that is not such errors.
    double correlation = 0;
    std::string refusal; ///< why no bound is proposed
    std::vector<std::string> assumptions;
};

namespace detail {

/// Residuals whose spread is below so many steps are those of rounding, correlated as they are.
inline constexpr double explained_steps = 0.6;

/// Why residuals are not those of independent errors, in words; nothing if they may be. Notes their
/// correlation.
[[nodiscard]] inline std::string doubt_of(local_residuals const& fit,
                                          std::vector<double> const& times,
                                          std::vector<double> const& values,
                                          error_bound_proposal& of) {
    if (!(of.spread > explained_steps * of.quantum)) return {};
    double const chance = 1 / std::sqrt(static_cast<double>(of.support));
    dependence_of_residuals const own(fit.residuals(), of.spread, 1);
    of.correlation = own.excess;
    // Motion: residuals follow each other, or come back after a period.
    if (own.excess > 0.35 + 3 * chance) {
        return "the residuals of samples " + std::to_string(own.lag) +
               (own.lag == 1 ? " step" : " steps") + " apart are correlated by " +
               sivid::nearest_text(own.measured, 2) + ", where independent errors leave " +
               sivid::nearest_text(independent_correlation[own.lag], 2);
    }
    // Errors that last: of fewer samples the residuals are larger, yet no more correlated, as those
    // of motion would be.
    for (std::size_t const stride : {std::size_t{2}, std::size_t{4}}) {
        local_residuals const fewer{times, values, stride, fit.out()};
        if (fewer.support() < 20) break;
        dependence_of_residuals const then(fewer.residuals(), fewer.spread(), stride);
        double const growth = then.square / own.square;
        if (!(growth > 1 + std::max(0.4, 8 * chance))) continue;
        if (then.excess > 0.5 * (1 - 1 / growth)) continue;
        return "the residuals of every " + std::string{stride == 2 ? "2nd" : "4th"} +
               " sample are " + sivid::nearest_text(std::sqrt(growth), 3) +
               " times as large, without the correlation of a motion";
    }
    return {};
}

} // namespace detail

/// Proposes an error bound from the quantisation step q of the readings and from their residuals
/// e against a quadratic through the three neighbours on either side:
///   \f$ q + \max(1.25 \max |e|, 4 \sigma) \f$,  \f$ \sigma \f$ = 1.4826 median |e|
/// The residual of a sample is divided by \f$ \sqrt{1 - h} \f$, h its leverage, so that white noise
/// keeps its standard deviation. Residuals beyond 6 sigma + 2 q are outliers, and no neighbour is
/// judged by them. Windows across gaps (wider than twice the usual) and the three samples at either
/// end do not count.
///   No bound is proposed where the residuals are not those of independent errors: they are motion
/// that the samples do not resolve, which would make the bound so large that a wrong model passes,
/// or errors that last for several samples, of which the residuals show only a part. That is where
/// more than 5 % of the samples are outliers, or where the correlation of neighbours differs from
/// that of independent errors by more than 0.35 + 3/sqrt(n), or where every second or fourth sample
/// alone leaves larger residuals that are no smoother; unless the step q explains the residuals.
/// Which of the two it is, the record cannot always tell: the refusal says both figures.
/// @given  as many values as times, finite, times strictly increasing (checked)
/// @guarantee  none for the instrument: an offset, a drift, a wrong scale and noise slower than
///             seven samples leave no residual
/// @throws std::invalid_argument
/// @cost  n log n
[[nodiscard]] inline error_bound_proposal propose_error_bound(std::vector<double> const& times,
                                                              std::vector<double> const& values) {
    constexpr std::size_t least_support = 20;
    constexpr double margin = 1.25, sigmas = 4, far = 6;
    if (times.size() != values.size())
        throw std::invalid_argument("propose_error_bound: needs as many values as times" +
                                    needed_given(times.size(), values.size()));
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
    bool const scattered = 20 * fit.left_out() > times.size();
    if (scattered) fit = detail::local_residuals{times, values}; // these are no outliers: all count
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
    if (!(result.bound > 0) || !std::isfinite(result.bound)) {
        result.bound = 0;
        return refuse("the readings have neither a step nor residuals");
    }
    auto const doubt = detail::doubt_of(fit, times, values, result);
    if (scattered || !doubt.empty()) {
        // Motion leaves less the more freely the curve through the neighbours bends.
        detail::local_polynomial<6, 8> const free{times, values, 1, fit.out()};
        auto const either = sivid::nearest_text(result.bound, 3);
        double const own = result.quantum + sigmas * free.spread();
        result.bound = 0;
        return refuse(
            (scattered ? std::string{"more than 5 % of the samples are far from their neighbours"}
                       : doubt) +
            ": motion that the samples do not resolve, or errors that last longer than a sample; "
            "as errors they ask for a bound of at least " +
            either +
            (own < 0.5 * result.spread * sigmas
                 ? ", as motion they hide errors of about " + sivid::nearest_text(own, 3)
                 : std::string{", as motion they hide errors of any size below"}) +
            "; take the bound from the data sheet, or from a record at rest");
    }
    result.assumptions = {
        "the error has no part that is slower than seven samples: no offset, drift or wrong scale",
        result.support < 200 ? "errors of neighbouring samples are independent: so few samples "
                               "would hardly show if they were not"
                             : "errors of neighbouring samples are independent: the residuals are "
                               "not those of errors that last",
        "the largest error of the record is at most 1.25 times the largest residual that counts, "
        "or four standard deviations",
        result.quantum > 0
            ? "readings are rounded or truncated to the step that was found: at most one step"
            : "no step was found: the readings are not quantised"};
    if (result.outliers > 0)
        result.assumptions.push_back("the samples that were left out are outliers: the bound does "
                                     "not hold for them, allow for their share");
    double const usual = std::max(sigmas * result.spread, result.quantum);
    if (margin * result.largest_residual > 1.5 * usual) {
        result.assumptions.push_back(
            "the few samples farthest from their neighbours are errors of the instrument: they set "
            "the bound; step and four standard deviations alone make " +
            sivid::nearest_text(result.quantum + sigmas * result.spread, 3) +
            ", so state a bound if they are kinks of the motion, as where an input jumps");
    }
    if (result.correlation > 0.2 + 3 / std::sqrt(static_cast<double>(result.support)) &&
        result.spread > detail::explained_steps * result.quantum)
        result.assumptions.push_back(
            "neighbouring residuals are somewhat correlated, by " +
            sivid::nearest_text(result.correlation, 2) +
            ": that much of their square is motion that the samples do not resolve, or errors "
            "that last longer than a sample");
    return result;
}

} // namespace sivid

#endif
