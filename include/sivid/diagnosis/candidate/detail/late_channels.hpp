// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CANDIDATE_DETAIL_LATE_CHANNELS_HPP
#define SIVID_DIAGNOSIS_CANDIDATE_DETAIL_LATE_CHANNELS_HPP

#include <sivid/compiled.hpp>
#include <sivid/diagnosis/candidate/detail/input_slices.hpp>
#include <sivid/model/effect.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/number/interval.hpp>

#include <cstddef>
#include <vector>

namespace sivid {

/// A problem in which channels show the past, over a range of delays, without any delay.
///   What a late channel shows at t is what it would show then of the same motion begun tau later
///   under late inputs. So each experiment is split in two: one measures the other channels, and
///   one the late ones, of a motion whose clock stands until a and runs from b on, where [a, b] is
///   the range of tau; between, it runs at the rate
///     \f$ (b - \tau)/(b - a), \f$
///   so that from b on it is tau late: a line in tau, as the late inputs are but for small errors
///   (`late_by_parameter`), and what the clock shows takes the place of the time in the equations.
///   No derivative of the channels is needed.
/// @param base    with all other effects: they see late inputs and a late time
/// @param sensor  the late sensor, alone with its parameter
/// @param delays  range of that parameter, whose place the distance from its middle takes
/// @param when    for each experiment, when the sensor is late; none: wherever it acts. What it
///                shows while it may be either is left out
/// @given  inputs that are recorded, or do not change; no late channel depends on the time itself
/// @guarantee  parameters with such a delay that explain the data explain this problem: samples of
///             late channels between a and b are left out, each part may have all the outliers
[[nodiscard]] SIVID_DECL identification_problem with_late_channels(
    identification_problem const& base, effect const& sensor, std::vector<bool> const& late,
    interval const& delays, std::vector<switch_times> const& when = {});

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/diagnosis/candidate/impl/late_channels.ipp>
#endif

#endif
