// SPDX-License-Identifier: MIT
#ifndef SIVID_MEASUREMENT_DETAIL_LOCAL_RESIDUAL_HPP
#define SIVID_MEASUREMENT_DETAIL_LOCAL_RESIDUAL_HPP

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace sivid::detail {

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

} // namespace sivid::detail

#endif
