// SPDX-License-Identifier: MIT
#ifndef SIVID_MEASUREMENT_DETAIL_LOCAL_RESIDUAL_HPP
#define SIVID_MEASUREMENT_DETAIL_LOCAL_RESIDUAL_HPP

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace sivid::detail {

/// The median; 0 of nothing.
inline double median(std::vector<double> values) {
    if (values.empty()) return 0;
    auto const middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Residuals of samples against the quadratic that fits them and their three neighbours on either
/// side best, divided by sqrt(1 - leverage). Samples can be left out: they have no residual then,
/// and do not enter the fits of others.
class local_residuals {
public:
    static constexpr std::size_t half = 3;

    local_residuals(std::vector<double> const& times, std::vector<double> const& values)
        : times_{&times},
          values_{&values},
          out_(times.size(), false),
          residual_(times.size(), none) {
        std::vector<double> spans;
        for (std::size_t k = half; k + half < times_->size(); ++k) spans.push_back(span(k));
        widest_ = 2 * median(spans);
        for (std::size_t k = 0; k < times_->size(); ++k) update(k);
    }

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

    [[nodiscard]] std::size_t from(std::size_t k) const { return k < half ? 0 : k - half; }
    [[nodiscard]] std::size_t to(std::size_t k) const {
        return std::min(k + half + 1, times_->size());
    }
    [[nodiscard]] double span(std::size_t k) const {
        return (*times_)[k + half] - (*times_)[k - half];
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
        if (out_[k] || k < half || k + half >= times_->size() || span(k) > widest_) return;
        std::array<double, 2 * half + 1> s{}, y{};
        std::size_t n = 0, centre = 0;
        for (auto j = k - half; j <= k + half; ++j) {
            if (out_[j]) continue;
            if (j == k) centre = n;
            s[n] = ((*times_)[j] - (*times_)[k]) / span(k);
            y[n++] = (*values_)[j] - (*values_)[k];
        }
        if (n < 5) return; // three coefficients need some samples to spare
        double fitted = 0, leverage = 0;
        std::array<std::array<double, 2 * half + 1>, 3> basis{};
        for (std::size_t d = 0; d < 3; ++d) {
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
    std::vector<bool> out_;
    std::vector<double> residual_;
    double widest_ = 0;
};

} // namespace sivid::detail

#endif
