// SPDX-License-Identifier: MIT
#ifndef SERVO_AXIS_MODEL_HPP
#define SERVO_AXIS_MODEL_HPP

#include <sivid/model/model.hpp>

/// The Electro-Mechanical Positioning System (EMPS): a motor drives a carriage through a ball
/// screw; one axis of a machine tool or a robot.
///
///     q' = v
///     M v' = F - F_v v - F_c v / sqrt(v^2 + eps^2) - offset
///
/// q [m] position, v [m/s] velocity, F [N] motor force. Dry friction is regularised below
/// eps = 1 mm/s, where its slope F_c/eps makes the equation stiff.
///
/// @ref  A. Janot, M. Gautier, M. Brunot, Data Set and Reference Models of EMPS, Workshop on
///       Nonlinear System Identification Benchmarks, Eindhoven 2019: the nominal values
struct servo_axis {
    static constexpr auto name = "servo_axis";
    static constexpr auto states = sivid::states({{"q", "m", 1}, {"v", "m/s", 1}});
    static constexpr auto inputs = sivid::inputs({{"F", "N"}});
    static constexpr auto channels = sivid::channels({{"q", "m"}});

    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"M", "kg", 95.1089_dec},
                                 {"F_v", "N s/m", 203.5034_dec},
                                 {"F_c", "N", 20.3935_dec},
                                 {"offset", "N", -3.1648_dec},
                                 {"eps", "m/s", 0.001_dec}});
    }();

    template <class T>
    sivid::states_of<servo_axis, T> rate(T const& /*t*/,
                                         sivid::states_of<servo_axis, T> const& state,
                                         sivid::constants_of<servo_axis, T> const& constant,
                                         sivid::inputs_of<servo_axis, T> const& input) const {
        auto const& [q, v] = state;
        auto const& [M, F_v, F_c, offset, eps] = constant;
        auto const& [F] = input;
        T const direction = sin(atan(v / eps)); // one occurrence of v: tight over wide boxes
        return {v, (F - F_v * v - F_c * direction - offset) / M};
    }

    template <class T>
    sivid::channels_of<servo_axis, T>
    observe(T const& /*t*/, sivid::states_of<servo_axis, T> const& state,
            sivid::constants_of<servo_axis, T> const& /*constant*/,
            sivid::inputs_of<servo_axis, T> const& /*input*/) const {
        return {state[0]};
    }
};

#endif
