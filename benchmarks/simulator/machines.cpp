// SPDX-License-Identifier: MIT
#include "machines.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string_view>

namespace simulator {
namespace {

constexpr double gravity = 9.81, encoder = 2 * std::numbers::pi / 4096;

/// A text with numbers for {0}, {1}, ... as they are; {name} is the size of what is withheld where
/// that has the name, else 0.
std::string filled(std::string_view text, values const& constants, withheld const& w) {
    std::ostringstream out;
    out.precision(17);
    while (!text.empty()) {
        auto const begin = text.find('{'), end = text.find('}', begin);
        out << text.substr(0, begin);
        if (begin == text.npos) break;
        std::string const name{text.substr(begin + 1, end - begin - 1)};
        bool const number = name.find_first_not_of("0123456789") == name.npos;
        out << (number ? constants[std::stoul(name)] : name == w.name ? w.size : 0.0);
        text.remove_prefix(end + 1);
    }
    return out.str();
}

/// What all files begin with. The constraint that stands for dry friction is as stiff as its steps
/// allow: the slip of a joint at rest stays far below the noise.
constexpr std::string_view head = R"(<mujoco><compiler angle="radian"/>
<option timestep="0.0005" integrator="RK4" gravity="{floor_tilt} 0 -9.81" tolerance="1e-12" iterations="50"/>
<default><joint solreffriction="0.002 1" solimpfriction="0.99 0.999 0.001"/></default>
)";

double swing(double t, values const& d) {
    return d[0] * std::sin(d[1] * t) + d[2] * std::sin(d[3] * t + 1);
}
double held(double u, double most) { return std::clamp(u, -most, most); }

} // namespace

machine lever() {
    machine m;
    m.name = "lever";
    m.states = {"q", "w"};
    m.inputs = {"u"};
    m.channels = {"q"};
    m.noise = {0.001};
    m.step = {encoder};
    m.constants = {"mass", "viscous"};
    m.model = R"toml(format = "sivid-model-1"
name = "lever"
states = { q = "4 rad", w = "30 rad/s" }
inputs.u = "N m"
constants.mass = { value = "0.5 kg", prior = "[0.4, 0.6] kg" }
constants.viscous = { value = "0.01 N m s", prior = "[0, 0.04] N m s" }
constants.inertia = "0.006 kg m^2"
constants.middle = "0.25 m"
constants.end = "0.4 m"
constants.load = "0 kg"
equations.q = "w"
equations.w = """(u - viscous*w - (mass*middle + load*end)*9.81 [m/s^2]*sin(q))
                 /(inertia + mass*middle^2 + load*end^2)"""
outputs.q = "q"

[effect.coulomb]
constants.k = "[0, 0.3] N m"
inputs = "u -= k*sign(w)"
[effect.armature]
constants.J = "[0, 0.03] kg m^2"
inputs = "inertia += J"
[effect.command_delay]
kind = "input_delay"
of = "u"
prior = "[0, 0.1] s"
[effect.payload]
constants.m = "[0, 0.3] kg"
inputs = "load += m"
[effect.weak_motor]
constants.k = [0, 0.5]
inputs = "u -= k*u"
[effect.late_sensor]
kind = "sensor_latency"
of = ["q"]
prior = "[0, 0.1] s"
[effect.longer]
constants.d = "[-0.1, 0.1] m"
inputs = "middle += d"
[effect.rubber_stop]
constants.k = "[0, 20] N m/rad"
inputs = "u -= k*max(0, q - 0.5 [rad])"
[effect.offset]
constants.k = "[-0.5, 0.5] N m"
inputs = "u += k"
[effect.sensor_bias]
kind = "sensor_bias"
of = "q"
prior = "[-0.1, 0.1] rad"
[effect.air_drag]
constants.k = "[0, 0.02] N m s^2"
inputs = "u -= k*w*abs(w)"
)toml";
    m.parameters = R"("mass": {"prior": [0.4, 0.6], "unit": "kg"},
    "viscous": {"prior": [0, 0.04], "unit": "N m s"})";
    m.mjcf = [](values const& c, withheld const& w) {
        values all = c;
        all.push_back(-0.25 - (w.name == "longer" ? w.size : 0));
        all.push_back(1 - (w.name == "weak_motor" ? w.size : 0));
        std::string const slack = w.name == "backlash" ? R"(<body><inertial pos="0 0 0" mass="1e-6"
          diaginertia="0.001 0.001 0.001"/><joint name="q" type="hinge" axis="0 1 0" damping="{1}"/>
          <body><joint name="slack" type="hinge" axis="0 1 0" limited="true" damping="0.0005"
          range="-{backlash} {backlash}" solreflimit="0.004 1"/>)"
                                                       : R"(<body><joint name="q" type="hinge"
          axis="0 1 0" damping="{1}" armature="{armature}" frictionloss="{coulomb}"/>)";
        std::string const load = w.name == "payload" ? R"(<body pos="0 0 -0.4"><inertial pos="0 0 0"
          mass="{payload}" diaginertia="1e-9 1e-9 1e-9"/></body>)"
                                                     : "";
        return filled(
            std::string(head) + "<worldbody>" + slack +
                R"(<inertial pos="0 0 {2}" mass="{0}" diaginertia="0.006 0.006 0.006"/>)" + load +
                (w.name == "backlash" ? "</body>" : "") + R"(</body></worldbody>
          <actuator><motor joint="q" gear="{3}"/></actuator></mujoco>)",
            all, w);
    };
    m.draw = [](std::mt19937_64& r) {
        return values{uniform(r, 0.45, 0.55), uniform(r, 0.005, 0.02)};
    };
    m.kinds = {{"coulomb", 0.03, 0.1},
               {"armature", 0.004, 0.015},
               {"command_delay", 0.02, 0.06, way::by_input},
               {"payload", 0.03, 0.15},
               {"weak_motor", 0.1, 0.35},
               {"late_sensor", 0.02, 0.06, way::by_channel},
               {"longer", 0.02, 0.06},
               {"rubber_stop", 1, 6, way::by_rubber},
               {"backlash", 0.01, 0.03, way::by_file, 0, false}};
    m.law = [](double t, values const& q, values const& w, values const& d) {
        return values{held(1.2 * std::sin(q[0]) + 3 * (swing(t, d) - q[0]) - 0.15 * w[0], 3)};
    };
    m.start = {0.2, 0.6};
    m.stop = 0.5;
    return m;
}

