// SPDX-License-Identifier: MIT
#ifndef SIVID_MEASUREMENT_DETAIL_WIDENED_SIGNAL_HPP
#define SIVID_MEASUREMENT_DETAIL_WIDENED_SIGNAL_HPP

#include <sivid/measurement/signal.hpp>
#include <sivid/number/interval.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace sivid::measurement_detail {

/// Collects the knots of a signal with errors.
class widened_signal {
public:
    explicit widened_signal(interpolation kind) : kind_(kind) {}
    /// @param value  its middle is taken, its radius joins the error
    void add(double time, interval const& value, double error) {
        double const middle = mid(value);
        double const far = std::max(value.upper() - middle, middle - value.lower());
        // One more rounding for each sum.
        double const all = (error + far) * (1 + 4 * std::numeric_limits<double>::epsilon());
        times_.push_back(time);
        values_.push_back(middle);
        errors_.push_back(all > 0 ? all + std::numeric_limits<double>::min() : 0.0);
    }
    [[nodiscard]] sampled_signal take() && {
        return sampled_signal(std::move(times_), std::move(values_), kind_, std::move(errors_));
    }

private:
    interpolation kind_;
    std::vector<double> times_, values_, errors_;
};

/// Times in increasing order from `begin` until, at least, `end`.
inline std::vector<double> grid_of(std::vector<double> times, double begin, double end) {
    times.push_back(begin);
    times.push_back(std::max(end, std::nextafter(begin, HUGE_VAL)));
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    times.erase(times.begin(), std::lower_bound(times.begin(), times.end(), begin));
    return times;
}

} // namespace sivid::measurement_detail

#endif
