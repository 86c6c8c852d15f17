// SPDX-License-Identifier: MIT
#ifndef SIVID_MEASUREMENT_LIMITED_SIGNAL_HPP
#define SIVID_MEASUREMENT_LIMITED_SIGNAL_HPP

#include <sivid/compiled.hpp>
#include <sivid/measurement/signal.hpp>
#include <sivid/number/interval.hpp>

#include <vector>

namespace sivid {

/// A recorded input behind a rate limit, as what a model sees.
struct limited_signal {
    sampled_signal within; ///< straight lines; contains it, for every limit in the interval
    /// The slope of the value by the limit, at the middle of the limits, at the begin of each piece
    /// of `within`, and by how much it changes per second.
    std::vector<double> slope_by_limit, slope_change;
};

/// A recorded input behind a rate limit R (a servo of full speed R): y begins at u, follows it as
/// fast as it can, and is u where it has caught up,
///     \f$ y' = R\,\mathrm{sign}(u - y) \f$ while y differs from u, else u' within [-R, R].
///   On a straight piece of u this is a straight line, then perhaps u: a knot is put in between.
/// y grows with u and moves along with it, so \f$ |y[u] - y[v]| \le \sup |u - v| \f$ over the past.
/// Two limits part by their difference a second at most: whichever is ahead, the other one goes on
/// towards it or it comes back. Where u moves more slowly than R, both come together again.
/// @param limit  R in units of u per second, above 0
/// @guarantee  for every R in the interval, and every input within the bounds of u that has limits
///             from both sides, y lies within the result from `begin` to `end`
/// @cost  linear in the samples; up to three times as many
/// @throws std::invalid_argument  for a limit that is not above 0
[[nodiscard]] SIVID_DECL limited_signal rate_limited(sampled_signal const& u, double begin,
                                                     double end, interval const& limit);

/// The same with the limit as a parameter.
struct limited_line {
    sampled_signal about;    ///< straight lines with error bounds
    sampled_signal by_limit; ///< straight lines
};

/// A recorded input behind a rate limit R as a line in R, about the middle of the limits R_0:
///     \f$ y_R(t) \in about(t) + by\_limit(t) (R - R_0). \f$
/// Where y is further from u than any limit is off, all limits go the same way, and what they are
/// from the line stays as it is. About the times at which y meets u it is all that they are off;
/// where u is too fast and y turns there, the rest is of second order in the width of the limits.
/// @given, guarantee, cost, throws  as for `rate_limited`
[[nodiscard]] SIVID_DECL limited_line rate_limited_line(sampled_signal const& u, double begin,
                                                        double end, interval const& limit);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/measurement/impl/limited_signal.ipp>
#endif

#endif
