// SPDX-License-Identifier: MIT
#ifndef SERVO_AXIS_AXIS_EFFECTS_HPP
#define SERVO_AXIS_AXIS_EFFECTS_HPP

#include <sivid/model/effects.hpp>

#include <vector>

namespace servo {

/// The carriage slides harder one way than the other: viscous friction F_v + k M forwards,
/// F_v - k M backwards.
inline sivid::effect directional_friction() {
    using namespace sivid::literals;
    sivid::effect e;
    e.name = "directional_friction";
    e.parameters = {{"k", "1/s", -1_dec, 1_dec, 0_dec}};
    e.about = "viscous friction that differs between the directions";
    e.on_rates = [](sivid::effect_scope& axis) {
        axis.rate("v") -= axis.parameter() * abs(axis.state("v"));
    };
    return e;
}

/// What any axis may have: nothing here was chosen for this machine but the sizes.
inline std::vector<sivid::effect> axis_catalogue() {
    using namespace sivid::literals;
    namespace any = sivid::effects;
    return {any::dry_friction("dry_friction", "v", "m/s^2", {0_dec, 0.5_dec}, 0.001_dec),
            any::constant_rate("offset", "v", "m/s^2", {-0.2_dec, 0.2_dec}),
            directional_friction(),
            any::quadratic_damping("quadratic_damping", "v", "1/m", {0_dec, 20_dec}),
            any::input_delay("input_delay", "F", {0_dec, 0.05_dec}),
            any::input_dead_band("input_dead_band", "F", "N", {0_dec, 50_dec}),
            any::sensor_scale("position_scale", {"q"}, {-0.05_dec, 0.05_dec})};
}

} // namespace servo

#endif
