// SPDX-License-Identifier: MIT
#ifndef SIVID_MEASUREMENT_ERROR_BOUND_HPP
#define SIVID_MEASUREMENT_ERROR_BOUND_HPP

#include <sivid/measurement/quantisation.hpp>
#include <sivid/number/text/nearest_text.hpp>
#include <sivid/number/text/needed_given.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

namespace detail {
/// The median; 0 of nothing.
inline double median(std::vector<double> values) {
    if (values.empty()) return 0;
    auto const middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Residuals of samples against the polynomial that fits them and their neighbours on either side
/// best, divided by sqrt(1 - leverage). Samples can be left out: they have no residual then, and do
/// not enter the fits of others.
/// @tparam Half    neighbours on either side
/// @tparam Degree  of the polynomial
template <std::size_t Half, std::size_t Degree>
class local_polynomial {
public:
    static constexpr std::size_t half = Half;

    /// @param stride  only every so manieth neighbour counts
    /// @param out     samples that are left out from the beginning; empty: none
    local_polynomial(std::vector<double> const& times, std::vector<double> const& values,
                     std::size_t stride = 1, std::vector<bool> out = {})
        : times_{&times},
          values_{&values},
          reach_{half * stride},
          stride_{stride},
          out_(std::move(out)),
          residual_(times.size(), none) {
        out_.resize(times.size(), false);
        std::vector<double> spans;
        for (std::size_t k = reach_; k + reach_ < times_->size(); ++k) spans.push_back(span(k));
        widest_ = 2 * median(spans);
        for (std::size_t k = 0; k < times_->size(); ++k) update(k);
    }

    /// One for each sample; NaN where there is none.
    [[nodiscard]] std::vector<double> const& residuals() const { return residual_; }
    [[nodiscard]] std::vector<bool> const& out() const { return out_; }
    /// 1.4826 median |e|.
    [[nodiscard]] double spread() const { return 1.4826 * median(sizes()); }
    [[nodiscard]] double largest() const {
        auto const all = sizes();
        return all.empty() ? 0 : *std::max_element(all.begin(), all.end());
    }
    [[nodiscard]] std::size_t support() const { return sizes().size(); }
    [[nodiscard]] std::size_t left_out() const {
        return static_cast<std::size_t>(std::count(out_.begin(), out_.end(), true));
    }

    /// Leaves out the samples whose residual passes the limit and is the largest of its
    /// neighbourhood.
    /// @returns how many
    std::size_t leave_out_farthest(double limit) {
        std::vector<std::size_t> found;
        for (std::size_t k = 0; k < times_->size(); ++k) {
            double const e = std::abs(residual_[k]);
            if (!(e > limit)) continue; // not those without a residual
            bool first = true;
            for (auto j = from(k); j < to(k); ++j)
                if (std::abs(residual_[j]) > e || (j < k && std::abs(residual_[j]) == e))
                    first = false;
            if (first) found.push_back(k);
        }
        for (auto const k : found) out_[k] = true;
        for (auto const k : found)
            for (auto j = from(k); j < to(k); ++j) update(j);
        return found.size();
    }

private:
    static constexpr double none = std::numeric_limits<double>::quiet_NaN();

    [[nodiscard]] std::size_t from(std::size_t k) const { return k < reach_ ? 0 : k - reach_; }
    [[nodiscard]] std::size_t to(std::size_t k) const {
        return std::min(k + reach_ + 1, times_->size());
    }
    [[nodiscard]] double span(std::size_t k) const {
        return (*times_)[k + reach_] - (*times_)[k - reach_];
    }

    [[nodiscard]] std::vector<double> sizes() const {
        std::vector<double> result;
        for (double const e : residual_)
            if (!std::isnan(e)) result.push_back(std::abs(e));
        return result;
    }

    /// Fits the window of sample k by orthogonal polynomials of the local time.
    void update(std::size_t k) {
        residual_[k] = none;
        if (out_[k] || k < reach_ || k + reach_ >= times_->size() || span(k) > widest_) return;
        std::array<double, 2 * half + 1> s{}, y{};
        std::size_t n = 0, centre = 0;
        for (auto j = k - reach_; j <= k + reach_; j += stride_) {
            if (out_[j]) continue;
            if (j == k) centre = n;
            s[n] = ((*times_)[j] - (*times_)[k]) / span(k);
            y[n++] = (*values_)[j] - (*values_)[k];
        }
        if (n < Degree + 3) return; // the coefficients need some samples to spare
        double fitted = 0, leverage = 0;
        std::array<std::array<double, 2 * half + 1>, Degree + 1> basis{};
        for (std::size_t d = 0; d <= Degree; ++d) {
            auto& b = basis[d];
            for (std::size_t i = 0; i < n; ++i) b[i] = d == 0 ? 1 : s[i] * basis[d - 1][i];
            for (std::size_t c = 0; c < d; ++c) {
                double const share = product(b, basis[c], n);
                for (std::size_t i = 0; i < n; ++i) b[i] -= share * basis[c][i];
            }
            double const norm = std::sqrt(product(b, b, n));
            if (!(norm > 1e-12)) return;
            for (std::size_t i = 0; i < n; ++i) b[i] /= norm;
            fitted += product(b, y, n) * b[centre];
            leverage += b[centre] * b[centre];
        }
        if (leverage > 0.9) return; // the sample would be fitted by itself
        double const e = (y[centre] - fitted) / std::sqrt(1 - leverage);
        if (std::isfinite(e)) residual_[k] = e;
    }
    static double product(std::array<double, 2 * half + 1> const& a,
                          std::array<double, 2 * half + 1> const& b, std::size_t n) {
        double sum = 0;
        for (std::size_t i = 0; i < n; ++i) sum += a[i] * b[i];
        return sum;
    }

    std::vector<double> const* times_;
    std::vector<double> const* values_;
    std::size_t reach_, stride_;
    std::vector<bool> out_;
    std::vector<double> residual_;
    double widest_ = 0;
};

/// A quadratic through the three neighbours on either side: what a bound is proposed from.
using local_residuals = local_polynomial<3, 2>;

/// What fits that overlap leave of independent errors on an even grid: correlations of the
/// residuals one to six samples apart, of the filter (2, -3, -6, 14, -6, -3, 2) / 21.
inline constexpr std::array<double, 7> independent_correlation{
    1, -144.0 / 294, -72.0 / 294, 92.0 / 294, -15.0 / 294, -12.0 / 294, 4.0 / 294};

/// Residuals in spreads, cut at three, so that a few kinks do not count.
/// @param spread  above 0
[[nodiscard]] inline std::vector<double> cut_residuals(std::vector<double> residuals,
                                                       double spread) {
    for (double& e : residuals) e = std::clamp(e / spread, -3.0, 3.0); // NaN stays
    return residuals;
}
/// Of those that are so many samples apart, 0 for the square.
[[nodiscard]] inline double mean_product(std::vector<double> const& e, std::size_t apart) {
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = apart; i < e.size(); ++i) {
        if (std::isnan(e[i]) || std::isnan(e[i - apart])) continue;
        sum += e[i] * e[i - apart];
        ++count;
    }
    return count > 0 ? sum / static_cast<double>(count) : 0;
}

/// How far residuals are from those of independent errors.
struct dependence_of_residuals {
    double square = 0;   ///< mean square, of residuals that are cut
    double excess = 0;   ///< the largest difference of a correlation from `independent_correlation`
    std::size_t lag = 1; ///< where it is
    double measured = 0; ///< the correlation there

