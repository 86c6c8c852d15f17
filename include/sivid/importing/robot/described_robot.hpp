// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_ROBOT_DESCRIBED_ROBOT_HPP
#define SIVID_IMPORTING_ROBOT_DESCRIBED_ROBOT_HPP

#include <sivid/io/input_error.hpp>
#include <sivid/model/rigid_body.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
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

/// The body of these ten numbers.
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

    /// How large an inertial constant of its kind is there, by its number (10 body + number among
    /// the ten): the mass, its centre's distance from the joint, the moments about the axes.
    [[nodiscard]] double size_of(std::size_t constant) const {
        auto const& c = joints[constant / 10].inertial;
        auto const k = constant % 10;
        if (k == 0) return c[0];
        if (k < 4) return std::hypot(c[1], c[2], c[3]);
        static constexpr std::size_t ends[6][2]{{4, 4}, {5, 5}, {6, 6}, {4, 5}, {4, 6}, {5, 6}};
        return std::sqrt(c[ends[k - 4][0]] * c[ends[k - 4][1]]);
    }
    [[nodiscard]] std::vector<body_joint> structure() const {
        std::vector<body_joint> result;
        for (auto const& j : joints) result.push_back(j.joint);
        return result;
    }
};

namespace importing_detail {

using matrix3 = std::array<std::array<double, 3>, 3>;

/// Where a frame is seen from another.
struct placement {
    matrix3 turn{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    std::array<double, 3> origin{};

    /// The frame that is placed so in this one.
    [[nodiscard]] placement then(placement const& b) const {
        placement result{{}, origin};
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t i = 0; i < 3; ++i) {
                result.origin[k] += turn[k][i] * b.origin[i];
                for (std::size_t j = 0; j < 3; ++j) result.turn[k][j] += turn[k][i] * b.turn[i][j];
            }
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

/// Some distribution of mass has this inertia: masses are not negative, and half the trace less the
/// tensor, their second moments, has no negative eigenvalue, which the triangle inequality of
/// principal moments says (within a thousandth, for files round).
/// @throws input_error  naming the link
inline void require_physical(link_inertia const& link, std::string const& file) {
    auto const fail = [&](std::string const& problem, std::string const& remedy) {
        throw input_error({.file = file}, "the link " + in_quotes(link.name) + " " + problem,
                          remedy);
    };
    auto const& i = link.moments;
    if (link.mass < 0) fail("has a negative mass", "masses are above 0");
    if (std::all_of(i.begin(), i.end(), [](double m) { return m == 0; })) return; // a point
    if (link.mass == 0) fail("has moments of inertia and no mass", "state its mass");
    double const half = 0.501 * (i[0] + i[1] + i[2]), x = half - i[0], y = half - i[1],
                 z = half - i[2];
    double const minor = x * y - i[3] * i[3],
                 whole = minor * z - x * i[5] * i[5] - y * i[4] * i[4] - 2 * i[3] * i[4] * i[5];
    if (!(half > 0 && x > 0 && minor > 0 && whole > 0))
        fail("has moments of inertia that no body has: about each axis they are above 0 and at "
             "most the sum of those about the other two",
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

/// The number that so many digits name.
[[nodiscard]] inline double with_digits(double x, int digits) {
    std::array<char, 40> text{};
    auto const end = std::to_chars(text.data(), text.data() + text.size(), x,
                                   std::chars_format::scientific, digits - 1);
    (void)std::from_chars(text.data(), end.ptr, x);
    return x + 0.0; // no -0
}

/// Numbers as they are written: 15 digits, what is below them of the largest of its kind being 0.
inline void round_inertial(std::array<double, 10>& c) {
    double const first = std::hypot(c[1], c[2], c[3]), second = c[4] + c[5] + c[6];
    for (std::size_t k = 0; k < 10; ++k) {
        if (k > 0 && std::abs(c[k]) < 1e-15 * (k < 4 ? first : second)) c[k] = 0;
        c[k] = with_digits(c[k], 15);
    }
}

/// The mass matrix of the described robot at some place.
[[nodiscard]] inline std::vector<std::vector<sparse<double>>> mass_matrix(described_robot const& r,
                                                                          double place) {
    body_motion<double> motion;
    std::vector<body_inertia<double>> bodies;
    for (auto const& j : r.joints) {
        motion.origin.push_back({sparse<double>(j.origin[0]), {j.origin[1]}, {j.origin[2]}});
        std::array<sparse<double>, 10> c;
        for (std::size_t k = 0; k < 10; ++k) c[k] = j.inertial[k];
        bodies.push_back(body_of(c));
    }
    motion.place.assign(r.joints.size(), place);
    motion.speed.resize(r.joints.size());
    return rigid_bodies<double>(r.structure(), bodies, motion).mass();
}

/// Every joint moves some mass. @throws input_error  naming the link
inline void require_movable(described_robot const& r, std::string const& file) {
    auto const m = mass_matrix(r, 0.3);
    for (std::size_t i = 0; i < r.joints.size(); ++i) {
        auto const& j = r.joints[i];
        auto const& c = j.inertial;
        double const usual = j.joint.slides ? c[0] : c[4] + c[5] + c[6];
        if (c[0] > 0 && m[i][i].value_or(0) > 1e-12 * usual) continue;
        throw input_error({.file = file},
                          "the link " + in_quotes(j.link) + ", which the joint " +
                              in_quotes(j.name) + " moves, has no " +
                              (c[0] > 0 ? "inertia about it" : "mass"),
                          "state its mass and inertia, or let the joint be fixed: --fix " + j.name);
    }
}

} // namespace importing_detail

} // namespace sivid

#endif
