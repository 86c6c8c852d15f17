// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_CONTROL_LAW_HPP
#define SIVID_DECISION_CONTROL_LAW_HPP

#include <sivid/compiled.hpp>
#include <sivid/decision/requirement.hpp>
#include <sivid/model/closed_loop.hpp>

#include <string_view>

namespace sivid {

/// Reads a control law and commands what it says: inputs as expressions, parted by semicolons.
///
///     W = clamp(K * (2 - u), 0, 250)
///     W = A * during(0, 1) + B * during(1, 4); delta = -P * measured(psi) - Q * r
///
/// Expressions are those of requirements (`requirement`), in states, channels, constants, inputs
/// that are not commanded, gains (constants that `loop` was given before) and the time t; besides
///   clamp(x, low, high)   x within these bounds
///   during(from, to)      1 from a time on until just before another one, else 0; times, or
///                         `end`
///   integral(x)           since the begin, by a further state
/// A state is read as it is; measured(c) is what the sensor of a channel shows, with its error.
/// @param end  of the motion, in the model's unit of time, > 0
/// @throws requirement_error  that names the place and the remedy
SIVID_DECL void command_by(std::string_view text, closed_loop& loop, double end);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/decision/impl/control_law.ipp>
#endif

#endif