    /// @param stride  of the fits
    dependence_of_residuals(std::vector<double> const& residuals, double spread,
                            std::size_t stride) {
        if (!(spread > 0)) return;
        auto const e = cut_residuals(residuals, spread);
        double const own = mean_product(e, 0);
        square = own * spread * spread;
        if (!(own > 0)) return;
        for (std::size_t k = 1; k < independent_correlation.size(); ++k) {
            double const here = mean_product(e, k * stride) / own;
            if (!(std::abs(here - independent_correlation[k]) > excess)) continue;
            excess = std::abs(here - independent_correlation[k]);
            lag = k;
            measured = here;
        }
    }
};
} // namespace detail

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
/// A bound is so many times the largest residual, or so many standard deviations.
inline constexpr double proposed_margin = 1.25, proposed_sigmas = 4;

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

/// @throws std::invalid_argument
inline void require_readings(std::vector<double> const& times, std::vector<double> const& values) {
    if (times.size() != values.size())
        throw std::invalid_argument("propose_error_bound: needs as many values as times" +
                                    needed_given(times.size(), values.size()));
    for (std::size_t i = 0; i < times.size(); ++i)
        if (!std::isfinite(times[i]) || !std::isfinite(values[i]) ||
            (i > 0 && !(times[i - 1] < times[i])))
            throw std::invalid_argument(
                "propose_error_bound: needs finite values at increasing times");
}

