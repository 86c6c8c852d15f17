// SPDX-License-Identifier: MIT
#ifndef HOVERCRAFT_MODEL_HPP
#define HOVERCRAFT_MODEL_HPP

#include <sivid/model/model.hpp>

#include <array>

/// The hovercraft of L. Zhu's internship report (ENSTA ParisTech, 2016), equations (2.1) to (2.3).
///
/// States u, v [m/s] (surge, sway, body frame), r [rad/s], x, y [m], psi [rad]; inputs W [1/s]
/// (rotor speed) and delta [rad] (rudder):
///
///     F_u  = Cdelta rho D^4 W^2                                   thrust [N]
///     V    = sqrt(u^2 + v^2 + eps^2)                              regularised speed
///     X = F_u - Ff u/V - 1/2 rho Cd Su V u - D11 u
///     Y = CL Sv F_u delta/(4A) - Ff v/V - 1/2 rho Cd Sv V v - D22 v
///     N = -L CL Sg F_u delta/(4A) - D33 r
///     A = pi D^2/4                                                swept by the propeller
///     u' = v r + X/m    v' = -u r + Y/m    r' = N/Iz
///     x' = u cos psi - v sin psi    y' = u sin psi + v cos psi    psi' = r
///
/// The report has misprints; `docs/hovercraft.md` lists each reading and its reason. Two of them
/// stay selectable here.
struct hovercraft {
    static constexpr auto name = "hovercraft";
    static constexpr auto states = sivid::states({{"u", "m/s", 8, "surge"},
                                                  {"v", "m/s", 8, "sway"},
                                                  {"r", "rad/s", 6, "yaw"},
                                                  {"x", "m", 50},
                                                  {"y", "m", 50},
                                                  {"psi", "rad", 10}});
    static constexpr auto inputs = sivid::inputs({{"W", "1/s"}, {"delta", "rad"}});
    static constexpr auto channels = sivid::channels(
        {{"u", "m/s"}, {"v", "m/s"}, {"r", "rad/s"}, {"x", "m"}, {"y", "m"}, {"psi", "rad"}});

    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"m", "kg", 1.297_dec},
                                 {"Iz", "kg m^2", 0.058_dec},
                                 {"rho", "kg/m^3", 1.225_dec},
                                 {"Cd", "1", 0.6_dec},
                                 {"CL", "1/rad", 1.891_dec},
                                 {"Cdelta", "1", 0.1339_dec},
                                 {"D", "m", 0.18_dec},
                                 {"Su", "m^2", 0.1276_dec},
                                 {"Sv", "m^2", 0.22_dec},
                                 {"Sg", "m^2", 0.04_dec},
                                 {"A", "m^2", 0.025447_dec},
                                 {"L", "m", 0.30_dec},
                                 {"Ff", "N", 0.5_dec},
                                 {"eps", "m/s", 0.05_dec},
                                 {"D11", "kg/s", 0_dec},
                                 {"D22", "kg/s", 0.2_dec},
                                 {"D33", "kg m^2/s", 0.1_dec}});
    }();

    /// Area in the rudder's lift of (2.2b): the report prints S_v, physics suggests the rudder's
    /// S_g.
    enum class lift_area { as_printed, rudder };
    /// Direction of the dry friction: a unit vector, smooth at rest, or the report's u/(u^2+v^2).
    enum class friction_law { unit_vector, as_printed };

    lift_area lift = lift_area::as_printed;
    friction_law friction = friction_law::unit_vector;

    /// The propeller sweeps a disc, (2.3c,d). Table 2.3 rounds A; it stands where the data say
    /// nothing of D, and where they say something of A itself.
    template <class T>
    std::array<sivid::relation_of_constants<T>, 1>
    derived(sivid::constants_of<hovercraft, T> const& constant) const {
        auto const& [m, Iz, rho, Cd, CL, Cdelta, D, Su, Sv, Sg, A, L, Ff, eps, D11, D22, D33] =
            constant;
        T const pi = 4 * atan(T(1));
        return {{{"A", pi * sqr(D) / 4}}};
    }

    template <class T>
    sivid::states_of<hovercraft, T> rate(T const& /*t*/,
                                         sivid::states_of<hovercraft, T> const& state,
                                         sivid::constants_of<hovercraft, T> const& constant,
                                         sivid::inputs_of<hovercraft, T> const& input) const {
        auto const& [u, v, r, x, y, psi] = state;
        auto const& [m, Iz, rho, Cd, CL, Cdelta, D, Su, Sv, Sg, A, L, Ff, eps, D11, D22, D33] =
            constant;
        auto const& [W, delta] = input;

        T const thrust = Cdelta * rho * pown(D, 4) * sqr(W);
        T const side_force = CL * thrust * delta / (4 * A);
        T const speed_squared = sqr(u) + sqr(v) + sqr(eps);
        T const speed = sqrt(speed_squared);
        T const drag = rho * Cd / 2 * speed;
        T const dry = Ff / (friction == friction_law::unit_vector ? speed : speed_squared);

        T const surge = thrust - dry * u - Su * drag * u - D11 * u;
        T const sway = (lift == lift_area::as_printed ? Sv : Sg) * side_force - dry * v -
                       Sv * drag * v - D22 * v;
        T const yaw = -(L * Sg * side_force) - D33 * r;
        return {v * r + surge / m,
                sway / m - u * r,
                yaw / Iz,
                u * cos(psi) - v * sin(psi),
                u * sin(psi) + v * cos(psi),
                r};
    }

    template <class T>
    sivid::channels_of<hovercraft, T>
    observe(T const& /*t*/, sivid::states_of<hovercraft, T> const& state,
            sivid::constants_of<hovercraft, T> const& /*constant*/,
            sivid::inputs_of<hovercraft, T> const& /*input*/) const {
        return state;
    }
};

#endif
