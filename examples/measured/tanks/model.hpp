// SPDX-License-Identifier: MIT
#ifndef TANKS_MODEL_HPP
#define TANKS_MODEL_HPP

#include <sivid/model/model.hpp>

/// Two tanks, one above the other, with free outlets; a pump fills the upper one.
///
///     x1' = k4 u - k1 r(x1)
///     x2' = k1 r(x1) - k3 r(x2)             r(x) = x/(x^2 + s^2)^(1/4)
///
/// x1, x2 levels of the upper and lower tank in volts of the lower one's sensor, u [V] pump. The
/// upper level is not measured; its scale is fixed by letting both tanks have the same k1.
///
/// r is sqrt(x) but near an empty tank: above 1 V the two differ by less than 3e-5 of the value,
/// and r stays smooth where a bad guess of the parameters drains a tank.
///
/// @ref  M. Schoukens, P. Mattsson, T. Wigren, J.-P. Noel, Cascaded tanks benchmark combining soft
///       and hard nonlinearities, Workshop on Nonlinear System Identification Benchmarks 2016
struct cascaded_tanks {
    static constexpr auto name = "cascaded_tanks";
    static constexpr auto states =
        sivid::states({{"x1", "V", 60, "upper tank"}, {"x2", "V", 60, "lower tank"}});
    static constexpr auto inputs = sivid::inputs({{"u", "V"}});
    static constexpr auto channels = sivid::channels({{"y", "V"}});

    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"k1", "V^0.5/s", 0.047_dec},
                                 {"k3", "V^0.5/s", 0.047_dec},
                                 {"k4", "1/s", 0.045_dec},
                                 {"s", "V", 0.01_dec}});
    }();

    template <class T>
    sivid::states_of<cascaded_tanks, T>
    rate(T const& /*t*/, sivid::states_of<cascaded_tanks, T> const& level,
         sivid::constants_of<cascaded_tanks, T> const& constant,
         sivid::inputs_of<cascaded_tanks, T> const& input) const {
        auto const& [x1, x2] = level;
        auto const& [k1, k3, k4, s] = constant;
        auto const& [u] = input;
        auto const root = [&s = s](T const& x) -> T { return x / sqrt(sqrt(sqr(x) + sqr(s))); };
        T const between = k1 * root(x1);
        return {k4 * u - between, between - k3 * root(x2)};
    }

    template <class T>
    sivid::channels_of<cascaded_tanks, T>
    observe(T const& /*t*/, sivid::states_of<cascaded_tanks, T> const& level,
            sivid::constants_of<cascaded_tanks, T> const& /*constant*/,
            sivid::inputs_of<cascaded_tanks, T> const& /*input*/) const {
        return {level[1]};
    }
};

#endif
