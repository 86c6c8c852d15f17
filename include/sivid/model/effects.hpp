// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_EFFECTS_HPP
#define SIVID_MODEL_EFFECTS_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/effect.hpp>

#include <string>
#include <utility>
#include <vector>

/// Effects that any model may have. Each takes, in this order, its name, what it acts on by name,
/// the unit of its parameter where that is not fixed, and the parameter's prior, since sizes depend
/// on the machine; further values come last. Orders put the parts of an actuator one behind the
/// other: delay, dead band, lag, saturation, trim and gain; an instrument's saturation comes last.
namespace sivid::effects {

struct range {
    decimal lower, upper;
};

namespace detail {
SIVID_DECL effect one(std::string name, std::string parameter, std::string unit, range const& prior,
                      std::string about, int order = 0, decimal neutral = {});
} // namespace detail

/// The input acts late: u(t - tau), and u at the begin before.
SIVID_DECL effect input_delay(std::string const& name, std::string const& input, range const& tau);
/// The clock of the input runs slow by r seconds a second: u(t - r (t - begin)), dead time that
/// grows.
/// @param r  0 or more; from 1 on the clock stands
SIVID_DECL effect input_clock_drift(std::string const& name, std::string const& input,
                                    range const& r);
/// u - b above b, u + b below -b, else 0.
SIVID_DECL effect input_dead_band(std::string const& name, std::string const& input,
                                  std::string const& unit, range const& b);
/// Behind a gap of 2b (backlash, play): what follows the input rests until the gap has closed. It
/// acts on the input as recorded, before other effects on it.
SIVID_DECL effect input_backlash(std::string const& name, std::string const& input,
                                 std::string const& unit, range const& b);
/// Behind a rate limit R: what follows the input moves by R a second at most, and is u where it has
/// caught up (`rate_limited`). It acts on the input as recorded, before other effects on it.
/// @param R  above 0; at its upper end, which belongs above all that u does, the effect vanishes; a
///           held u jumps, which no limit lets through
/// @throws std::invalid_argument  for a prior that is not above 0
SIVID_DECL effect input_rate_limit(std::string const& name, std::string const& input,
                                   std::string const& unit, range const& R);
/// First-order lag: d' = (u - d)/tau replaces u. tau = 0 is a limit, where the right-hand side is
/// not defined.
/// @param limit  of |d|, in the unit of the input
/// @param rests  the lag starts at 0; otherwise at the input's value at the begin
SIVID_DECL effect input_lag(std::string const& name, std::string const& input,
                            std::string const& unit, range const& tau, double limit,
                            bool rests = false);
/// The input clamped to [-lim, lim].
SIVID_DECL effect input_saturation(std::string const& name, std::string const& input,
                                   std::string const& unit, range const& lim);
/// u + d0.
SIVID_DECL effect input_trim(std::string const& name, std::string const& input,
                             std::string const& unit, range const& d0);
/// (1 + k) u.
SIVID_DECL effect input_gain(std::string const& name, std::string const& input, range const& k);

/// x' + a.
SIVID_DECL effect constant_rate(std::string const& name, std::string const& state,
                                std::string const& unit, range const& a);
/// x' - k x.
SIVID_DECL effect linear_damping(std::string const& name, std::string const& state, range const& k);
/// x' - k |x| x.
SIVID_DECL effect quadratic_damping(std::string const& name, std::string const& state,
                                    std::string const& unit, range const& k);
/// x' - k x/sqrt(x^2 + s^2): dry friction, smooth within about the speed s of rest. With s = 0 it
/// is x' - k sign(x): what comes to rest sticks until something stronger than k moves it.
SIVID_DECL effect dry_friction(std::string const& name, std::string const& state,
                               std::string const& unit, range const& k, decimal smooth_below);
/// x' - (k + s e^(-(x/v)^2)) x/sqrt(x^2 + e^2): dry friction that is stronger by s near rest, and
/// fades above the speed v (Stribeck); smooth within about the speed e of rest.
SIVID_DECL effect stribeck_friction(std::string const& name, std::string const& state,
                                    std::string const& unit, range const& k, range const& s,
                                    decimal fades_above, decimal smooth_below);
/// Friction with a memory (LuGre): bristles bend by z, in units of what they bend at most when it
/// is slow, and slip,
///   \f$ x' - k (z + d z'), \quad z' = (x - |x| z / g)/b, \quad g = 1 + r e^{-(x/v)^2} \f$
/// with k the force at speed, r how much more it takes at rest, b how far the bristles bend (in the
/// unit of x times time), d their damping [time]. They are straight at the begin. It sticks as a
/// stiff spring does, with no jump: enclosures need steps shorter than b/|x|.
/// @ref  Canudas de Wit, Olsson, Astrom and Lischinsky, IEEE Trans. Autom. Control 40 (1995), with
///       sigma_0 = k/b, sigma_1 = k d/b
SIVID_DECL effect lugre_friction(std::string const& name, std::string const& state,
                                 std::string const& unit, range const& k, range const& r,
                                 decimal fades_above, decimal bends, decimal damping);
/// Where an end stop stands: below or above all that is free.
enum class stop_side { lower, upper };
/// v' + k max(stop - x, 0) for a lower stop, v' - k max(x - stop, 0) for an upper one: an elastic
/// contact of the position x, whose velocity is v; k in `unit`, per mass.
SIVID_DECL effect end_stop(std::string const& name, std::string const& position,
                           std::string const& velocity, std::string const& unit, range const& k,
                           decimal stop, stop_side side);
/// A constant that drifts: c (1 + k t).
SIVID_DECL effect drift(std::string const& name, std::string const& constant, range const& k);

/// y + b.
SIVID_DECL effect sensor_bias(std::string const& name, std::string const& channel,
                              std::string const& unit, range const& b);
/// y + d t: a bias that grows from 0 on.
SIVID_DECL effect sensor_drift(std::string const& name, std::string const& channel,
                               std::string const& unit, range const& d);
/// y clamped to [-lim, lim].
SIVID_DECL effect sensor_saturation(std::string const& name, std::string const& channel,
                                    std::string const& unit, range const& lim);
/// y modulo T, as the readings leap: y - n T, with n how often they have leapt back by at least
/// `least` (about half of T).
SIVID_DECL effect sensor_wrap(std::string const& name, std::string const& channel,
                              std::string const& unit, range const& T, double least);
/// An instrument that is mounted askew by an angle: y cos a - z sin a and y sin a + z cos a for its
/// two channels, of one unit.
SIVID_DECL effect sensor_rotation(std::string const& name, std::vector<std::string> const& channels,
                                  range const& a);
/// An instrument of a position that sits beside the point which moves, at (a, b) in its frame:
/// y + a cos h - b sin h and z + a sin h + b cos h for its two channels, with a heading h.
/// @param arm  prior of a and of b
SIVID_DECL effect sensor_lever_arm(std::string const& name,
                                   std::vector<std::string> const& channels,
                                   std::string const& heading, std::string const& unit,
                                   range const& arm);
/// An instrument of a velocity that sits beside the point which moves, at (a, b) in its frame:
/// y - b w and z + a w for its two channels, along and across, with the rate w of the heading.
/// @param arm  prior of a and of b
SIVID_DECL effect sensor_velocity_arm(std::string const& name,
                                      std::vector<std::string> const& channels,
                                      std::string const& turning, std::string const& unit,
                                      range const& arm);
/// Two channels of one unit that are mixed: y + k (z - y) and z + k (y - z); k = 1: their plugs are
/// interchanged. A prior that goes a little beyond 1 keeps that value off its end.
SIVID_DECL effect sensor_swap(std::string const& name, std::vector<std::string> const& channels,
                              range const& k);
/// (1 + k) y, for all the channels of one instrument; k = -2: a sign that is wrong.
SIVID_DECL effect sensor_scale(std::string const& name, std::vector<std::string> const& channels,
                               range const& k);
/// y(t - tau), and its value at the begin before, for all the channels of one instrument.
SIVID_DECL effect sensor_latency(std::string const& name, std::vector<std::string> const& channels,
                                 range const& tau);
/// y(t - r (t - begin)): the clock of one instrument runs slow by r seconds a second.
/// @param r  0 or more; from 1 on the clock stands
SIVID_DECL effect sensor_clock_drift(std::string const& name,
                                     std::vector<std::string> const& channels, range const& r);
/// First-order lag (low-pass): the channel shows y - w with w' = y' - w/tau and w = 0 at the begin,
/// for all the channels of one instrument, each of which has to show a state. It comes before other
/// faults of these.
/// @param tau  above 0
SIVID_DECL effect sensor_lag(std::string const& name, std::vector<std::string> const& channels,
                             range const& tau);

} // namespace sivid::effects

#ifndef SIVID_COMPILED
#include <sivid/model/impl/effects.ipp>
#endif

#endif
