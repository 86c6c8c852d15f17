// SPDX-License-Identifier: MIT
#ifndef SIVID_BENCHMARKS_PAVING_MACHINES_HPP
#define SIVID_BENCHMARKS_PAVING_MACHINES_HPP

#include <sivid/model/implicit_model.hpp>
#include <sivid/model/model.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>

/// Machines whose records are identified, each with constants that are plausible for it.
namespace robots {

using namespace sivid;

/// Two links that turn about upright axes and lean against gravity: the momentum form's constants,
/// viscous friction, torques as inputs; the angles are measured. With dry friction in both joints,
/// smooth within 0.1 rad/s, there are eight constants.
template <bool DryFriction>
struct arm {
    static constexpr auto name = "arm";
    static constexpr auto states = sivid::states(
        {{"q1", "rad", 10}, {"q2", "rad", 10}, {"w1", "rad/s", 20}, {"w2", "rad/s", 20}});
    static constexpr auto inputs = sivid::inputs({{"T1", "N m"}, {"T2", "N m"}});
    static constexpr auto channels = sivid::channels({{"q1", "rad"}, {"q2", "rad"}});
    static constexpr auto constants = [] {
        constexpr std::array<constant_quantity, 8> all{{{"a1", "kg m^2", 0.6_dec},
                                                        {"a2", "kg m^2", 0.12_dec},
                                                        {"a3", "kg m^2", 0.15_dec},
                                                        {"f1", "N m s", 0.3_dec},
                                                        {"f2", "N m s", 0.1_dec},
                                                        {"g", "N m", 2_dec},
                                                        {"d1", "N m", 0.4_dec},
                                                        {"d2", "N m", 0.15_dec}}};
        std::array<constant_quantity, DryFriction ? 8 : 6> own{};
        for (std::size_t k = 0; k < own.size(); ++k) own[k] = all[k];
        return own;
    }();
    template <class T>
    matrix_of<arm, T> mass(T const&, vec<T, 4> const& x, constants_of<arm, T> const& c,
                           vec<T, 2> const&) const {
        auto const &a1 = c[0], &a2 = c[1], &a3 = c[2];
        T const m11 = a1 + 2 * a2 * cos(x[1]), m12 = a3 + a2 * cos(x[1]);
        return {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, m11, m12}, {0, 0, m12, a3}}};
    }
    template <class T>
    vec<T, 4> force(T const&, vec<T, 4> const& x, constants_of<arm, T> const& c,
                    vec<T, 2> const& u) const {
        auto const &a2 = c[1], &f1 = c[3], &f2 = c[4], &g = c[5];
        T const h = a2 * sin(x[1]);
        T r1 = u[0] - f1 * x[2] + h * x[3] * (2 * x[2] + x[3]) - g * cos(x[0]);
        T r2 = u[1] - f2 * x[3] - h * x[2] * x[2];
        if constexpr (DryFriction) {
            r1 = r1 - c[6] * tanh(10 * x[2]);
            r2 = r2 - c[7] * tanh(10 * x[3]);
        }
        return {x[2], x[3], r1, r2};
    }
    template <class T>
    vec<T, 2> observe(T const&, vec<T, 4> const& x, constants_of<arm, T> const&,
                      vec<T, 2> const&) const {
        return {x[0], x[1]};
    }
};

