// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_ROBOT_DESCRIBED_ROBOT_HPP
#define SIVID_IMPORTING_ROBOT_DESCRIBED_ROBOT_HPP

#include <sivid/model/rigid_body.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// The ten constants of a body, in the order of the models that are written: mass, first moments,
/// and moments of inertia about the origin of its frame.
inline constexpr std::array<char const*, 10> inertial_names{"m",   "mx",  "my",  "mz",  "Ixx",
                                                            "Iyy", "Izz", "Ixy", "Ixz", "Iyz"};
inline constexpr std::array<char const*, 4> inertial_units{"kg", "kg m", "kg m^2"};
/// @param k  the number of such a constant
[[nodiscard]] inline char const* inertial_unit(std::size_t k) {
    return inertial_units[k == 0 ? 0 : k < 4 ? 1 : 2];
}

/// The body of these ten numbers. What is exactly 0 and in `absent` is 0 by structure.
template <class T>
[[nodiscard]] body_inertia<T> body_of(std::array<sparse<T>, 10> const& c) {
    return {c[0], {c[1], c[2], c[3]}, {c[4], c[5], c[6], c[7], c[8], c[9]}};
}

/// A joint that moves, and the links behind it that move as one body.
struct described_joint {
    std::string name, link; ///< as in the file
    std::string of, body;   ///< and in names of the model
    body_joint joint;
    std::array<double, 3> origin{};                 ///< in the parent's frame [m]
    bool turned = false;                            ///< the body's frame is not that of the link
    std::optional<std::pair<double, double>> range; ///< [rad] or [m]
    std::optional<double> fastest;                  ///< [rad/s] or [m/s]
    std::optional<double> strongest;                ///< [N m] or [N]
    double damping = 0, friction = 0;
    std::array<double, 10> inertial{};
};

/// A robot as a file describes it: an open chain, or tree, of bodies.
struct described_robot {
    std::string name;
    std::array<double, 3> gravity{0, 0, -9.81}; ///< [m/s^2], in the frame of the base
    std::vector<described_joint> joints;        ///< each behind its parent
    std::vector<std::string> notes;             ///< what was decided, dropped or assumed

    [[nodiscard]] std::vector<body_joint> structure() const {
        std::vector<body_joint> result;
        for (auto const& j : joints) result.push_back(j.joint);
        return result;
    }
};

} // namespace sivid

#endif