machine rover() {
    machine m;
    m.name = "rover";
    m.states = {"x", "y", "psi", "vx", "vy", "r"};
    m.inputs = {"left", "right"};
    m.channels = {"x", "y", "psi"};
    m.noise = {0.002, 0.002, 0.001};
    m.step = {0.001, 0.001, 0.0005};
    m.constants = {"mass", "inertia", "drag", "turn_drag"};
    m.model = R"toml(format = "sivid-model-1"
name = "rover"
states = { x = "10 m", y = "10 m", psi = "6 rad", vx = "5 m/s", vy = "5 m/s", r = "10 rad/s" }
inputs = { left = "N", right = "N" }
constants.mass = { value = "2 kg", prior = "[1.6, 2.4] kg" }
constants.inertia = { value = "0.05 kg m^2", prior = "[0.03, 0.07] kg m^2" }
constants.drag = { value = "1 N s/m", prior = "[0.3, 2] N s/m" }
constants.turn_drag = { value = "0.05 N m s", prior = "[0.01, 0.1] N m s" }
constants.arm = "0.15 m"
constants.push = "0 N"
equations.x = "vx"
equations.y = "vy"
equations.psi = "r"
equations.vx = "((left + right)*cos(psi) + push - drag*vx)/mass"
equations.vy = "((left + right)*sin(psi) - drag*vy)/mass"
equations.r = "((right - left)*arm - turn_drag*r)/inertia"
outputs = { x = "x", y = "y", psi = "psi" }

[effect.bearing_friction]
constants.k = "[0, 0.2] N m"
equations = "r' -= k*sign(r)/inertia"
[effect.floor_tilt]
kind = "constant_rate"
of = "vx"
prior = "[-1, 1] m/s^2"
[effect.side_wind]
kind = "constant_rate"
of = "vy"
prior = "[-1, 1] m/s^2"
[effect.weak_left]
constants.k = [0, 0.5]
inputs = "left -= k*left"
[effect.weak_right]
constants.k = [0, 0.5]
inputs = "right -= k*right"
[effect.late_left]
kind = "input_delay"
of = "left"
prior = "[0, 0.3] s"
[effect.late_right]
kind = "input_delay"
of = "right"
prior = "[0, 0.3] s"
[effect.late_compass]
kind = "sensor_latency"
of = ["psi"]
prior = "[0, 0.3] s"
[effect.rubber_wall]
constants.k = "[0, 30] N/m"
inputs = "push -= k*max(0, x - 0.4 [m])"
[effect.water_drag]
kind = "quadratic_damping"
of = "vx"
prior = "[0, 1] 1/m"
[effect.compass_bias]
kind = "sensor_bias"
of = "psi"
prior = "[-0.2, 0.2] rad"
)toml";
    m.parameters = R"("mass": {"prior": [1.6, 2.4], "unit": "kg"},
    "inertia": {"prior": [0.03, 0.07], "unit": "kg m^2"},
    "drag": {"prior": [0.3, 2], "unit": "N s/m"},
    "turn_drag": {"prior": [0.01, 0.1], "unit": "N m s"})";
    m.mjcf = [](values const& c, withheld const& w) {
        values all = c;
        for (auto const* side : {"weak_left", "weak_right"})
            all.push_back(1 - (w.name == side ? w.size : 0));
        return filled(std::string(head) + R"(<worldbody><body>
          <inertial pos="0 0 0" mass="{0}" diaginertia="{1} {1} {1}"/>
          <joint name="x" type="slide" axis="1 0 0" damping="{2}"/>
          <joint name="y" type="slide" axis="0 1 0" damping="{2}"/>
          <joint name="psi" type="hinge" axis="0 0 1" damping="{3}" frictionloss="{bearing_friction}"/>
          <site name="left" pos="0 0.15 0"/><site name="right" pos="0 -0.15 0"/>
          </body></worldbody>
          <actuator><motor site="left" gear="{4} 0 0 0 0 0"/>
          <motor site="right" gear="{5} 0 0 0 0 0"/></actuator></mujoco>)",
                      all, w);
    };
    m.draw = [](std::mt19937_64& r) {
        return values{uniform(r, 1.7, 2.3), uniform(r, 0.04, 0.06), uniform(r, 0.6, 1.5),
                      uniform(r, 0.03, 0.07)};
    };
    m.kinds = {{"bearing_friction", 0.02, 0.06},
               {"floor_tilt", 0.1, 0.4},
               {"weak_left", 0.1, 0.3},
               {"late_left", 0.05, 0.2, way::by_input},
               {"late_compass", 0.05, 0.2, way::by_channel, 2},
               {"rubber_wall", 3, 15, way::by_rubber}};
    m.law = [](double t, values const&, values const&, values const& d) {
        double const s = swing(t, d), turn = 0.25 * std::sin(1.7 * d[1] * t + d[3]);
        return values{held(1.5 + s - turn, 4), held(1.5 + s + turn, 4)};
    };
    m.start = {0, 0};
    m.stop = 0.4;
    return m;
}