/// An arm that turns on a column, with a shoulder and an elbow in its vertical plane: thin links,
/// and rotors behind gears of 0.3 and 0.1 kg m^2 at shoulder and elbow, 0.2 at the column, as
/// known.
struct turning_arm {
    static constexpr auto name = "turning arm";
    static constexpr auto states = sivid::states({{"q1", "rad", 10},
                                                  {"q2", "rad", 10},
                                                  {"q3", "rad", 10},
                                                  {"w1", "rad/s", 20},
                                                  {"w2", "rad/s", 20},
                                                  {"w3", "rad/s", 20}});
    static constexpr auto inputs = sivid::inputs({{"T1", "N m"}, {"T2", "N m"}, {"T3", "N m"}});
    static constexpr auto channels = sivid::channels({{"q1", "rad"}, {"q2", "rad"}, {"q3", "rad"}});
    static constexpr auto constants = sivid::constants({{"a", "kg m^2", 0.4_dec},
                                                        {"b", "kg m^2", 0.15_dec},
                                                        {"c", "kg m^2", 0.12_dec},
                                                        {"f1", "N m s", 0.4_dec},
                                                        {"f2", "N m s", 0.5_dec},
                                                        {"f3", "N m s", 0.2_dec},
                                                        {"g2", "N m", 9_dec},
                                                        {"g3", "N m", 3_dec}});
    template <class T>
    matrix_of<turning_arm, T> mass(T const&, vec<T, 6> const& x, vec<T, 8> const& p,
                                   vec<T, 3> const&) const {
        auto const &a = p[0], &b = p[1], &c = p[2];
        T const near = cos(x[1]), far = cos(x[1] + x[2]), bend = cos(x[2]);
        T const m11 = 0.2_dec + a * sqr(near) + b * sqr(far) + 2 * c * near * far,
                m22 = 0.3_dec + a + b + 2 * c * bend, m23 = b + c * bend, m33 = 0.1_dec + b;
        return {{{1, 0, 0, 0, 0, 0},
                 {0, 1, 0, 0, 0, 0},
                 {0, 0, 1, 0, 0, 0},
                 {0, 0, 0, m11, 0, 0},
                 {0, 0, 0, 0, m22, m23},
                 {0, 0, 0, 0, m23, m33}}};
    }
    template <class T>
    vec<T, 6> force(T const&, vec<T, 6> const& x, vec<T, 8> const& p, vec<T, 3> const& u) const {
        auto const &a = p[0], &b = p[1], &c = p[2], &w1 = x[3], &w2 = x[4], &w3 = x[5];
        T const near = cos(x[1]), far = cos(x[1] + x[2]), rise = sin(x[1]), up = sin(x[1] + x[2]);
        // Halves of the slopes of m11 by q2 and q3, and of m22 by q3.
        T const s2 = -a * near * rise - b * far * up - c * (rise * far + near * up),
                s3 = -b * far * up - c * near * up, h = c * sin(x[2]);
        return {w1,
                w2,
                w3,
                u[0] - p[3] * w1 - 2 * w1 * (s2 * w2 + s3 * w3),
                u[1] - p[4] * w2 + h * w3 * (2 * w2 + w3) + s2 * sqr(w1) - p[6] * near - p[7] * far,
                u[2] - p[5] * w3 - h * sqr(w2) + s3 * sqr(w1) - p[7] * far};
    }
    template <class T>
    vec<T, 3> observe(T const&, vec<T, 6> const& x, vec<T, 8> const&, vec<T, 3> const&) const {
        return {x[0], x[1], x[2]};
    }
};

/// A car on one track whose tyres follow Pacejka's formula; everything is measured.
struct car {
    static constexpr auto name = "car";
    static constexpr auto states = sivid::states({{"x", "m", 2000},
                                                  {"y", "m", 2000},
                                                  {"psi", "rad", 50},
                                                  {"vx", "m/s", 50},
                                                  {"vy", "m/s", 20},
                                                  {"r", "rad/s", 5}});
    static constexpr auto inputs = sivid::inputs({{"delta", "rad"}, {"push", "m/s^2"}});
    static constexpr auto channels = sivid::channels(
        {{"x", "m"}, {"y", "m"}, {"psi", "rad"}, {"vx", "m/s"}, {"vy", "m/s"}, {"r", "rad/s"}});
    static constexpr auto constants = sivid::constants({{"Bf", "1/rad", 9_dec},
                                                        {"Cf", "1", 1.4_dec},
                                                        {"Df", "N", 7800_dec},
                                                        {"Br", "1/rad", 10_dec},
                                                        {"Cr", "1", 1.4_dec},
                                                        {"Dr", "N", 7000_dec}});
    template <class T>
    vec<T, 6> rate(T const&, vec<T, 6> const& s, vec<T, 6> const& c, vec<T, 2> const& u) const {
        auto const& [x, y, psi, vx, vy, r] = s;
        auto const& [Bf, Cf, Df, Br, Cr, Dr] = c;
        double const mass = 1500, inertia = 2250, a = 1.2, b = 1.4;
        T const front = Df * sin(Cf * atan(Bf * (u[0] - atan((vy + a * r) / vx))));
        T const rear = Dr * sin(Cr * atan(Br * (-atan((vy - b * r) / vx))));
        return {vx * cos(psi) - vy * sin(psi),
                vx * sin(psi) + vy * cos(psi),
                r,
                u[1] + vy * r - front * sin(u[0]) / mass,
                (front * cos(u[0]) + rear) / mass - vx * r,
                (a * front * cos(u[0]) - b * rear) / inertia};
    }
    template <class T>
    vec<T, 6> observe(T const&, vec<T, 6> const& s, vec<T, 6> const&, vec<T, 2> const&) const {
        return s;
    }
};

