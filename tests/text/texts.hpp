// SPDX-License-Identifier: MIT
// Texts of models for tests.
#ifndef SIVID_TESTS_TEXT_TEXTS_HPP
#define SIVID_TESTS_TEXT_TEXTS_HPP

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace texts {

/// A motor in units as data sheets have them: everything that the format knows, once.
inline std::string const motor = R"toml(# A motor.
format = "sivid-model-1"
name = "motor"
equations = """
load = c*sign(w)          # Coulomb friction
w' = (kt*i - b*w - load)/J
theta' = w
i' = (u - R*i - kt*w)/L
"""
[states]
w = "400 rad/s"
theta = "[-1000, 1000] rad"
i = "20 A"
[inputs]
u = { unit = "V", delay = "late" }
[constants]
J = { prior = "[0.5, 2] g m^2" }
kt = "0.05 N m/A"
b = { value = "1e-4 N m s", prior = "[0, 1e-3] N m s" }
c = "20 mN m"
R = "0.5 ohm"
L = "1 mH"
late = { value = "10 ms", prior = "[0, 20] ms", unit = "s" }
[outputs]
speed = { equation = "w", unit = "rpm" }
angle = { equation = "theta", unit = "deg" }
i = "i"
[effect.torque]
about = "a torque that nobody knows"
constants.T0 = "[-0.1, 0.1] N m"
equations = "w' += T0/J"
[effect.gain]
order = 1
constants.k = [-0.2, 0.2]
inputs = "u *= 1 + k"
[effect.crossed]
constants.k = [-0.2, 0.2]
outputs = "speed += k*shown(speed)"
[effect.bias]
kind = "sensor_bias"
of = "i"
prior = "[-1, 1] A"
)toml";

/// The text with one part replaced.
inline std::string with(std::string text, std::string const& part, std::string const& by) {
    auto const at = text.find(part);
    if (at == std::string::npos) throw std::logic_error("no such part: " + part);
    return text.replace(at, part.size(), by);
}

inline std::string of_file(std::string const& name) {
    std::ifstream in(std::string(SIVID_SOURCE_DIR "/") + name, std::ios::binary);
    return {std::istreambuf_iterator<char>{in}, {}};
}

} // namespace texts

#endif