machine arm() {
    machine m;
    m.name = "arm";
    m.states = {"q1", "q2", "w1", "w2"};
    m.inputs = {"u1", "u2"};
    m.channels = {"q1", "q2"};
    m.noise = {0.001, 0.001};
    m.step = {encoder, encoder};
    m.constants = {"m2", "b1", "b2"};
    m.model = R"toml(format = "sivid-model-1"
name = "arm"
equations = """
q1' = w1
q2' = w2
far = m2*c2 + load*e
about2 = J2 + m2*c2^2 + load*e^2
both = about2 + far*l*cos(q2)
fall = 9.81 [m/s^2]*far*sin(q1 + q2)
(J1 + m1*c1^2 + (m2 + load)*l^2 + about2 + 2*far*l*cos(q2))*w1' + both*w2' = u1 - b1*w1 + far*l*sin(q2)*(2*w1*w2 + w2^2)
    - fall - 9.81 [m/s^2]*(m1*c1 + (m2 + load)*l)*sin(q1)
both*w1' + (about2 + rotor)*w2' = u2 - b2*w2 - far*l*sin(q2)*w1^2 - fall
"""
states = { q1 = "4 rad", q2 = "4 rad", w1 = "30 rad/s", w2 = "30 rad/s" }
inputs = { u1 = "N m", u2 = "N m" }
[constants]
m1 = "0.8 kg"
m2 = { value = "0.5 kg", prior = "[0.4, 0.6] kg" }
b1 = { value = "0.1 N m s", prior = "[0, 0.3] N m s" }
b2 = { value = "0.1 N m s", prior = "[0, 0.3] N m s" }
l = "0.3 m"
c1 = "0.15 m"
c2 = "0.15 m"
e = "0.3 m"
J1 = "0.008 kg m^2"
J2 = "0.005 kg m^2"
load = "0 kg"
rotor = "0 kg m^2"
[outputs]
q1 = "q1"
q2 = "q2"

[effect.coulomb_1]
constants.k = "[0, 0.5] N m"
inputs = "u1 -= k*sign(w1)"
[effect.coulomb_2]
constants.k = "[0, 0.5] N m"
inputs = "u2 -= k*sign(w2)"
[effect.armature_2]
constants.J = "[0, 0.03] kg m^2"
inputs = "rotor += J"
[effect.payload]
constants.m = "[0, 0.3] kg"
inputs = "load += m"
[effect.weak_motor_1]
constants.k = [0, 0.5]
inputs = "u1 -= k*u1"
[effect.weak_motor_2]
constants.k = [0, 0.5]
inputs = "u2 -= k*u2"
[effect.late_command_2]
kind = "input_delay"
of = "u2"
prior = "[0, 0.1] s"
[effect.late_sensor_2]
kind = "sensor_latency"
of = ["q2"]
prior = "[0, 0.1] s"
[effect.offset_1]
constants.k = "[-0.5, 0.5] N m"
inputs = "u1 += k"
[effect.bias_2]
kind = "sensor_bias"
of = "q2"
prior = "[-0.1, 0.1] rad"
)toml";
    m.parameters = R"("m2": {"prior": [0.4, 0.6], "unit": "kg"},
    "b1": {"prior": [0, 0.3], "unit": "N m s"}, "b2": {"prior": [0, 0.3], "unit": "N m s"})";
    m.mjcf = [](values const& c, withheld const& w) {
        values all = c;
        for (auto const* motor : {"weak_motor_1", "weak_motor_2"})
            all.push_back(1 - (w.name == motor ? w.size : 0));
        std::string const load = w.name == "payload" ? R"(<body pos="0 0 -0.3"><inertial pos="0 0 0"
          mass="{payload}" diaginertia="1e-9 1e-9 1e-9"/></body>)"
                                                     : "";
        return filled(std::string(head) + R"(<worldbody><body>
          <inertial pos="0 0 -0.15" mass="0.8" diaginertia="0.008 0.008 0.008"/>
          <joint name="q1" type="hinge" axis="0 1 0" damping="{1}" frictionloss="{coulomb_1}"/>
          <body pos="0 0 -0.3"><inertial pos="0 0 -0.15" mass="{0}" diaginertia="0.005 0.005 0.005"/>
          <joint name="q2" type="hinge" axis="0 1 0" damping="{2}" armature="{armature_2}"
          frictionloss="{coulomb_2}"/>)" +
                          load +
                          R"(</body></body></worldbody><actuator><motor joint="q1" gear="{3}"/>
          <motor joint="q2" gear="{4}"/></actuator></mujoco>)",
                      all, w);
    };
    m.draw = [](std::mt19937_64& r) {
        return values{uniform(r, 0.45, 0.55), uniform(r, 0.05, 0.2), uniform(r, 0.05, 0.2)};
    };
    m.kinds = {{"coulomb_1", 0.1, 0.3},
               {"coulomb_2", 0.05, 0.2},
               {"armature_2", 0.004, 0.015},
               {"payload", 0.03, 0.15},
               {"weak_motor_2", 0.15, 0.35},
               {"late_command_2", 0.02, 0.06, way::by_input, 1},
               {"late_sensor_2", 0.02, 0.06, way::by_channel, 1}};
    m.law = [](double t, values const& q, values const& w, values const& d) {
        double const one = swing(t, d), two = 0.8 * std::sin(1.7 * d[1] * t + d[3]);
        return values{held(2 * std::sin(q[0]) + 6 * (one - q[0]) - 0.6 * w[0], 8),
                      held(3 * (two - q[1]) - 0.2 * w[1], 4)};
    };
    m.start = {0.2, 0.6};
    return m;
}