/// A quadrotor: place, attitude and rates are measured; drag and mass and inertia are unknown.
struct quadrotor {
    static constexpr auto name = "quadrotor";
    static constexpr auto states = sivid::states({{"x", "m", 50},
                                                  {"y", "m", 50},
                                                  {"z", "m", 50},
                                                  {"phi", "rad", 1},
                                                  {"theta", "rad", 1},
                                                  {"psi", "rad", 10},
                                                  {"vx", "m/s", 20},
                                                  {"vy", "m/s", 20},
                                                  {"vz", "m/s", 20},
                                                  {"p", "rad/s", 10},
                                                  {"q", "rad/s", 10},
                                                  {"r", "rad/s", 10}});
    static constexpr auto inputs =
        sivid::inputs({{"F", "N"}, {"Tx", "N m"}, {"Ty", "N m"}, {"Tz", "N m"}});
    static constexpr auto channels = sivid::channels({{"x", "m"},
                                                      {"y", "m"},
                                                      {"z", "m"},
                                                      {"phi", "rad"},
                                                      {"theta", "rad"},
                                                      {"psi", "rad"},
                                                      {"p", "rad/s"},
                                                      {"q", "rad/s"},
                                                      {"r", "rad/s"}});
    static constexpr auto constants = sivid::constants({{"m", "kg", 1.2_dec},
                                                        {"Ix", "kg m^2", 0.012_dec},
                                                        {"Iy", "kg m^2", 0.013_dec},
                                                        {"Iz", "kg m^2", 0.022_dec},
                                                        {"d", "kg/s", 0.3_dec},
                                                        {"e", "N m s", 0.004_dec}});
    template <class T>
    vec<T, 12> rate(T const&, vec<T, 12> const& s, vec<T, 6> const& c, vec<T, 4> const& u) const {
        auto const& [x, y, z, phi, theta, psi, vx, vy, vz, p, q, r] = s;
        auto const& [m, Ix, Iy, Iz, d, e] = c;
        T const sf = sin(phi), cf = cos(phi), st = sin(theta), ct = cos(theta), sp = sin(psi),
                cp = cos(psi), f = u[0] / m, turn = q * sf + r * cf;
        return {vx,
                vy,
                vz,
                p + turn * st / ct,
                q * cf - r * sf,
                turn / ct,
                f * (cf * st * cp + sf * sp) - d / m * vx,
                f * (cf * st * sp - sf * cp) - d / m * vy,
                f * cf * ct - 9.81 - d / m * vz,
                ((Iy - Iz) * q * r + u[1] - e * p) / Ix,
                ((Iz - Ix) * p * r + u[2] - e * q) / Iy,
                ((Ix - Iy) * p * q + u[3] - e * r) / Iz};
    }
    template <class T>
    vec<T, 9> observe(T const&, vec<T, 12> const& s, vec<T, 6> const&, vec<T, 4> const&) const {
        return {s[0], s[1], s[2], s[3], s[4], s[5], s[9], s[10], s[11]};
    }
};

