// SPDX-License-Identifier: MIT
// A whole program to copy: model and effects are yours, the commands come with sivid::app.
#include <sivid/app/app.hpp>
#include <sivid/model/effects.hpp>

#include <iostream>
#include <vector>

namespace {

/// A geared motor:  theta' = w,  w' = a u - b w.
struct geared_motor {
    static constexpr auto name = "geared_motor"; // "model" in dataset.json
    static constexpr auto states =
        sivid::states({{"theta", "rad", 100, "angle"}, {"w", "rad/s", 50, "torque balance"}});
    static constexpr auto inputs = sivid::inputs({{"u", "V"}});
    static constexpr auto channels = sivid::channels({{"theta", "rad"}});

    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"a", "rad/(s^2 V)", 10_dec}, {"b", "1/s", 5_dec}});
    }();

    template <class T>
    sivid::states_of<geared_motor, T> rate(T const& /*t*/,
                                           sivid::states_of<geared_motor, T> const& state,
                                           sivid::constants_of<geared_motor, T> const& constant,
                                           sivid::inputs_of<geared_motor, T> const& input) const {
        auto const& [theta, w] = state;
        auto const& [a, b] = constant;
        auto const& [u] = input;
        return {w, a * u - b * w};
    }

    template <class T>
    sivid::channels_of<geared_motor, T>
    observe(T const& /*t*/, sivid::states_of<geared_motor, T> const& state,
            sivid::constants_of<geared_motor, T> const& /*constant*/,
            sivid::inputs_of<geared_motor, T> const& /*input*/) const {
        return {state[0]};
    }
};

std::vector<sivid::effect> catalogue() {
    using namespace sivid::literals;
    namespace any = sivid::effects;
    return {any::dry_friction("dry_friction", "w", "rad/s^2", {0_dec, 10_dec}, 0.05_dec),
            any::constant_rate("offset", "w", "rad/s^2", {-5_dec, 5_dec}),
            any::quadratic_damping("quadratic_damping", "w", "1/rad", {0_dec, 1_dec}),
            any::input_dead_band("dead_band", "u", "V", {0_dec, 2_dec}),
            any::sensor_scale("encoder_scale", {"theta"}, {-0.05_dec, 0.05_dec})};
}

} // namespace

int main(int argc, char** argv) {
    auto const robot = sivid::app::robot_of(
        "own_robot", "What a model of a geared motor leaves out", geared_motor{}, catalogue());
    return sivid::app::run(robot, argc, argv, {std::cout, std::cerr});
}
