// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CANDIDATE_DETAIL_EPISODE_HULLS_HPP
#define SIVID_DIAGNOSIS_CANDIDATE_DETAIL_EPISODE_HULLS_HPP

#include <sivid/compiled.hpp>
#include <sivid/diagnosis/candidate/detail/input_slices.hpp>
#include <sivid/diagnosis/candidate/effect_hull_options.hpp>
#include <sivid/model/effect.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/space/box.hpp>

#include <vector>

namespace sivid {

/// What is known of an effect that begins or ends in the midst of experiments.
struct episode_hulls {
    box parameters; ///< as of `effect_hulls`, whenever the effect acts; empty sides: none explain
    /// When it begins and ends, for each experiment: from its begin (or earlier) to its last
    /// measurement (or later, or never).
    std::vector<switch_times> times;
};

/// Encloses when an effect may act, in each experiment at times of its own, and all parameters with
/// which it then explains the data. Over a slice of such times its switch is an input with error
/// bounds (`switched_within`); slices at either end that cannot explain the data are cut off, as
/// long as that helps and there is time.
///   The size of a delay, a play, a rate limit or a late sensor is cut likewise: over a range of it
/// the copied input has error bounds, or the sensor a motion of its own (`with_late_channels`).
/// @param e  Where it begins later, it may begin at any time in each experiment; where it ends, end
///           at any time; else it does not. When it does says only which slices need not be tried.
/// @guarantee  whatever parameters explain the data with the effect switched on, or off, or on and
///             off again at a time in each experiment, or never: they and these times lie in the
///             result
/// @cost  two short searches for each time, again and again while some exclude, within the limits
[[nodiscard]] SIVID_DECL episode_hulls hulls_of_episodes(identification_problem const& base,
                                                         effect e,
                                                         effect_hull_options const& options = {});

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/diagnosis/candidate/impl/episode_hulls.ipp>
#endif

#endif