/// A battery as two RC links behind its open-circuit voltage; the voltage is measured.
struct battery {
    static constexpr auto name = "battery";
    static constexpr auto states =
        sivid::states({{"v1", "V", 5}, {"v2", "V", 5}, {"charge", "1", 2}});
    static constexpr auto inputs = sivid::inputs({{"I", "A"}});
    static constexpr auto channels = sivid::channels({{"V", "V"}});
    static constexpr auto constants = sivid::constants({{"R0", "Ohm", 0.02_dec},
                                                        {"R1", "Ohm", 0.015_dec},
                                                        {"C1", "F", 2000_dec},
                                                        {"R2", "Ohm", 0.03_dec},
                                                        {"C2", "F", 20000_dec}});
    template <class T>
    vec<T, 3> rate(T const&, vec<T, 3> const& x, vec<T, 5> const& c, vec<T, 1> const& u) const {
        return {(u[0] - x[0] / c[1]) / c[2], (u[0] - x[1] / c[3]) / c[4], -u[0] / 18000};
    }
    template <class T>
    vec<T, 1> observe(T const&, vec<T, 3> const& x, vec<T, 5> const& c, vec<T, 1> const& u) const {
        return {3.4 + 0.9 * x[2] - 0.6 * sqr(x[2]) + 0.5 * pown(x[2], 3) - c[0] * u[0] - x[0] -
                x[1]};
    }
};

/// A quadrotor's altitude: thrust with a lag, quadratic drag; only the altitude is measured.
struct altitude {
    static constexpr auto name = "altitude";
    static constexpr auto states =
        sivid::states({{"z", "m", 20}, {"v", "m/s", 10}, {"f", "m/s^2", 30}});
    static constexpr auto inputs = sivid::inputs({{"pwm", "1"}});
    static constexpr auto channels = sivid::channels({{"z", "m"}});
    static constexpr auto constants = sivid::constants(
        {{"k", "m/s^2", 0.011_dec}, {"tau", "s", 0.06_dec}, {"drag", "1/m", 0.06_dec}});
    template <class T>
    vec<T, 3> rate(T const&, vec<T, 3> const& x, vec<T, 3> const& c, vec<T, 1> const& u) const {
        return {x[1], x[2] - 9.81 - c[2] * x[1] * abs(x[1]), (c[0] * u[0] - x[2]) / c[1]};
    }
    template <class T>
    vec<T, 1> observe(T const&, vec<T, 3> const& x, vec<T, 3> const&, vec<T, 1> const&) const {
        return {x[0]};
    }
};

/// The barrel of an extruder, above the surroundings: the mains limit its heater to a share of 3
/// kW; only the barrel is measured.
struct barrel {
    static constexpr auto name = "barrel";
    static constexpr auto states = sivid::states({{"heater", "K", 400}, {"barrel", "K", 300}});
    static constexpr auto inputs = sivid::inputs({{"u", "1"}});
    static constexpr auto channels = sivid::channels({{"barrel", "K"}});
    static constexpr auto constants = sivid::constants({{"Ch", "J/K", 2150_dec},
                                                        {"Cb", "J/K", 9300_dec},
                                                        {"kh", "W/K", 43_dec},
                                                        {"kb", "W/K", 8.6_dec},
                                                        {"most", "1", 0.78_dec}});
    template <class T>
    vec<T, 2> rate(T const&, vec<T, 2> const& x, vec<T, 5> const& c, vec<T, 1> const& u) const {
        T const into = c[2] * (x[0] - x[1]);
        return {(3000 * min(u[0], c[4]) - into) / c[0], (into - c[3] * x[1]) / c[1]};
    }
    template <class T>
    vec<T, 1> observe(T const&, vec<T, 2> const& x, vec<T, 5> const&, vec<T, 1> const&) const {
        return {x[1]};
    }
};

