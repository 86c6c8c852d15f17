// SPDX-License-Identifier: MIT
// Robots described in URDF, for tests.
#ifndef SIVID_TESTS_SUPPORT_URDF_TEXTS_HPP
#define SIVID_TESTS_SUPPORT_URDF_TEXTS_HPP

#include "support/random.hpp"

#include <array>
#include <cstddef>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace urdf_texts {

/// A plane arm of two joints that swings in a vertical plane.
inline std::string const arm = [] {
    std::ifstream in(SIVID_SOURCE_DIR "/examples/sivid/arm.urdf", std::ios::binary);
    return std::string{std::istreambuf_iterator<char>{in}, {}};
}();

/// With one part replaced.
inline std::string with(std::string text, std::string const& part, std::string const& by) {
    auto const at = text.find(part);
    if (at == std::string::npos) throw std::logic_error("no such part: " + part);
    return text.replace(at, part.size(), by);
}

/// Random chains and trees: places, axes, centres, inertias and kinds of joints.
class random_robot {
public:
    /// @param products  off the diagonal of moments of inertia
    explicit random_robot(unsigned seed, bool products = false)
        : random_{seed}, products_{products} {}

    /// @param branches  joints hang on any link before, not on the last one
    std::string operator()(std::size_t joints, bool branches = false) {
        // MuJoCo's sums of inertias are less exact than what it computes with them.
        std::string text =
            "<robot name=\"random\"><mujoco><compiler fusestatic=\"false\"/></mujoco>"
            "<link name=\"l0\"/>\n";
        for (std::size_t i = 1; i <= joints; ++i) {
            auto const parent = branches ? static_cast<std::size_t>(uniform(0, double(i))) : i - 1;
            auto const own = "l" + std::to_string(i), of = "l" + std::to_string(parent);
            // Three squared half widths: a box's moments, in a frame of its own.
            double const m = uniform(0.5, 3), a = uniform(0.002, 0.03), b = uniform(0.002, 0.03),
                         c = uniform(0.002, 0.03);
            text += link(own, m, {m * (b + c), m * (a + c), m * (a + b)});
            // Something that is fixed to every second link moves with it.
            if (i % 2 == 0) {
                text += link(own + "tool", 0.3, {0.002, 0.003, 0.004});
                text += "<joint name=\"f" + std::to_string(i) + "\" type=\"fixed\">" + pose(0.2) +
                        "<parent link=\"" + own + "\"/><child link=\"" + own + "tool\"/></joint>\n";
            }
            bool const slides = uniform(0, 1) < 0.2 && joints > 1;
            text += "<joint name=\"j" + std::to_string(i) + "\" type=\"" +
                    (slides ? "prismatic" : "continuous") + "\">" + pose(0.5) + "<parent link=\"" +
                    of + "\"/><child link=\"" + own + "\"/><axis xyz=\"" + axis() +
                    "\"/><limit lower=\"-9\" upper=\"9\" effort=\"50\" velocity=\"3\"/>"
                    "<dynamics damping=\"" +
                    number(uniform(0, 0.5)) + "\"/></joint>\n";
        }
        return text + "</robot>\n";
    }
    double uniform(double a, double b) { return random_.uniform(a, b); }

private:
    static std::string number(double x) {
        char text[32];
        (void)std::snprintf(text, sizeof text, "%.6f", x);
        return text;
    }
    std::string three(double most) {
        return number(uniform(-most, most)) + " " + number(uniform(-most, most)) + " " +
               number(uniform(-most, most));
    }
    std::string pose(double most) {
        return "<origin xyz=\"" + three(most) + "\" rpy=\"" +
               (uniform(0, 1) < 0.3 ? "0 1.5707963267948966 0" : three(3)) + "\"/>";
    }
    std::string axis() {
        static std::array<char const*, 3> const plain{"0 -1 0", "1 0 0", "0 0 1"};
        auto const k = static_cast<std::size_t>(uniform(0, 5.99));
        return k < 3 ? plain[k] : three(1);
    }
    std::string link(std::string const& name, double m, std::array<double, 3> const& i) {
        return "<link name=\"" + name + "\"><inertial>" + pose(0.2) + "<mass value=\"" + number(m) +
               "\"/><inertia ixx=\"" + number(i[0]) + "\" iyy=\"" + number(i[1]) + "\" izz=\"" +
               number(i[2]) +
               (products_ ? "\" ixy=\"0.0003\" ixz=\"-0.0002\" iyz=\"0.0001\""
                          : "\" ixy=\"0\" ixz=\"0\" iyz=\"0\"") +
               "/></inertial></link>\n";
    }

    support::draws random_;
    bool products_;
};

} // namespace urdf_texts

#endif
