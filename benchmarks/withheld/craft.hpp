// SPDX-License-Identifier: MIT
// The hovercraft and everything that may be wrong with its model, written down from the formulas of
// the documentation alone. Nothing of sivid is used: a mistake in the library's model or integrator
// must show up as a disagreement with this file.
#ifndef WITHHELD_CRAFT_HPP
#define WITHHELD_CRAFT_HPP

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>
#include <vector>

namespace withheld {

struct constants {
    double m = 1.297, Iz = 0.058, rho = 1.225, Cd = 0.6, CL = 1.891, Cdelta = 0.1339, D = 0.18;
    double Su = 0.1276, Sv = 0.22, Sg = 0.04, A = 0.025447, L = 0.30;
    double Ff = 0.5, eps = 0.05, D11 = 0, D22 = 0.2, D33 = 0.1;
};

/// The member of a constant's name, null for an unknown name.
double constants::*constant_named(std::string_view name);

/// The parameters of the catalogue's effects; the values here are the neutral ones.
struct effect_values {
    double wind_x = 0, wind_y = 0;
    double rudder_lag = 0, input_delay = 0, rudder_trim = 0;
    double thrust_offset = 0, cg_offset = 0;
    double slope_x = 0, slope_y = 0;
    double battery_sag = 0, quadratic_yaw_damping = 0, linear_surge_damping = 0, payload = 0;
    double gyro_bias = 0, heading_bias = 0;
    double rudder_limit = std::numeric_limits<double>::infinity();
    double rudder_deadband = 0, position_scale = 0, motor_lag = 0, dry_yaw_friction = 0;
    double friction_anisotropy = 0, position_latency = 0, thrust_loss = 0;
    double rudder_play = 0;                                       // half of the gap
    double rudder_rate = std::numeric_limits<double>::infinity(); // rad/s at most
    double stribeck_rise = 0, stribeck_speed = 1;                 // more dry friction at low speed
};

/// A lateral push of the shape sin^2, smooth at both ends.
struct gust_pulse {
    double begin = 0, length = 1, force = 0;
};

/// Effects that no catalogue has; neutral where zero.
struct foreign_values {
    double tether_stiffness = 0, tether_slack = 0; // N/m, m: pulls back to the start when taut
    double servo_frequency = 0, servo_damping = 0; // rad/s, 1: second order in place of the lag
    double swell_force = 0, swell_frequency = 1;   // N, rad/s: a lateral force that swings
    double cubic_drag = 0;                         // N s^3/m^3: against u, as u^3
    double weathervane = 0;                        // kg: turns the bow as -u v
    double cross_coupling = 0;                     // kg: pushes aside as -u r
};

/// u, v, r, x, y, psi.
inline constexpr std::size_t channel_count = 6;
using channels = std::array<double, channel_count>;
inline constexpr std::array<std::string_view, channel_count> channel_names{"u", "v", "r",
                                                                           "x", "y", "psi"};

/// What may be wrong with instruments that no catalogue has; neutral where zero.
struct instrument_faults {
    double velocity_turn = 0, position_turn = 0; // rad: axes of u, v or of x, y turned by this
    double velocity_arm = 0;                     // m: u, v are those of a point so far ahead
    double velocity_side = 0;                    // m: and to the side
    double antenna_x = 0, antenna_y = 0;         // m: x, y are those of a point of the body
    channels drift{};                            // per s
    channels lag{};                              // s: low-pass of first order, settled at the start
    channels late{};                             // s: what is shown is so old; the start before
    channels modulus{};                          // what is read is what is left modulo this
};

/// By how much a reading is from what it should be, modulo something; 0: nothing.
inline double apart(double reading, double model, double modulus) {
    return modulus > 0 ? std::remainder(reading - model, modulus) : reading - model;
}

/// Samples at increasing times, linear between them, constant outside.
struct polyline {
    std::vector<double> t, value;
    double at(double time) const;
    double largest_magnitude() const;
};

/// When the catalogue's effects act; outside, they are neutral.
struct episode {
    double from = 0, to = std::numeric_limits<double>::infinity();
    bool holds(double t) const { return from <= t && t < to; }
    bool never() const { return !(from < to); }
    bool begins_later() const { return from > 0 && !never(); }
    bool ends() const { return std::isfinite(to) && !never(); }
    bool always() const { return from == 0 && std::isinf(to); }
};
inline constexpr double for_ever = std::numeric_limits<double>::infinity();

struct world {
    constants c;
    effect_values e;
    foreign_values f;
    std::vector<gust_pulse> gusts;
    polyline motor, rudder; // W and delta
    instrument_faults instruments;
    episode acting;
    bool lags_unseen = false; // they go on, and what is before them acts
};

/// Lets the catalogue's effects act then only. What is remembered (by lags, plays, delays) goes on
/// all the time and acts then.
void act_within(world& w, episode const& when);

/// u, v, r, x, y, psi, then the rudder's angle and the motor's speed behind their lags, and the
/// servo's rate.
inline constexpr std::size_t state_size = 9;
using state = std::array<double, state_size>;

/// The commands at one time: W as recorded, delta behind rate limit, play, delay and dead band.
struct command {
    double motor = 0, rudder = 0;
};

/// delta behind a dead band.
double behind_deadband(double delta, double band);

/// What follows a recording behind a gap of twice half_width: it stands at the recording's value at
/// time 0 and moves only where that pushes it. Exact between the samples, too.
polyline behind_play(polyline const& recorded, double half_width);

/// What follows a recording by so much a second at most: it stands at the recording's value at time
/// 0, and is the recording where it has caught up. Until the last sample; exact between samples,
/// too.
polyline behind_rate_limit(polyline const& recorded, double most);

/// The rudder's command behind its rate limit and play.
polyline driven_rudder(world const& w);

state derivative(world const& w, double t, command const& now, state const& s, state const& start);

/// What acts in place of the recorded W and delta: behind lags, limits and trims.
command effective(world const& w, double t, command const& now, state const& s);

/// What sensors that are neither slow nor late show at time t of a state.
channels sensed(world const& w, double t, state const& s);

} // namespace withheld

#endif
