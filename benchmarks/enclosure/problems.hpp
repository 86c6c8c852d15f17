// SPDX-License-Identifier: MIT
// The problems of the engine's benchmark, as a user would write them.
#ifndef SIVID_BENCHMARKS_ENCLOSURE_PROBLEMS_HPP
#define SIVID_BENCHMARKS_ENCLOSURE_PROBLEMS_HPP

#include <sivid/model/model.hpp>

#include <cstddef>

namespace problems {

/// x' = y,  y' = mu (1 - x^2) y - x
struct van_der_pol {
    static constexpr auto name = "van der Pol";
    static constexpr auto states = sivid::states({{"x", "1", 3}, {"y", "1", 4}});
    static constexpr auto inputs = sivid::no_inputs;
    static constexpr auto channels = sivid::channels({{"x", "1"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"mu", "1", 1_dec}});
    }();
    template <class T>
    sivid::vec<T, 2> rate(T const&, sivid::vec<T, 2> const& s, sivid::vec<T, 1> const& c,
                          sivid::vec<T, 0> const&) const {
        auto const& [x, y] = s;
        return {y, c[0] * (1 - sqr(x)) * y - x};
    }
    template <class T>
    sivid::vec<T, 1> observe(T const&, sivid::vec<T, 2> const& s, sivid::vec<T, 1> const&,
                             sivid::vec<T, 0> const&) const {
        return {s[0]};
    }
};

/// Enzymatic reactions: M. T. Laub and W. F. Loomis, Molecular Biology of the Cell 9 (1998).
struct laub_loomis {
    static constexpr auto name = "Laub-Loomis";
    static constexpr auto states = sivid::states({{"x1", "1", 3},
                                                  {"x2", "1", 3},
                                                  {"x3", "1", 3},
                                                  {"x4", "1", 5},
                                                  {"x5", "1", 3},
                                                  {"x6", "1", 1},
                                                  {"x7", "1", 3}});
    static constexpr auto inputs = sivid::no_inputs;
    static constexpr auto channels = sivid::channels({{"x4", "1"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"k", "1", 1_dec}});
    }();
    template <class T>
    sivid::vec<T, 7> rate(T const&, sivid::vec<T, 7> const& x, sivid::vec<T, 1> const&,
                          sivid::vec<T, 0> const&) const {
        using namespace sivid::literals;
        return {1.4_dec * x[2] - 0.9_dec * x[0],        2.5_dec * x[4] - 1.5_dec * x[1],
                0.6_dec * x[6] - 0.8_dec * x[1] * x[2], 2 - 1.3_dec * x[2] * x[3],
                0.7_dec * x[0] - x[3] * x[4],           0.3_dec * x[0] - 3.1_dec * x[5],
                1.8_dec * x[5] - 1.5_dec * x[1] * x[6]};
    }
    template <class T>
    sivid::vec<T, 1> observe(T const&, sivid::vec<T, 7> const& x, sivid::vec<T, 1> const&,
                             sivid::vec<T, 0> const&) const {
        return {x[3]};
    }
};

struct lorenz {
    static constexpr auto name = "Lorenz";
    static constexpr auto states = sivid::states({{"x", "1", 25}, {"y", "1", 30}, {"z", "1", 50}});
    static constexpr auto inputs = sivid::no_inputs;
    static constexpr auto channels = sivid::channels({{"x", "1"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"sigma", "1", 10_dec}, {"rho", "1", 28_dec}});
    }();
    template <class T>
    sivid::vec<T, 3> rate(T const&, sivid::vec<T, 3> const& s, sivid::vec<T, 2> const& c,
                          sivid::vec<T, 0> const&) const {
        auto const& [x, y, z] = s;
        return {c[0] * (y - x), x * (c[1] - z) - y, x * y - 8 * z / 3};
    }
    template <class T>
    sivid::vec<T, 1> observe(T const&, sivid::vec<T, 3> const& s, sivid::vec<T, 2> const&,
                             sivid::vec<T, 0> const&) const {
        return {s[0]};
    }
};

/// ARCH-COMP, category nonlinear dynamics: x' = -0.4 x + beta y z, y' = 0.4 x - beta y z - gamma
/// y^2, z' = gamma y^2.
struct robertson {
    static constexpr auto name = "Robertson";
    static constexpr auto states = sivid::states({{"x", "1", 1}, {"y", "1", 1}, {"z", "1", 1}});
    static constexpr auto inputs = sivid::no_inputs;
    static constexpr auto channels = sivid::channels({{"x", "1"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"beta", "1", 100_dec}, {"gamma", "1", 1000_dec}});
    }();
    template <class T>
    sivid::vec<T, 3> rate(T const&, sivid::vec<T, 3> const& s, sivid::vec<T, 2> const& c,
                          sivid::vec<T, 0> const&) const {
        using namespace sivid::literals;
        auto const& [x, y, z] = s;
        T const slow = 0.4_dec * x;
        T const middle = c[0] * y * z;
        T const fast = c[1] * sqr(y);
        return {middle - slow, slow - middle - fast, fast};
    }
    template <class T>
    sivid::vec<T, 1> observe(T const&, sivid::vec<T, 3> const& s, sivid::vec<T, 2> const&,
                             sivid::vec<T, 0> const&) const {
        return {s[0]};
    }
};

