// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_TABLE_DETAIL_WRAPPED_READING_HPP
#define SIVID_IMPORTING_TABLE_DETAIL_WRAPPED_READING_HPP

#include <sivid/io/text/exact_decimal.hpp>

#include <cmath>
#include <cstddef>
#include <utility>

namespace sivid {

/// Follows readings modulo a period, such as a heading between -180 and 180 degrees, beyond the
/// ends of their range: the first one stands, from one to the next it has gone the shorter way.
/// That is right as long as it moves by less than half a period; more than a quarter is reported as
/// doubtful, and half of it, but for roundings, cannot be decided.
class wrapped_reading {
public:
    struct step {
        bool possible = false; ///< false: half a period from the one before, or far too large
        bool wrapped = false;  ///< through an end of the range
        bool doubtful = false; ///< by more than a quarter of a period
        /// With all turns since the first reading, for every period of the interval.
        exact_decimal lower, upper;
    };

    /// @given  0 < lower <= upper, finite as doubles (trusted)
    wrapped_reading(exact_decimal lower, exact_decimal upper)
        : lower_(std::move(lower)),
          upper_(std::move(upper)),
          period_((*nearest(lower_) + *nearest(upper_)) / 2) {}

    /// The next reading. One that is not possible changes nothing.
    /// @given  a reading within the range of double (trusted)
    step operator()(exact_decimal const& raw) {
        constexpr double most_turns = 1e15, most_periods = 1e6, margin = 1e-9;
        double const now = *nearest(raw); // good to far less than the margin, see most_periods
        double const way = started_ ? now - last_ : 0;
        double const turns = turns_ - std::round(way / period_);
        double const moved = std::abs(std::remainder(way, period_)) / period_;
        if (!(std::abs(turns) < most_turns) || !(std::abs(now) < most_periods * period_) ||
            !(moved < 0.5 - margin))
            return {};
        step result{true, turns != turns_, moved > 0.25, raw, raw};
        if (turns != 0) {
            auto const count = static_cast<std::size_t>(std::abs(turns));
            auto const least = lower_.times(count), most = upper_.times(count);
            result.lower = turns > 0 ? raw + least : raw - most;
            result.upper = turns > 0 ? raw + most : raw - least;
        }
        started_ = true;
        last_ = now;
        turns_ = turns;
        return result;
    }

private:
    exact_decimal lower_, upper_;
    double period_;
    bool started_ = false;
    double last_ = 0, turns_ = 0;
};

} // namespace sivid

#endif