machine turning_arm() {
    machine m;
    m.name = "turning_arm";
    m.states = {"q1", "q2", "q3", "w1", "w2", "w3"};
    m.inputs = {"u1", "u2", "u3"};
    m.channels = {"q1", "q2", "q3"};
    m.noise = {0.001, 0.001, 0.001};
    m.step = {encoder, encoder, encoder};
    m.constants = {"m3", "b1", "b2", "b3"};
    m.model = R"toml(format = "sivid-model-1"
name = "turning_arm"
about = "a column that turns, a shoulder and an elbow; thin links hang down at 0"
equations = """
q1' = w1
q2' = w2
q3' = w3
moment = m3*c3 + load*e
near = J2 + m2*c2^2 + (m3 + load)*l^2
far = J3 + m3*c3^2 + load*e^2
bend = moment*l*cos(q3)
h = moment*l*sin(q3)
turn2 = near*sin(q2)*cos(q2) + far*sin(q2 + q3)*cos(q2 + q3) + moment*l*sin(2*q2 + q3)
turn3 = far*sin(q2 + q3)*cos(q2 + q3) + moment*l*sin(q2)*cos(q2 + q3)
fall = 9.81 [m/s^2]*moment*sin(q2 + q3)
(J1 + near*sin(q2)^2 + far*sin(q2 + q3)^2 + 2*moment*l*sin(q2)*sin(q2 + q3))*w1' = u1 - b1*w1 - 2*w1*(turn2*w2 + turn3*w3)
(rotor2 + near + far + 2*bend)*w2' + (far + bend)*w3' = u2 - b2*w2 + h*w3*(2*w2 + w3) + turn2*w1^2 - fall
    - 9.81 [m/s^2]*(m2*c2 + (m3 + load)*l)*sin(q2)
(far + bend)*w2' + (rotor3 + far)*w3' = u3 - b3*w3 - h*w2^2 + turn3*w1^2 - fall
"""
states = { q1 = "4 rad", q2 = "4 rad", q3 = "4 rad", w1 = "30 rad/s", w2 = "30 rad/s", w3 = "30 rad/s" }
inputs = { u1 = "N m", u2 = "N m", u3 = "N m" }
[constants]
m2 = "0.8 kg"
m3 = { value = "0.5 kg", prior = "[0.4, 0.6] kg" }
b1 = { value = "0.2 N m s", prior = "[0, 0.4] N m s" }
b2 = { value = "0.2 N m s", prior = "[0, 0.4] N m s" }
b3 = { value = "0.1 N m s", prior = "[0, 0.3] N m s" }
l = "0.3 m"
c2 = "0.15 m"
c3 = "0.15 m"
e = "0.3 m"
J1 = "0.1 kg m^2"
J2 = "0.008 kg m^2"
J3 = "0.005 kg m^2"
rotor2 = "0.08 kg m^2"
rotor3 = "0.03 kg m^2"
load = "0 kg"
[outputs]
q1 = "q1"
q2 = "q2"
q3 = "q3"

[effect.coulomb_1]
constants.k = "[0, 0.5] N m"
inputs = "u1 -= k*sign(w1)"
[effect.coulomb_2]
constants.k = "[0, 0.5] N m"
inputs = "u2 -= k*sign(w2)"
[effect.coulomb_3]
constants.k = "[0, 0.5] N m"
inputs = "u3 -= k*sign(w3)"
[effect.armature_3]
constants.J = "[0, 0.05] kg m^2"
inputs = "rotor3 += J"
[effect.payload]
constants.m = "[0, 0.3] kg"
inputs = "load += m"
[effect.weak_motor_2]
constants.k = [0, 0.5]
inputs = "u2 -= k*u2"
[effect.weak_motor_3]
constants.k = [0, 0.5]
inputs = "u3 -= k*u3"
[effect.late_command_3]
kind = "input_delay"
of = "u3"
prior = "[0, 0.1] s"
[effect.late_sensor_3]
kind = "sensor_latency"
of = ["q3"]
prior = "[0, 0.1] s"
[effect.offset_2]
constants.k = "[-0.5, 0.5] N m"
inputs = "u2 += k"
[effect.bias_3]
kind = "sensor_bias"
of = "q3"
prior = "[-0.1, 0.1] rad"
)toml";
    m.parameters = R"("m3": {"prior": [0.4, 0.6], "unit": "kg"},
    "b1": {"prior": [0, 0.4], "unit": "N m s"}, "b2": {"prior": [0, 0.4], "unit": "N m s"},
    "b3": {"prior": [0, 0.3], "unit": "N m s"})";
    m.mjcf = [](values const& c, withheld const& w) {
        values all = c;
        for (auto const* motor : {"weak_motor_2", "weak_motor_3"})
            all.push_back(1 - (w.name == motor ? w.size : 0));
        all.push_back(0.03 + (w.name == "armature_3" ? w.size : 0));
        std::string const load = w.name == "payload" ? R"(<body pos="0 0 -0.3"><inertial pos="0 0 0"
          mass="{payload}" diaginertia="1e-9 1e-9 1e-9"/></body>)"
                                                     : "";
        return filled(std::string(head) + R"(<worldbody><body>
          <inertial pos="0 0 0" mass="1" diaginertia="0.1 0.1 0.1"/>
          <joint name="q1" type="hinge" axis="0 0 1" damping="{1}" frictionloss="{coulomb_1}"/>
          <body><inertial pos="0 0 -0.15" mass="0.8" diaginertia="0.008 0.008 1e-12"/>
          <joint name="q2" type="hinge" axis="0 1 0" damping="{2}" armature="0.08"
          frictionloss="{coulomb_2}"/>
          <body pos="0 0 -0.3"><inertial pos="0 0 -0.15" mass="{0}" diaginertia="0.005 0.005 1e-12"/>
          <joint name="q3" type="hinge" axis="0 1 0" damping="{3}" armature="{6}"
          frictionloss="{coulomb_3}"/>)" +
                          load +
                          R"(</body></body></body></worldbody><actuator><motor joint="q1"/>
          <motor joint="q2" gear="{4}"/><motor joint="q3" gear="{5}"/></actuator></mujoco>)",
                      all, w);
    };
    m.draw = [](std::mt19937_64& r) {
        return values{uniform(r, 0.45, 0.55), uniform(r, 0.1, 0.3), uniform(r, 0.1, 0.3),
                      uniform(r, 0.05, 0.2)};
    };
    m.kinds = {{"coulomb_2", 0.1, 0.3},
               {"coulomb_3", 0.05, 0.2},
               {"armature_3", 0.01, 0.03},
               {"payload", 0.03, 0.15},
               {"weak_motor_3", 0.15, 0.35},
               {"late_command_3", 0.02, 0.06, way::by_input, 2},
               {"late_sensor_3", 0.02, 0.06, way::by_channel, 2}};
    m.law = [](double t, values const& q, values const& w, values const& d) {
        double const one = swing(t, d), two = 0.8 * std::sin(1.7 * d[1] * t + d[3]),
                     three = 0.6 + 0.7 * std::sin(1.3 * d[1] * t + 2);
        return values{held(4 * (one - q[0]) - 0.5 * w[0], 6),
                      held(2 * std::sin(q[1]) + 8 * (three - q[1]) - 0.8 * w[1], 10),
                      held(4 * (two - q[2]) - 0.3 * w[2], 5)};
    };
    m.start = {0.2, 0.6};
    return m;
}

} // namespace simulator