/// Masses in a row between springs and dampers, the first one pushed; all places are measured.
struct chain {
    static constexpr std::size_t masses = 6;
    static constexpr auto name = "chain";
    static constexpr auto states = sivid::states({{"x1", "m", 5},
                                                  {"x2", "m", 5},
                                                  {"x3", "m", 5},
                                                  {"x4", "m", 5},
                                                  {"x5", "m", 5},
                                                  {"x6", "m", 5},
                                                  {"v1", "m/s", 9},
                                                  {"v2", "m/s", 9},
                                                  {"v3", "m/s", 9},
                                                  {"v4", "m/s", 9},
                                                  {"v5", "m/s", 9},
                                                  {"v6", "m/s", 9}});
    static constexpr auto inputs = sivid::inputs({{"F", "N"}});
    static constexpr auto channels = sivid::channels(
        {{"x1", "m"}, {"x2", "m"}, {"x3", "m"}, {"x4", "m"}, {"x5", "m"}, {"x6", "m"}});
    static constexpr auto constants = sivid::constants({{"k1", "N/m", 3_dec},
                                                        {"k2", "N/m", 4_dec},
                                                        {"k3", "N/m", 5_dec},
                                                        {"k4", "N/m", 3_dec},
                                                        {"k5", "N/m", 4_dec},
                                                        {"k6", "N/m", 5_dec},
                                                        {"d1", "N s/m", 0.2_dec},
                                                        {"d2", "N s/m", 0.3_dec},
                                                        {"d3", "N s/m", 0.2_dec},
                                                        {"d4", "N s/m", 0.3_dec},
                                                        {"d5", "N s/m", 0.2_dec},
                                                        {"d6", "N s/m", 0.3_dec}});
    template <class T>
    vec<T, 12> rate(T const&, vec<T, 12> const& x, vec<T, 12> const& c, vec<T, 1> const& u) const {
        vec<T, 12> f;
        for (std::size_t i = 0; i < masses; ++i) {
            auto const pull = [&](std::size_t k) { // of spring k: from mass k - 1, or the wall
                T const dx = k == 0 ? x[0] : x[k] - x[k - 1];
                T const dv = k == 0 ? x[masses] : x[masses + k] - x[masses + k - 1];
                return c[k] * dx + c[masses + k] * dv;
            };
            f[i] = x[masses + i];
            T force = -pull(i);
            if (i + 1 < masses) force = force + pull(i + 1);
            f[masses + i] = i == 0 ? force + u[0] : force;
        }
        return f;
    }
    template <class T>
    vec<T, 6> observe(T const&, vec<T, 12> const& x, vec<T, 12> const&, vec<T, 1> const&) const {
        return {x[0], x[1], x[2], x[3], x[4], x[5]};
    }
};

/// x1 ... xN, as quantities of a kind.
template <class Quantity, std::size_t N>
constexpr std::array<Quantity, N> numbered(std::string_view unit) {
    static_assert(N < 100);
    constexpr auto digits = std::string_view("x1x2x3x4x5x6x7x8x9x10x11x12x13x14x15x16x17x18x19x20"
                                             "x21x22x23x24x25x26x27x28x29x30x31x32x33x34x35x36x37"
                                             "x38x39x40x41x42x43x44x45x46x47x48x49x50x51x52x53x54"
                                             "x55x56x57x58x59x60x61x62x63x64");
    std::array<Quantity, N> all{};
    std::size_t at = 0;
    for (std::size_t i = 0; i < N; ++i) {
        std::size_t const length = i < 9 ? 2 : 3;
        all[i].name = digits.substr(at, length);
        all[i].unit = unit;
        if constexpr (requires { all[i].limit; }) all[i].limit = 10;
        at += length;
    }
    return all;
}

