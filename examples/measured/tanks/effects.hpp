// SPDX-License-Identifier: MIT
#ifndef TANKS_EFFECTS_HPP
#define TANKS_EFFECTS_HPP

#include <sivid/model/effects.hpp>

#include <vector>

namespace tanks {

/// Both tanks have a rim. What flows over the upper one's is lost but for a share that falls into
/// the lower tank. The rims are weirs that spill as much as comes in within a second or two.
inline sivid::effect overflow() {
    using namespace sivid::literals;
    sivid::effect e;
    e.name = "overflow";
    e.parameters = {{"rim1", "V", 4_dec, 20_dec, 20_dec},
                    {"share", "1", 0_dec, 1_dec, 0_dec},
                    {"rim2", "V", 8_dec, 20_dec, 20_dec}};
    e.about = "water over the rims, a share of it into the lower tank";
    e.on_rates = [](sivid::effect_scope& m) {
        auto const over = [&](char const* level, std::size_t rim) {
            return 0.5_dec * max(m.state(level) - m.parameter(rim), 0);
        };
        auto const spilled = over("x1", 0);
        m.rate("x1") -= spilled;
        m.rate("x2") += m.parameter(1) * spilled - over("x2", 2);
    };
    return e;
}

/// A sensor bias is an outlet that does not lie at zero of the sensor: with y = x2 + b the outlet
/// follows r(y - b).
inline std::vector<sivid::effect> catalogue() {
    using namespace sivid::literals;
    namespace any = sivid::effects;
    return {overflow(),
            any::sensor_bias("outlet_offset", "y", "V", {-4_dec, 4_dec}),
            any::sensor_scale("sensor_scale", {"y"}, {-0.3_dec, 0.3_dec}),
            any::input_trim("pump_offset", "u", "V", {-1_dec, 1_dec}),
            any::input_saturation("pump_saturation", "u", "V", {1_dec, 8_dec}),
            any::linear_damping("leak", "x2", {0_dec, 0.02_dec}),
            any::drift("outlet_drift", "k3", {-0.0002_dec, 0.0002_dec})};
}

} // namespace tanks

#endif
