// SPDX-License-Identifier: MIT
#ifndef SIVID_MEASUREMENT_PLAYED_SIGNAL_HPP
#define SIVID_MEASUREMENT_PLAYED_SIGNAL_HPP

#include <sivid/compiled.hpp>
#include <sivid/measurement/signal.hpp>
#include <sivid/number/interval.hpp>

#include <vector>

namespace sivid {

/// A recorded input behind a play, as what a model sees.
struct played_signal {
    sampled_signal within; ///< contains it, for every half-width in the interval
    /// The slope of the value by the half-width, for each piece of `within`, at the middle of the
    /// half-widths: -1 where it followed upwards last, 1 downwards, 0 where it never moved.
    std::vector<double> slope_by_width;
};

/// A recorded input behind a play (backlash): p begins at u, and moves only where u pushes it,
///     \f$ p(t) = \max(u(t) - b, \min(u(t) + b, p(t^-))) \f$ while u goes one way.
///   On a straight piece of u this is constant, then straight: a knot is put in between. Both u and
/// b move p by no more than themselves: \f$ |p_b[u] - p_c[v]| \le \max(|b - c|, \sup |u - v|) \f$,
/// the supremum over the past, since a maximum and a minimum move no more than their arguments.
/// @param half_width  b: half of the gap, 0 or more
/// @guarantee  for every b in the interval, and every input within the bounds of u that has limits
///             from both sides, p lies within the result from `begin` to `end`
/// @cost  linear in the samples; up to twice as many
[[nodiscard]] SIVID_DECL played_signal played(sampled_signal const& u, double begin, double end,
                                              interval const& half_width);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/measurement/impl/played_signal.ipp>
#endif

#endif
