// SPDX-License-Identifier: MIT
#ifndef SERVO_AXIS_LINEAR_AXIS_HPP
#define SERVO_AXIS_LINEAR_AXIS_HPP

#include <sivid/model/model.hpp>

/// The axis as one would write it down first: a mass and viscous friction.
///
///     q' = v
///     M v' = F - F_v v
///
/// q [m] position, v [m/s] velocity, F [N] motor force.
struct linear_axis {
    static constexpr auto name = "linear_axis";
    static constexpr auto states =
        sivid::states({{"q", "m", 1, "position"}, {"v", "m/s", 1, "force balance"}});
    static constexpr auto inputs = sivid::inputs({{"F", "N"}});
    static constexpr auto channels = sivid::channels({{"q", "m"}});

    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"M", "kg", 95.1089_dec}, {"F_v", "N s/m", 203.5034_dec}});
    }();

    template <class T>
    sivid::states_of<linear_axis, T> rate(T const& /*t*/,
                                          sivid::states_of<linear_axis, T> const& state,
                                          sivid::constants_of<linear_axis, T> const& constant,
                                          sivid::inputs_of<linear_axis, T> const& input) const {
        auto const& [q, v] = state;
        auto const& [M, F_v] = constant;
        auto const& [F] = input;
        return {v, (F - F_v * v) / M};
    }

    template <class T>
    sivid::channels_of<linear_axis, T>
    observe(T const& /*t*/, sivid::states_of<linear_axis, T> const& state,
            sivid::constants_of<linear_axis, T> const& /*constant*/,
            sivid::inputs_of<linear_axis, T> const& /*input*/) const {
        return {state[0]};
    }
};

#endif