/// ARCH-COMP, category nonlinear dynamics (CVDP23): two van der Pol oscillators coupled by a spring
/// of unknown stiffness b.
struct coupled_oscillators {
    static constexpr auto name = "coupled van der Pol oscillators";
    static constexpr auto states =
        sivid::states({{"x1", "1", 3}, {"y1", "1", 4}, {"x2", "1", 3}, {"y2", "1", 4}});
    static constexpr auto inputs = sivid::no_inputs;
    static constexpr auto channels = sivid::channels({{"y1", "1"}, {"y2", "1"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"b", "1", 2_dec}});
    }();
    template <class T>
    sivid::vec<T, 4> rate(T const&, sivid::vec<T, 4> const& s, sivid::vec<T, 1> const& c,
                          sivid::vec<T, 0> const&) const {
        auto const& [x1, y1, x2, y2] = s;
        T const pull = c[0] * (x2 - x1);
        return {y1, (1 - x1 * x1) * y1 + pull - x1, y2, (1 - x2 * x2) * y2 - pull - x2};
    }
    template <class T>
    sivid::vec<T, 2> observe(T const&, sivid::vec<T, 4> const& s, sivid::vec<T, 1> const&,
                             sivid::vec<T, 0> const&) const {
        return {s[1], s[3]};
    }
};

/// The sum of all states, as a node of a model's graph.
inline sivid::node_id sum_of_states(sivid::recorded_model& model) {
    auto sum = model.g.constant(0.0);
    for (std::size_t i = 0; i < model.rate.size(); ++i)
        sum = model.g.add(sum, model.g.leaf(sivid::operation::state, i));
    return sum;
}

/// x' = 3 x - 3 x y,  y' = x y - y
struct lotka_volterra {
    static constexpr auto name = "Lotka-Volterra";
    static constexpr auto states = sivid::states({{"x", "1", 3}, {"y", "1", 3}});
    static constexpr auto inputs = sivid::no_inputs;
    static constexpr auto channels = sivid::channels({{"x", "1"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"k", "1", 3_dec}});
    }();
    template <class T>
    sivid::vec<T, 2> rate(T const&, sivid::vec<T, 2> const& s, sivid::vec<T, 1> const& c,
                          sivid::vec<T, 0> const&) const {
        auto const& [x, y] = s;
        return {c[0] * x * (1 - y), y * (x - 1)};
    }
    template <class T>
    sivid::vec<T, 1> observe(T const&, sivid::vec<T, 2> const& s, sivid::vec<T, 1> const&,
                             sivid::vec<T, 0> const&) const {
        return {s[0]};
    }
};

/// ARCH-COMP, category nonlinear dynamics: a quadrotor (Beard, Quadrotor Dynamics and Control,
/// 2008, equations 16 to 19) with PD control of height, roll and pitch. States: position north,
/// east and height; velocities forward, to the right and down; roll, pitch, yaw; their rates.
struct quadrotor {
    static constexpr auto name = "quadrotor";
    static constexpr auto states = sivid::states({{"x1", "m", 5},
                                                  {"x2", "m", 5},
                                                  {"x3", "m", 5},
                                                  {"x4", "m/s", 5},
                                                  {"x5", "m/s", 5},
                                                  {"x6", "m/s", 5},
                                                  {"x7", "rad", 1},
                                                  {"x8", "rad", 1},
                                                  {"x9", "rad", 1},
                                                  {"x10", "rad/s", 1},
                                                  {"x11", "rad/s", 1},
                                                  {"x12", "rad/s", 1}});
    static constexpr auto inputs = sivid::no_inputs;
    static constexpr auto channels = sivid::channels({{"x3", "m"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"g", "m/s^2", 9.81_dec},
                                 {"R", "m", 0.1_dec},
                                 {"l", "m", 0.5_dec},
                                 {"Mrotor", "kg", 0.1_dec},
                                 {"M", "kg", 1_dec},
                                 {"height", "m", 1_dec}});
    }();
    template <class T>
    sivid::vec<T, 12> rate(T const&, sivid::vec<T, 12> const& s, sivid::vec<T, 6> const& c,
                           sivid::vec<T, 0> const&) const {
        auto const& [north, east, up, forward, right, down, roll, pitch, yaw, p, q, r] = s;
        auto const& [g, radius, arm, rotor, centre, height] = c;
        T const mass = centre + 4 * rotor;
        T const body = 2 * centre * sqr(radius) / 5;
        T const jx = body + 2 * sqr(arm) * rotor;
        T const jz = body + 4 * sqr(arm) * rotor;
        T const thrust = mass * g - 10 * (up - height) + 3 * down;
        T const about_roll = -roll - p, about_pitch = -pitch - q;
        T const sr = sin(roll), cr = cos(roll), sp = sin(pitch), cp = cos(pitch);
        T const sy = sin(yaw), cy = cos(yaw);
        T const turn = (sr * q + cr * r) / cp;
        return {
            cp * cy * forward + (sr * sp * cy - cr * sy) * right + (cr * sp * cy + sr * sy) * down,
            cp * sy * forward + (sr * sp * sy + cr * cy) * right + (cr * sp * sy - sr * cy) * down,
            sp * forward - sr * cp * right - cr * cp * down,
            r * right - q * down - g * sp,
            p * down - r * forward + g * cp * sr,
            q * forward - p * right + g * cp * cr - thrust / mass,
            p + sp * turn,
            cr * q - sr * r,
            turn,
            (jx - jz) / jx * q * r + about_roll / jx,
            (jz - jx) / jx * p * r + about_pitch / jx,
            T(0)};
    }
    template <class T>
    sivid::vec<T, 1> observe(T const&, sivid::vec<T, 12> const& s, sivid::vec<T, 6> const&,
                             sivid::vec<T, 0> const&) const {
        return {s[2]};
    }
};