/// Of residuals that are not those of independent errors: what they may be, and what is left to do.
/// @param as_motion  the bound, if all that a freer curve follows is motion
[[nodiscard]] inline std::string refusal_for(std::string const& doubt,
                                             error_bound_proposal const& found, double as_motion) {
    return doubt +
           ": motion that the samples do not resolve, or errors that last longer than a sample; "
           "as errors they ask for a bound of at least " +
           sivid::nearest_text(found.bound, 3) +
           (as_motion < 0.5 * found.spread * proposed_sigmas
                ? ", as motion they hide errors of about " + sivid::nearest_text(as_motion, 3)
                : std::string{", as motion they hide errors of any size below"}) +
           "; take the bound from the data sheet, or from a record at rest";
}

/// What a proposal rests on.
[[nodiscard]] inline std::vector<std::string> assumptions_of(error_bound_proposal const& found) {
    std::vector<std::string> result{
        "the error has no part that is slower than seven samples: no offset, drift or wrong scale",
        found.support < 200 ? "errors of neighbouring samples are independent: so few samples "
                              "would hardly show if they were not"
                            : "errors of neighbouring samples are independent: the residuals are "
                              "not those of errors that last",
        "the largest error of the record is at most 1.25 times the largest residual that counts, "
        "or four standard deviations",
        found.quantum > 0
            ? "readings are rounded or truncated to the step that was found: at most one step"
            : "no step was found: the readings are not quantised"};
    if (found.outliers > 0)
        result.push_back("the samples that were left out are outliers: the bound does not hold "
                         "for them, allow for their share");
    double const by_spread = proposed_sigmas * found.spread;
    if (proposed_margin * found.largest_residual > 1.5 * std::max(by_spread, found.quantum))
        result.push_back(
            "the few samples farthest from their neighbours are errors of the instrument: they set "
            "the bound; step and four standard deviations alone make " +
            sivid::nearest_text(found.quantum + by_spread, 3) +
            ", so state a bound if they are kinks of the motion, as where an input jumps");
    if (found.correlation > 0.2 + 3 / std::sqrt(static_cast<double>(found.support)) &&
        found.spread > explained_steps * found.quantum)
        result.push_back(
            "neighbouring residuals are somewhat correlated, by " +
            sivid::nearest_text(found.correlation, 2) +
            ": that much of their square is motion that the samples do not resolve, or errors "
            "that last longer than a sample");
    return result;
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
    constexpr double far = 6;
    detail::require_readings(times, values);

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
    result.bound = result.quantum + std::max(detail::proposed_margin * result.largest_residual,
                                             detail::proposed_sigmas * result.spread);
    if (!(result.bound > 0) || !std::isfinite(result.bound)) {
        result.bound = 0;
        return refuse("the readings have neither a step nor residuals");
    }
    auto doubt = detail::doubt_of(fit, times, values, result);
    if (scattered) doubt = "more than 5 % of the samples are far from their neighbours";
    if (!doubt.empty()) {
        // Motion leaves less the more freely the curve through the neighbours bends.
        detail::local_polynomial<6, 8> const free{times, values, 1, fit.out()};
        auto why = detail::refusal_for(doubt, result,
                                       result.quantum + detail::proposed_sigmas * free.spread());
        result.bound = 0;
        return refuse(std::move(why));
    }
    result.assumptions = detail::assumptions_of(result);
    return result;
}

} // namespace sivid

#endif