/// N/2 equal masses between equal springs and dampers; all places are measured.
template <std::size_t N>
struct long_chain {
    static constexpr auto name = "long chain";
    static constexpr auto states = numbered<state_quantity, N>("m");
    static constexpr auto inputs = sivid::inputs({{"F", "N"}});
    static constexpr auto channels = numbered<quantity, N / 2>("m");
    static constexpr auto constants =
        sivid::constants({{"k", "N/m", 4_dec}, {"d", "N s/m", 0.3_dec}});
    template <class T>
    vec<T, N> rate(T const&, vec<T, N> const& x, vec<T, 2> const& c, vec<T, 1> const& u) const {
        constexpr std::size_t n = N / 2;
        vec<T, N> f;
        auto const pull = [&](std::size_t k) {
            T const dx = k == 0 ? x[0] : x[k] - x[k - 1];
            T const dv = k == 0 ? x[n] : x[n + k] - x[n + k - 1];
            return c[0] * dx + c[1] * dv;
        };
        for (std::size_t i = 0; i < n; ++i) {
            f[i] = x[n + i];
            T force = -pull(i);
            if (i + 1 < n) force = force + pull(i + 1);
            f[n + i] = i == 0 ? force + u[0] : force;
        }
        return f;
    }
    template <class T>
    vec<T, N / 2> observe(T const&, vec<T, N> const& x, vec<T, 2> const&, vec<T, 1> const&) const {
        vec<T, N / 2> y;
        for (std::size_t i = 0; i < N / 2; ++i) y[i] = x[i];
        return y;
    }
};

/// Reactions one after the other, the first one fed; every fourth is measured.
template <std::size_t N>
struct cascade {
    static constexpr auto name = "cascade";
    static constexpr auto states = numbered<state_quantity, N>("1");
    static constexpr auto inputs = sivid::inputs({{"F", "1/s"}});
    static constexpr auto channels = numbered<quantity, (N + 3) / 4>("1");
    static constexpr auto constants =
        sivid::constants({{"k", "1/s", 3_dec}, {"loss", "1/s", 0.05_dec}});
    template <class T>
    vec<T, N> rate(T const&, vec<T, N> const& x, vec<T, 2> const& c, vec<T, 1> const& u) const {
        vec<T, N> f;
        for (std::size_t i = 0; i < N; ++i) {
            T const fed = i == 0 ? u[0] : c[0] * x[i - 1];
            f[i] = fed - (c[0] + c[1]) * x[i];
        }
        return f;
    }
    template <class T>
    vec<T, (N + 3) / 4> observe(T const&, vec<T, N> const& x, vec<T, 2> const&,
                                vec<T, 1> const&) const {
        vec<T, (N + 3) / 4> y;
        for (std::size_t i = 0; i < y.size(); ++i) y[i] = x[4 * i];
        return y;
    }
};

/// A driven mass on a spring; its place is measured.
struct oscillator {
    static constexpr auto name = "oscillator";
    static constexpr auto states = sivid::states({{"x", "m", 10}, {"v", "m/s", 20}});
    static constexpr auto inputs = sivid::inputs({{"F", "N"}});
    static constexpr auto channels = sivid::channels({{"x", "m"}});
    static constexpr auto constants =
        sivid::constants({{"k", "N/m", 4_dec}, {"d", "N s/m", 0.5_dec}, {"b", "1", 1_dec}});
    template <class T>
    vec<T, 2> rate(T const&, vec<T, 2> const& x, vec<T, 3> const& c, vec<T, 1> const& u) const {
        return {x[1], c[2] * u[0] - c[0] * x[0] - c[1] * x[1]};
    }
    template <class T>
    vec<T, 1> observe(T const&, vec<T, 2> const& x, vec<T, 3> const&, vec<T, 1> const&) const {
        return {x[0]};
    }
};

/// A motor's speed.
struct motor {
    static constexpr auto name = "motor";
    static constexpr auto states = sivid::states({{"w", "rad/s", 100}});
    static constexpr auto inputs = sivid::inputs({{"V", "V"}});
    static constexpr auto channels = sivid::channels({{"w", "rad/s"}});
    static constexpr auto constants =
        sivid::constants({{"a", "1/s", 2_dec}, {"b", "rad/(V s^2)", 5_dec}});
    template <class T>
    vec<T, 1> rate(T const&, vec<T, 1> const& x, vec<T, 2> const& c, vec<T, 1> const& u) const {
        return {c[1] * u[0] - c[0] * x[0]};
    }
    template <class T>
    vec<T, 1> observe(T const&, vec<T, 1> const& x, vec<T, 2> const&, vec<T, 1> const&) const {
        return x;
    }
};

} // namespace robots

#endif
