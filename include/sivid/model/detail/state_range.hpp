// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_DETAIL_STATE_RANGE_HPP
#define SIVID_MODEL_DETAIL_STATE_RANGE_HPP

#include <sivid/number/interval_traits.hpp>

#include <algorithm>

namespace sivid {

/// A state's own range: `8` for \f$ |x| \le 8 \f$, `{0, 5}` for a quantity such as a concentration.
///   It says where an experiment may start that does not say so itself, and how large the state
///   is. It says nothing of motions: those of the model may leave it, and are followed there. Where
///   a proof needs more (`relations` of a diagnosis), what follows from it stands among the
///   assumptions in numbers.
struct state_range {
    double lower = 0, upper = 0;

    constexpr state_range() = default;
    constexpr state_range(double limit) : lower(-limit), upper(limit) {}
    constexpr state_range(double low, double high) : lower(low), upper(high) {}

    /// How large the state is, a scale.
    constexpr operator double() const { return std::max(-lower, upper); }
    [[nodiscard]] interval range() const { return interval_traits<interval>::bounds(lower, upper); }
};

} // namespace sivid

#endif
