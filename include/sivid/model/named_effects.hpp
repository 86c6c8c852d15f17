// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_NAMED_EFFECTS_HPP
#define SIVID_MODEL_NAMED_EFFECTS_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/effect.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace sivid {

/// A term that an equation lacks, by its formula, as an effect: `v'~0.5*abs(v)*v` is
/// x' + k 0.5 |v| v in the equation of v, with k in [-1, 1]. The number in front says how large the
/// term may be, in the unit of the rate.
///   Factors are joined by * and /: numbers; names of states, inputs and constants, and t; powers
///   such as x^2; abs(x), sqrt(x), exp(x), sgn(x:s) = x/sqrt(x^2 + s^2), and beyond(x:c), which is
///   x - c above c, x + c below -c and else 0. In brackets stand sums of products.
///   Two factors bring unknowns of their own in place of k, a and b in [-1, 1]:
///   turn(x) = a cos(x) + b sin(x), and wave(x) = a cos(w x) + b sin(w x) with w in [0.85, 1.18].
///   What the formula names is what the model sees.
/// @throws std::invalid_argument  for a text that is no such name; when it meets a model, for names
///         that this lacks
[[nodiscard]] SIVID_DECL effect missing_term(std::string const& name);

/// Whether a name is one of a missing term.
[[nodiscard]] inline bool names_missing_term(std::string_view name) {
    return name.find("'~") != std::string_view::npos;
}

/// A fault of an instrument by its name, as an effect (those of `model/effects.hpp`). In brackets
/// stand its channels, behind ~ a decimal s, which says how large the fault may be:
/// `sensor_lag(u:v)~0.5`, `sensor_rotation(x:y)~0.2`.
///   - `sensor_bias(y:..)`, `sensor_drift(y:..)`: an own offset, or drift, for each, in [-s, s];
///   - `sensor_scale(y:..)`: (1 + k) y for all, k in [-s, s];
///   - `sensor_latency(y:..)`: all are late, by a time in [0, s];
///   - `sensor_lag(y:..)`: all follow by a first-order lag, its time constant in [s/100, s];
///   - `sensor_saturation(y)`: cut off, at a limit in [s/10, s];
///   - `sensor_wrap(y)`: shown modulo T in [s/10, s], leaping back by s/4 or more;
///   - `sensor_rotation(y:z)`: turned by an angle in [-s, s] rad;
///   - `sensor_swap(y:z)`: mixed by k in [-s, s], for k = 1 interchanged;
///   - `sensor_lever_arm(y:z:h)`: positions of a point beside, with the heading h, arms in [-s, s];
///   - `sensor_velocity_arm(y:z:w)`: velocities of one, turning at the rate w, arms in [-s, s].
///
/// @param about  of the model, for the parameters' units; may be null
/// @throws std::invalid_argument  for a text that is no such name; when it meets a model, for names
///         that this lacks
[[nodiscard]] SIVID_DECL effect sensor_fault(std::string const& name,
                                             model_description const* about = nullptr);

/// Whether a name is one of a fault of an instrument.
[[nodiscard]] inline bool names_sensor_fault(std::string_view name) {
    return name.starts_with("sensor_") && name.find(")~") != std::string_view::npos;
}

/// The channels of a fault that its name says.
[[nodiscard]] SIVID_DECL std::vector<std::string> faulty_channels(std::string const& name);

/// Those of a catalogue that have these names, in the order of the names; `widened` ones, and those
/// `only_within` some experiments, too, and what no catalogue has: terms (`missing_term`) and
/// faults of instruments (`sensor_fault`).
/// @param about  of the model, for the units of faults; may be null
/// @throws std::invalid_argument  for a name that the catalogue lacks, an onset or an end that is
/// no number, and an end that comes before its onset
[[nodiscard]] SIVID_DECL std::vector<effect>
effects_named(std::vector<effect> const& catalogue, std::vector<std::string> const& names,
              model_description const* about = nullptr);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/model/impl/missing_term.ipp>
#include <sivid/model/impl/named_effects.ipp>
#endif

#endif
