// SPDX-License-Identifier: MIT
#ifndef HOVERCRAFT_EFFECTS_HPP
#define HOVERCRAFT_EFFECTS_HPP

#include <sivid/model/effects.hpp>

#include <vector>

/// What the hovercraft's model leaves out: 24 effects, whose names stand in diagnoses. On the
/// rudder they act in the order rate limit, backlash, delay, dead band, lag, saturation, trim; on
/// the motor sag, lag.
namespace hovercraft_example {

/// Air that moves with (wx, wy) over the ground: the drag follows the speed through the air, dry
/// friction and D22 that over the ground.
inline sivid::effect wind() {
    using namespace sivid::literals;
    sivid::effect e;
    e.name = "wind";
    e.parameters = {{"wx", "m/s", -2_dec, 2_dec, 0_dec}, {"wy", "m/s", -2_dec, 2_dec, 0_dec}};
    e.about = "steady wind";
    e.on_rates = [](sivid::effect_scope& h) {
        auto const& [wx, wy] = std::pair(h.parameter(0), h.parameter(1));
        auto const& u = h.state("u");
        auto const& v = h.state("v");
        auto const c = cos(h.state("psi"));
        auto const s = sin(h.state("psi"));
        auto const air = h.constant("rho") * h.constant("Cd") / 2 / h.constant("m");
        auto const ur = u - (c * wx + s * wy);
        auto const vr = v - (c * wy - s * wx);
        auto const speed = sqrt(sqr(u) + sqr(v) + sqr(h.constant("eps")));
        auto const through_air = sqrt(sqr(ur) + sqr(vr) + sqr(h.constant("eps")));
        h.rate("u") -= air * h.constant("Su") * (through_air * ur - speed * u);
        h.rate("v") -= air * h.constant("Sv") * (through_air * vr - speed * v);
    };
    return e;
}

/// The centre of gravity lies xg before the origin of the body frame.
inline sivid::effect cg_offset() {
    using namespace sivid::literals;
    sivid::effect e;
    e.name = "cg_offset";
    e.parameters = {{"xg", "m", -0.1_dec, 0.1_dec, 0_dec}};
    e.about = "centre of gravity off the origin";
    e.order = 9; // after all forces
    e.on_rates = [](sivid::effect_scope& h) {
        // [m, m xg; m xg, Iz + m xg^2] (v', r') = (Y - m u r, N - m xg u r), solved.
        auto const& xg = h.parameter();
        auto const& r = h.state("r");
        auto const force_over_mass = h.rate("v") + h.state("u") * r;
        h.rate("u") += xg * sqr(r);
        h.rate("r") -= xg * h.constant("m") / h.constant("Iz") * force_over_mass;
        h.rate("v") -= xg * h.rate("r");
    };
    return e;
}

/// The ground falls along x by sx, along y by sy.
inline sivid::effect ground_slope() {
    using namespace sivid::literals;
    sivid::effect e;
    e.name = "ground_slope";
    e.parameters = {{"sx", "rad", -0.05_dec, 0.05_dec, 0_dec},
                    {"sy", "rad", -0.05_dec, 0.05_dec, 0_dec}};
    e.about = "ground that is not level";
    e.on_rates = [](sivid::effect_scope& h) {
        sivid::expression const g = 9.81_dec;
        auto const c = cos(h.state("psi"));
        auto const s = sin(h.state("psi"));
        h.rate("u") += g * (c * h.parameter(0) + s * h.parameter(1));
        h.rate("v") += g * (c * h.parameter(1) - s * h.parameter(0));
    };
    return e;
}

namespace detail {
inline sivid::effect one(char const* name, char const* parameter, char const* unit,
                         sivid::decimal lower, sivid::decimal upper, char const* about) {
    sivid::effect e;
    e.name = name;
    e.parameters = {{parameter, unit, lower, upper, {}}};
    e.about = about;
    return e;
}
inline sivid::expression thrust(sivid::effect_scope& h) {
    return h.constant("Cdelta") * h.constant("rho") * pown(h.constant("D"), 4) * sqr(h.input("W"));
}
} // namespace detail

/// The thrust acts yT beside the centre line.
inline sivid::effect thrust_offset() {
    using namespace sivid::literals;
    auto e = detail::one("thrust_offset", "yT", "m", -0.02_dec, 0.02_dec, "thrust off the centre");
    e.on_rates = [](sivid::effect_scope& h) {
        h.rate("r") += detail::thrust(h) * h.parameter() / h.constant("Iz");
    };
    return e;
}
/// Rotor speed W (1 - k t).
inline sivid::effect battery_sag() {
    using namespace sivid::literals;
    auto e = detail::one("battery_sag", "k", "1/s", 0_dec, 0.15_dec, "battery that runs down");
    e.order = 1;
    e.on_inputs = [](sivid::effect_scope& h) { h.input("W") *= 1 - h.parameter() * h.time(); };
    return e;
}
inline sivid::effect quadratic_yaw_damping() {
    using namespace sivid::literals;
    auto e = detail::one("quadratic_yaw_damping", "k", "N m s^2", 0_dec, 0.3_dec,
                         "quadratic damping in yaw");
    e.on_rates = [](sivid::effect_scope& h) {
        auto const& r = h.state("r");
        h.rate("r") -= h.parameter() * abs(r) * r / h.constant("Iz");
    };
    return e;
}
inline sivid::effect linear_surge_damping() {
    using namespace sivid::literals;
    auto e =
        detail::one("linear_surge_damping", "k", "kg/s", 0_dec, 1_dec, "linear damping in surge");
    e.on_rates = [](sivid::effect_scope& h) {
        h.rate("u") -= h.parameter() * h.state("u") / h.constant("m");
    };
    return e;
}
/// More mass, the same inertia about the vertical axis.
inline sivid::effect payload() {
    using namespace sivid::literals;
    auto e = detail::one("payload", "dm", "kg", 0_dec, 0.5_dec, "additional mass");
    e.on_inputs = [](sivid::effect_scope& h) { h.constant("m") += h.parameter(); };
    return e;
}
inline sivid::effect dry_yaw_friction() {
    using namespace sivid::literals;
    auto e = detail::one("dry_yaw_friction", "k", "N m", 0_dec, 0.15_dec, "dry friction in yaw");
    e.on_rates = [](sivid::effect_scope& h) {
        auto const& r = h.state("r");
        sivid::expression const smooth = 0.01_dec;
        h.rate("r") -= h.parameter() * r / sqrt(sqr(r) + sqr(smooth)) / h.constant("Iz");
    };
    return e;
}
/// Dry friction that is (1 + k) times as strong sideways.
inline sivid::effect friction_anisotropy() {
    using namespace sivid::literals;
    auto e = detail::one("friction_anisotropy", "k", "1", -0.9_dec, 2_dec,
                         "dry friction that differs sideways");
    e.on_rates = [](sivid::effect_scope& h) {
        auto const& v = h.state("v");
        auto const speed = sqrt(sqr(h.state("u")) + sqr(v) + sqr(h.constant("eps")));
        h.rate("v") -= h.parameter() * h.constant("Ff") * v / speed / h.constant("m");
    };
    return e;
}
/// Thrust F_u (1 - k u) wherever it stands.
inline sivid::effect thrust_loss_with_speed() {
    using namespace sivid::literals;
    auto e = detail::one("thrust_loss_with_speed", "k", "s/m", 0_dec, 0.3_dec,
                         "thrust that falls with speed");
    e.on_inputs = [](sivid::effect_scope& h) {
        h.constant("Cdelta") *= 1 - h.parameter() * h.state("u");
    };
    return e;
}
/// Dry friction that is (1 + k) times as strong at rest and fades to F_f within some vs:
/// F_f (1 + k exp(-(V / vs)^2)).
inline sivid::effect stribeck() {
    using namespace sivid::literals;
    sivid::effect e;
    e.name = "stribeck";
    e.parameters = {{"k", "1", 0_dec, 2_dec, 0_dec}, {"vs", "m/s", 0.2_dec, 1_dec, 0.5_dec}};
    e.about = "dry friction that is stronger at low speed";
    e.on_inputs = [](sivid::effect_scope& h) {
        auto const square = sqr(h.state("u")) + sqr(h.state("v")) + sqr(h.constant("eps"));
        h.constant("Ff") *= 1 + h.parameter(0) * exp(-square / sqr(h.parameter(1)));
    };
    return e;
}

/// The whole catalogue.
[[nodiscard]] inline std::vector<sivid::effect> catalogue() {
    using namespace sivid::literals;
    namespace any = sivid::effects;
    return {wind(),
            any::input_lag("rudder_lag", "delta", "rad", {0_dec, 1_dec}, 2),
            any::input_delay("input_delay", "delta", {0_dec, 0.5_dec}),
            any::input_trim("rudder_trim", "delta", "rad", {-0.2_dec, 0.2_dec}),
            thrust_offset(),
            cg_offset(),
            ground_slope(),
            battery_sag(),
            quadratic_yaw_damping(),
            linear_surge_damping(),
            payload(),
            any::sensor_bias("gyro_bias", "r", "rad/s", {-0.5_dec, 0.5_dec}),
            any::sensor_bias("heading_bias", "psi", "rad", {-0.3_dec, 0.3_dec}),
            any::input_saturation("rudder_saturation", "delta", "rad", {0.05_dec, 1_dec}),
            any::input_dead_band("rudder_deadband", "delta", "rad", {0_dec, 0.3_dec}),
            any::sensor_scale("position_scale", {"x", "y"}, {-0.2_dec, 0.2_dec}),
            any::input_lag("motor_lag", "W", "1/s", {0_dec, 1_dec}, 1000, true),
            dry_yaw_friction(),
            friction_anisotropy(),
            any::sensor_latency("position_latency", {"x", "y"}, {0_dec, 0.5_dec}),
            thrust_loss_with_speed(),
            any::input_backlash("rudder_backlash", "delta", "rad", {0_dec, 0.15_dec}),
            stribeck(),
            any::input_rate_limit("rudder_rate_limit", "delta", "rad/s", {0.02_dec, 2_dec})};
}

} // namespace hovercraft_example

#endif