/// A driven mass with dry friction: v' = 2 cos t - k sign(v) - v/5. The drive is stronger than the
/// friction whenever v crosses 0, so that nothing sticks.
struct dry_friction {
    static constexpr auto name = "dry friction";
    static constexpr auto states = sivid::states({{"x", "m", 4}, {"v", "m/s", 4}});
    static constexpr auto inputs = sivid::no_inputs;
    static constexpr auto channels = sivid::channels({{"x", "m"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"k", "m/s^2", 0.25_dec}});
    }();
    template <class T>
    sivid::vec<T, 2> rate(T const& t, sivid::vec<T, 2> const& s, sivid::vec<T, 1> const& c,
                          sivid::vec<T, 0> const&) const {
        return {s[1], 2 * cos(t) - c[0] * sign(s[1]) - s[1] / 5};
    }
    template <class T>
    sivid::vec<T, 1> observe(T const&, sivid::vec<T, 2> const& s, sivid::vec<T, 1> const&,
                             sivid::vec<T, 0> const&) const {
        return {s[0]};
    }
};

/// A positioning loop whose force saturates at 1 and whose sensor has a dead band of 0.05.
struct saturated_servo {
    static constexpr auto name = "saturated servo";
    static constexpr auto states = sivid::states({{"x", "m", 4}, {"v", "m/s", 4}});
    static constexpr auto inputs = sivid::no_inputs;
    static constexpr auto channels = sivid::channels({{"x", "m"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"gain", "1/s^2", 4_dec}});
    }();
    bool saturates = true, dead = true;
    template <class T>
    sivid::vec<T, 2> rate(T const& t, sivid::vec<T, 2> const& s, sivid::vec<T, 1> const& c,
                          sivid::vec<T, 0> const&) const {
        using namespace sivid::literals;
        auto const& [x, v] = s;
        T const error = sin(t) - x;
        T const seen = dead ? deadband(error, T(0.05_dec)) : error;
        T const force = saturates ? saturate(c[0] * seen, T(-1), T(1)) : c[0] * seen;
        return {v, force - 2 * v};
    }
    template <class T>
    sivid::vec<T, 1> observe(T const&, sivid::vec<T, 2> const& s, sivid::vec<T, 1> const&,
                             sivid::vec<T, 0> const&) const {
        return {s[0]};
    }
};

/// Stiff relaxation to cos t, with a slow follower: x' = -k (x - cos t) - sin t,  y' = (x - y)/2
struct relaxation {
    static constexpr auto name = "relaxation";
    static constexpr auto states = sivid::states({{"x", "1", 2}, {"y", "1", 2}});
    static constexpr auto inputs = sivid::no_inputs;
    static constexpr auto channels = sivid::channels({{"x", "1"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"k", "1", 10000_dec}});
    }();
    template <class T>
    sivid::vec<T, 2> rate(T const& t, sivid::vec<T, 2> const& s, sivid::vec<T, 1> const& c,
                          sivid::vec<T, 0> const&) const {
        auto const& [x, y] = s;
        return {-(c[0] * (x - cos(t))) - sin(t), (x - y) / 2};
    }
    template <class T>
    sivid::vec<T, 1> observe(T const&, sivid::vec<T, 2> const& s, sivid::vec<T, 1> const&,
                             sivid::vec<T, 0> const&) const {
        return {s[0]};
    }
};

} // namespace problems

#endif
