// SPDX-License-Identifier: MIT
#ifndef SIVID_MEASUREMENT_WRAPPED_READINGS_HPP
#define SIVID_MEASUREMENT_WRAPPED_READINGS_HPP

#include <sivid/compiled.hpp>
#include <sivid/measurement/record.hpp>
#include <sivid/measurement/signal.hpp>
#include <sivid/number/interval_traits.hpp>

#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace sivid {

/// By how much each reading of a channel (the middle of its bound) differs from the one before, in
/// the order of their times.
[[nodiscard]] SIVID_DECL std::vector<double> steps_of(record const& samples, std::size_t channel);

/// How often the readings of a channel have wrapped, as those of a heading between -pi and pi do: a
/// held signal that goes one down with a step up of at least `least`, one up with such a step down,
/// midway between the two readings. What the channel shows of y is then y - n T.
/// @param least  above 0; about half of T
/// @param begin  no later than the samples
/// @param first  n at the begin
/// @throws std::invalid_argument  where no time lies between the readings before and after a leap,
///         and for a reading with one bound: which turn it is in nobody can tell
[[nodiscard]] SIVID_DECL sampled_signal wraps_of(record const& samples, std::size_t channel,
                                                 double least, double begin, double first = 0);

/// What T may be, as the readings leap: within `least` and the errors of the two readings of one of
/// the leaps, since y moves by less than `least` between them; empty where nothing leaps.
[[nodiscard]] SIVID_DECL interval turn_of_leaps(record const& samples, std::size_t channel,
                                                double least);

/// How often a channel had wrapped when it is first read, for all of these T and starts: the
/// first reading is what y - n T shows, and y is then within T/2 of where it started.
/// @returns  nothing where more than one number is possible; 0 where the channel is never read
[[nodiscard]] SIVID_DECL std::optional<double> wraps_before(record const& samples,
                                                            std::size_t channel,
                                                            interval const& start,
                                                            interval const& turn);

/// A full turn in this unit; 0: it is none of angles.
[[nodiscard]] inline double full_turn(std::string const& unit) {
    return unit == "rad" ? 2 * std::numbers::pi : unit == "deg" ? 360 : 0;
}

/// By how much the readings of a channel leap where they wrap: the median of their leaps, in all
/// records. Leaps are steps of about one size, of whose median all other steps are at most a third.
///   Leaps that the next step undoes are noise at the end of the range, or outliers. Of an angle,
/// one other leap, of about a full turn, is enough; else a record has to go through two turns, or
/// all leaps are one way and there are two.
/// @param turn  a full turn in the unit of the channel; 0: it is no angle
/// @returns  0 where they do not wrap
[[nodiscard]] SIVID_DECL double wrapping_range(std::vector<record> const& records,
                                               std::size_t channel, double turn);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/measurement/impl/wrapped_readings.ipp>
#endif

#endif
