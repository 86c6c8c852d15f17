// SPDX-License-Identifier: MIT
#ifndef SIVID_MEASUREMENT_DEAD_TIME_HPP
#define SIVID_MEASUREMENT_DEAD_TIME_HPP

#include <algorithm>
#include <limits>

namespace sivid {

/// How late a signal is: by a delay, and by a share of the time since the begin, since its clock
/// runs slow. Before the begin it stands still.
struct dead_time {
    double delay = 0; ///< in the model's unit of time, at least 0
    double drift = 0; ///< a share, at least 0; from 1 on the clock stands, and nothing new is seen

    [[nodiscard]] bool any() const { return delay > 0 || drift > 0; }
    /// When what is seen at t happened, in doubles.
    [[nodiscard]] double source(double t, double begin) const {
        return std::max(begin, t - delay - drift * (t - begin));
    }
    /// When what happens at s is seen, in doubles; infinite: never.
    [[nodiscard]] double seen(double s, double begin) const {
        if (drift >= 1) return std::numeric_limits<double>::infinity();
        return drift > 0 ? begin + (s - begin + delay) / (1 - drift) : s + delay;
    }
    bool operator==(dead_time const&) const = default;
};

} // namespace sivid

#endif
