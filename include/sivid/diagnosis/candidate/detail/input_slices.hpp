// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CANDIDATE_DETAIL_INPUT_SLICES_HPP
#define SIVID_DIAGNOSIS_CANDIDATE_DETAIL_INPUT_SLICES_HPP

#include <sivid/compiled.hpp>
#include <sivid/diagnosis/candidate/resolve_memory.hpp>
#include <sivid/measurement/signal.hpp>
#include <sivid/model/model.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/number/interval.hpp>
#include <sivid/number/interval_traits.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>

namespace sivid {

/// A recorded input after a first-order lag, for every time constant up to the longest, as an input
/// with error bounds: no differential equation, and none that is singular at 0.
///   With d' = (u - d)/tau the difference g = d - u obeys g' = -g/tau - u', so on a piece of slope
///   m
///     \f$ |g(t)| \le |g_k| e^{-(t-t_k)/\tau} + |m| \tau (1 - e^{-(t-t_k)/\tau}), \f$
/// which grows with tau; where u jumps, |g| grows by the jump at most. Errors of the samples pass
/// the lag with their largest value so far.
/// @param begin    where d = u, or 0 when it rests
/// @param end      of what is asked for, at least `begin`
/// @param longest  the largest time constant, positive
/// @guarantee  for every tau in [0, longest], 0 being d = u, the lagged input lies within the
/// result
///             from `begin` to `end`
/// @cost  linear in the samples; up to three times as many in pieces longer than `longest`
[[nodiscard]] SIVID_DECL sampled_signal lagged_within(sampled_signal const& u, double begin,
                                                      double end, double longest, bool rests);

/// A recorded input that acts late, for every delay in an interval: u(t - tau), and u(begin)
/// before, as an input with error bounds.
///   About the middle of the delays, the error is at most half their width times the steepest slope
/// within reach; held inputs take the range of what is within reach.
/// @param delays  0 or more
/// @param drifts  0 or more: of the clock, which add to the delay by so much of the time since the
///                begin; from 1 on the clock stands
/// @guarantee  for every delay and drift the late input lies within the result from `begin` to
///             `end`
/// @cost  as many samples, twice as many held ones; each looks at those within half the delays'
/// width
[[nodiscard]] SIVID_DECL sampled_signal delayed_within(sampled_signal const& u, double begin,
                                                       double end, interval const& delays,
                                                       interval const& drifts = interval(0.0));

/// An input that depends on a parameter p: \f$ u(t) \in middle(t) + slope(t) (p - p_0), \f$ where
/// the middle has error bounds, and the slope is held or straight between its samples.
struct input_of_parameter {
    sampled_signal middle, slope;
    double at = 0; ///< p_0, the middle of the parameter's interval
};

/// A recorded input that acts late, for every delay in an interval, with the delay as a parameter.
/// Straight lines leave no error but about their knots, where the slope changes by s: there half of
/// s times what is left of the delays' half width.
/// @param u       straight lines between samples
/// @param delays  0 or more; before `begin` the input is what it is there
/// @guarantee  for every delay the late input lies within what is returned from `begin` to `end`
/// @cost  three times as many samples, each looks at those within the delays' width
[[nodiscard]] SIVID_DECL input_of_parameter late_by_parameter(sampled_signal const& u, double begin,
                                                              double end, interval const& delays);

/// A recorded input behind a rate limit, for every limit in an interval, in the same form
/// (`rate_limited_line`).
/// @param limits  above 0
[[nodiscard]] SIVID_DECL input_of_parameter limited_by_parameter(sampled_signal const& u,
                                                                 double begin, double end,
                                                                 interval const& limits);

/// A recorded input behind a dead band or a saturation, for every threshold in an interval, in the
/// same form. Where the input's size is not about the threshold, it is a line in that; there, an
/// error remains of half of what is left of the interval's half width.
/// @param stands      beyond the threshold: saturation; else dead band
/// @param thresholds  0 or more
/// @guarantee  for every threshold the input lies within what is returned from `begin` to `end`
/// @cost  up to eight times as many samples
[[nodiscard]] SIVID_DECL input_of_parameter threshold_by_parameter(sampled_signal const& u,
                                                                   double begin, double end,
                                                                   bool stands,
                                                                   interval const& thresholds);

/// A recorded input behind a delay, a drift, a play or a rate limit of any size in a range, as an
/// input with error bounds.
/// @guarantee  for every size it lies within the result from begin to end of the experiment
[[nodiscard]] SIVID_DECL sampled_signal remembered_within(experiment const& x,
                                                          signal_memory const& m,
                                                          interval const& sizes);

/// When a switch goes on and off again, each at a time within an interval. Times at or after the
/// end of an experiment may stand for never.
struct switch_times {
    interval on;
    interval off = interval_traits<interval>::point(std::numeric_limits<double>::max());
};

/// A switch that is 1 from a time within `times.on` to one within `times.off` and else 0, as a held
/// input with error bounds: 0 or 1 where all such switches agree, else anything between.
/// @given  begin <= end; neither interval is empty
/// @guarantee  every such switch lies within the result from `begin` to `end`; where `times.on`
///             reaches to `end`, so does one that stays 0
/// @cost  five samples at most
[[nodiscard]] SIVID_DECL sampled_signal switched_within(double begin, double end,
                                                        switch_times const& times);

/// What switches of these times may be at t.
struct switch_values {
    bool off = false, on = false;
};
[[nodiscard]] SIVID_DECL switch_values switch_at(double begin, double end,
                                                 switch_times const& times, double t);

/// How long switches of these times may differ, from `begin` to `end`.
[[nodiscard]] SIVID_DECL double open_time(double begin, double end, switch_times const& times);

namespace diagnosis_detail {

/// What a recorded input is over some times.
struct seen_input {
    interval values; ///< all of them, errors left out
    double steepest = 0;
    double error = 0; ///< the largest bound
};

/// @param from, until  clipped to `begin` and later; until >= from
inline seen_input seen_between(sampled_signal const& u, double begin, double from, double until) {
    from = std::max(from, begin);
    until = std::max(until, from);
    seen_input seen;
    seen.values = interval_traits<interval>::empty();
    // A knot belongs to both of its pieces.
    auto first = u.piece(from);
    if (first > 0 && u.times()[first] == from) --first;
    for (auto k = first; k == first || (k < u.times().size() && u.times()[k] <= until); ++k) {
        bool const last = k + 1 >= u.times().size();
        double const low = k == first ? from : u.times()[k];
        double const high = last ? until : std::min(until, u.times()[k + 1]);
        seen.values = hull(seen.values, u.value<interval>(k, interval(low, std::max(low, high))));
        seen.steepest = std::max(seen.steepest, mag(u.slope<interval>(k)));
        seen.error = std::max({seen.error, u.error_bound(k, low), u.error_bound(k, high)});
        if (last) break;
        // The last piece of straight lines goes on to the right.
        if (u.kind() == interpolation::linear && k + 2 == u.times().size()) {
            if (until > high) {
                seen.values = hull(seen.values, u.value<interval>(k, interval(high, until)));
            }
            seen.error = std::max(seen.error, u.error_bound(k, until));
            break;
        }
    }
    return seen;
}

} // namespace diagnosis_detail

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/diagnosis/candidate/impl/input_slices.ipp>
#endif

#endif
