// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_ROBOT_BODY_DESCRIPTION_HPP
#define SIVID_IMPORTING_ROBOT_BODY_DESCRIPTION_HPP

#include <sivid/importing/robot/described_robot.hpp>
#include <sivid/io/input_error.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sivid::importing_detail {

using matrix3 = std::array<std::array<double, 3>, 3>;

/// Where a frame is seen from another.
struct placement {
    matrix3 turn{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    std::array<double, 3> origin{};

    /// The frame that is placed so in this one.
    [[nodiscard]] placement then(placement const& b) const {
        placement result{{}, seen(b.origin)};
        for (std::size_t k = 0; k < 3; ++k) {
            result.origin[k] += origin[k];
            for (std::size_t j = 0; j < 3; ++j)
                for (std::size_t i = 0; i < 3; ++i) result.turn[k][j] += turn[k][i] * b.turn[i][j];
        }
        return result;
    }
    [[nodiscard]] std::array<double, 3> seen(std::array<double, 3> const& a) const {
        std::array<double, 3> result{};
        for (std::size_t k = 0; k < 3; ++k)
            result[k] = turn[k][0] * a[0] + turn[k][1] * a[1] + turn[k][2] * a[2];
        return result;
    }
    /// Where all axes lie within 1e-5 of each other's, they are taken to lie there: files write
    /// 1.5708 for a right angle. @returns whether that changed more than rounding
    bool take_right_angles() {
        auto right = turn;
        double off = 0;
        for (auto& row : right)
            for (auto& x : row) {
                off = std::max(off, std::abs(x - std::round(x)));
                x = std::round(x) + 0.0;
            }
        if (off > 1e-5) return false;
        turn = right;
        return off > 1e-12;
    }
};

struct link_inertia {
    std::string name;
    double mass = 0;
    std::array<double, 6> moments{}; ///< about the centre: xx, yy, zz, xy, xz, yz
};

/// The eigenvalues of a symmetric matrix, the least first.
[[nodiscard]] inline std::array<double, 3> principal(std::array<double, 6> const& m) {
    auto const [x, y, z, a, b, c] = m;
    double const middle = (x + y + z) / 3;
    double const p = std::sqrt(((x - middle) * (x - middle) + (y - middle) * (y - middle) +
                                (z - middle) * (z - middle) + 2 * (a * a + b * b + c * c)) /
                               6);
    if (p == 0) return {middle, middle, middle};
    double const u = (x - middle) / p, v = (y - middle) / p, w = (z - middle) / p;
    double const d = a / p, e = b / p, f = c / p;
    double const half = (u * (v * w - f * f) - d * (d * w - f * e) + e * (d * f - v * e)) / 2;
    double const angle = std::acos(std::clamp(half, -1.0, 1.0)) / 3;
    double const most = middle + 2 * p * std::cos(angle);
    double const least = middle + 2 * p * std::cos(angle + 2 * std::acos(-1.0) / 3);
    return {least, 3 * middle - most - least, most};
}

/// Some distribution of mass has this inertia: masses are not negative, and no principal moment
/// exceeds the sum of the others (by more than a thousandth, for files round).
/// @throws input_error  naming the link
inline void require_physical(link_inertia const& i, std::string const& file) {
    auto const fail = [&](std::string const& problem, std::string const& remedy) {
        throw input_error({.file = file}, "the link " + in_quotes(i.name) + " " + problem, remedy);
    };
    if (i.mass < 0) fail("has a negative mass", "masses are above 0");
    auto const moment = principal(i.moments);
    double const slack = 1e-3 * moment[2];
    if (i.mass == 0 && (moment[0] != 0 || moment[2] != 0))
        fail("has moments of inertia and no mass", "state its mass");
    if (moment[0] < -slack || moment[2] < 0)
        fail("has a negative moment of inertia about one of its axes", "correct ixx to izz");
    if (moment[0] + moment[1] < moment[2] - slack)
        fail("has moments of inertia that no body has: one is larger than the sum of the other two",
             "correct ixx to izz");
}

/// Adds a link, whose centre and axes lie there in the body's frame, to the ten constants.
inline void add_inertia(std::array<double, 10>& c, link_inertia const& link, placement const& at) {
    auto const& i = link.moments;
    matrix3 const own{{{i[0], i[3], i[4]}, {i[3], i[1], i[5]}, {i[4], i[5], i[2]}}};
    static constexpr std::size_t entries[6][2]{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
    auto const& p = at.origin;
    double const square = p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
    c[0] += link.mass;
    for (std::size_t k = 0; k < 3; ++k) c[1 + k] += link.mass * p[k];
    for (std::size_t e = 0; e < 6; ++e) {
        auto const [j, k] = std::pair{entries[e][0], entries[e][1]};
        double turned = 0;
        for (std::size_t a = 0; a < 3; ++a)
            for (std::size_t b = 0; b < 3; ++b) turned += at.turn[j][a] * own[a][b] * at.turn[k][b];
        c[4 + e] += turned + link.mass * ((j == k ? square : 0) - p[j] * p[k]);
    }
}

/// Letters, digits and _, as names of a model are, and unlike the others.
[[nodiscard]] inline std::string model_name(std::string const& name, std::set<std::string>& taken) {
    std::string plain;
    for (char const c : name.substr(0, 60))
        plain += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
    if (plain.empty()) plain = "_";
    auto result = plain;
    for (std::size_t k = 2; !taken.insert(result).second; ++k) result = plain + std::to_string(k);
    return result;
}

/// Numbers as they are written: 15 digits, what is below them of the largest of its kind being 0.
inline void round_inertial(std::array<double, 10>& c) {
    double const first = std::hypot(c[1], c[2], c[3]), second = c[4] + c[5] + c[6];
    for (std::size_t k = 0; k < 10; ++k) {
        if (k > 0 && std::abs(c[k]) < 1e-15 * (k < 4 ? first : second)) c[k] = 0;
        char text[40];
        (void)std::snprintf(text, sizeof text, "%.15g", c[k]);
        c[k] = std::strtod(text, nullptr) + 0.0;
    }
}

/// The mass matrix of the described robot at some place.
[[nodiscard]] inline std::vector<std::vector<sparse<double>>>
mass_matrix(described_robot const& r, std::vector<double> const& place) {
    body_motion<double> motion;
    std::vector<body_inertia<double>> bodies;
    for (auto const& j : r.joints) {
        motion.origin.push_back({sparse<double>(j.origin[0]), {j.origin[1]}, {j.origin[2]}});
        std::array<sparse<double>, 10> c;
        for (std::size_t k = 0; k < 10; ++k) c[k] = j.inertial[k];
        bodies.push_back(body_of(c));
    }
    motion.place = place;
    motion.speed.resize(place.size());
    return rigid_bodies<double>(r.structure(), bodies, motion).mass();
}

/// Every joint moves some mass. @throws input_error  naming the link
inline void require_movable(described_robot const& r, std::string const& file) {
    for (std::size_t i = 0; i < r.joints.size(); ++i) {
        auto const& j = r.joints[i];
        if (j.inertial[0] <= 0)
            throw input_error({.file = file},
                              "the link " + in_quotes(j.link) + ", which the joint " +
                                  in_quotes(j.name) + " moves, has no mass",
                              "state its mass and inertia, or let the joint be fixed: --fix " +
                                  j.name);
        auto const m = mass_matrix(r, std::vector<double>(r.joints.size(), 0.3));
        if (m[i][i].value_or(0) <=
            1e-12 *
                (j.joint.slides ? j.inertial[0] : j.inertial[4] + j.inertial[5] + j.inertial[6]))
            throw input_error({.file = file},
                              "the link " + in_quotes(j.link) + " has no inertia about its joint " +
                                  in_quotes(j.name),
                              "state its inertia, or place its centre of mass off the axis");
    }
}

} // namespace sivid::importing_detail

#endif
