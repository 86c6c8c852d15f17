// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_RIGID_BODY_HPP
#define SIVID_MODEL_RIGID_BODY_HPP

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// A scalar that may be 0 by structure: what it is multiplied by is not computed at all, so that
/// the equations of a plane arm are those that one writes by hand.
template <class T>
class sparse {
public:
    sparse() = default; ///< 0
    sparse(T value) : value_(std::move(value)) {}
    [[nodiscard]] bool is_zero() const { return !value_; }
    /// @given  !is_zero()
    [[nodiscard]] T const& operator*() const { return *value_; }
    [[nodiscard]] T value_or(T zero) const { return value_ ? *value_ : std::move(zero); }

    friend sparse operator+(sparse const& a, sparse const& b) {
        return a.is_zero() ? b : b.is_zero() ? a : sparse(*a + *b);
    }
    friend sparse operator-(sparse const& a, sparse const& b) {
        return b.is_zero() ? a : a.is_zero() ? -b : sparse(*a - *b);
    }
    friend sparse operator-(sparse const& a) { return a.is_zero() ? a : sparse(-*a); }
    friend sparse operator*(sparse const& a, sparse const& b) {
        return a.is_zero() || b.is_zero() ? sparse() : sparse(*a * *b);
    }
    friend sparse operator/(sparse const& a, sparse const& b) {
        return a.is_zero() ? a : sparse(*a / *b);
    }
    /// Times an entry of a fixed rotation.
    friend sparse operator*(double factor, sparse const& a) {
        if (factor == 0 || a.is_zero()) return {};
        return factor == 1 ? a : factor == -1 ? -a : sparse(T(factor) * *a);
    }

private:
    std::optional<T> value_;
};

template <class T>
using vector3 = std::array<sparse<T>, 3>;
/// A symmetric matrix: xx, yy, zz, xy, xz, yz.
template <class T>
using symmetric3 = std::array<sparse<T>, 6>;

/// A moving body: ten numbers, in which its forces are linear, in a frame of its own.
template <class T>
struct body_inertia {
    sparse<T> mass;
    vector3<T> first;      ///< mass times the place of its centre
    symmetric3<T> inertia; ///< about the origin of the frame
};

/// How a body is joined to the one before it. Its frame lies in the joint and turns or slides along
/// one of its own axes.
struct body_joint {
    static constexpr std::size_t base = static_cast<std::size_t>(-1);
    std::size_t parent = base; ///< a body before this one
    bool slides = false;
    std::size_t axis = 2; ///< of the frame
    double sense = 1;     ///< or -1: against that axis
    /// Columns: the axes of the frame where the joint is at 0, seen by the parent.
    std::array<std::array<double, 3>, 3> turn{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
};

/// Where bodies are and what drives them.
template <class T>
struct body_motion {
    std::vector<vector3<T>> origin; ///< of each frame where its joint is at 0, in the parent's
    std::vector<T> place, speed;    ///< of each joint
    vector3<T> gravity;             ///< in the frame of the base
};

/// What does not name intermediate results.
struct unnamed {
    template <class T>
    sparse<T> operator()(std::string const& /*of*/, std::size_t /*body*/, sparse<T> x) const {
        return x;
    }
};

/// The equations of motion of an open chain, or tree, of rigid bodies,
///   \f$ M(q) \ddot q + h(q, \dot q) = \tau, \f$
/// with h by the recursive Newton-Euler algorithm and M by composite inertias, both in the frames
/// of the bodies. Every scalar runs the same operations: doubles, intervals, the recording
/// expression of models, texts.
/// @tparam T  has + - * / and sin, cos, found by argument-dependent lookup or in std
/// @tparam Names  is called for each intermediate result with what it is and the body's number, and
///         returns what stands for it from there on
/// @guarantee with a sound interval type the exact results are enclosed
/// @cost  O(bodies) for h, O(bodies^2) for M
/// @ref   Featherstone, Rigid Body Dynamics Algorithms (2008), chapters 5 and 6
template <class T, class Names = unnamed>
class rigid_bodies {
public:
    using vector = vector3<T>;

    rigid_bodies(std::vector<body_joint> const& joints, std::vector<body_inertia<T>> const& bodies,
                 body_motion<T> const& motion, Names names = {})
        : joints_(joints), bodies_(bodies), motion_(motion), name_(std::move(names)) {
        using std::cos;
        using std::sin;
        for (std::size_t i = 0; i < joints_.size(); ++i) {
            auto const& q = motion_.place[i];
            bool const slides = joints_[i].slides;
            cos_.push_back(slides ? sparse<T>() : name_("c", i, sparse<T>(cos(q))));
            sin_.push_back(slides ? sparse<T>()
                                  : joints_[i].sense * name_("s", i, sparse<T>(sin(q))));
            auto const way = slides ? axis(i, sparse<T>(q)) : vector{};
            at_.push_back(named("r", i, sum(motion_.origin[i], seen_by_parent(i, way))));
        }
    }

    /// h: the forces and torques of the joints that leave all accelerations 0.
    [[nodiscard]] std::vector<sparse<T>> bias() {
        std::size_t const n = joints_.size();
        std::vector<vector3<T>> force(n), moment(n);
        velocities();
        for (std::size_t i = 0; i < n; ++i) {
            auto const& [mass, first, inertia] = bodies_[i];
            auto const &w = turning_[i], &a = turned_[i], &l = moved_[i];
            auto const push = cross(w, first);
            force[i] = sum(scaled(mass, l), sum(cross(a, first), cross(w, push)));
            auto const spin = named("L", i, times(inertia, w));
            moment[i] = sum(times(inertia, a), sum(cross(w, spin), cross(first, l)));
        }
        std::vector<sparse<T>> result(n);
        for (std::size_t i = n; i-- > 0;) {
            auto f = named("f", i, force[i]), m = named("n", i, moment[i]);
            result[i] = name_("h", i, along(i, f, m));
            if (joints_[i].parent == body_joint::base) continue;
            to_parent(i, f, m);
            auto const p = joints_[i].parent;
            force[p] = sum(force[p], f);
            moment[p] = sum(moment[p], m);
        }
        return result;
    }

    /// M, rows of a symmetric matrix.
    [[nodiscard]] std::vector<std::vector<sparse<T>>> mass() {
        std::size_t const n = joints_.size();
        auto whole = bodies_;
        std::vector<std::vector<sparse<T>>> result(n, std::vector<sparse<T>>(n));
        for (std::size_t i = n; i-- > 0;) {
            whole[i].first = named("Cm", i, whole[i].first);
            for (std::size_t k = 0; k < 6; ++k)
                whole[i].inertia[k] = name_(moments[k], i, whole[i].inertia[k]);
            // What an acceleration of 1 takes.
            auto const& [mass, first, inertia] = whole[i];
            auto const unit = axis(i, sparse<T>(T(1.0)));
            bool const slides = joints_[i].slides;
            auto f = slides ? scaled(mass, unit) : cross(unit, first);
            auto m = slides ? cross(first, unit) : times(inertia, unit);
            result[i][i] = name_("M" + std::to_string(i + 1), i, along(i, f, m));
            for (auto j = i; joints_[j].parent != body_joint::base;) {
                to_parent(j, f, m);
                j = joints_[j].parent;
                f = named("F" + std::to_string(i + 1), j, f);
                m = named("N" + std::to_string(i + 1), j, m);
                result[i][j] = result[j][i] = name_("M" + std::to_string(i + 1), j, along(j, f, m));
            }
            if (joints_[i].parent == body_joint::base) continue;
            auto& with = whole[joints_[i].parent];
            auto const own = seen_by_parent(i, whole[i]);
            with.mass = with.mass + own.mass;
            with.first = sum(with.first, own.first);
            for (std::size_t k = 0; k < 6; ++k) with.inertia[k] = with.inertia[k] + own.inertia[k];
        }
        return result;
    }

    /// `size` along the axis of a joint.
    [[nodiscard]] vector axis(std::size_t i, sparse<T> const& size) const {
        vector result;
        result[joints_[i].axis] = joints_[i].sense * size;
        return result;
    }
    /// A vector of the body's frame as the parent sees it, and the other way round.
    [[nodiscard]] vector seen_by_parent(std::size_t i, vector a) const {
        if (!joints_[i].slides) {
            auto const u = (joints_[i].axis + 1) % 3, v = (joints_[i].axis + 2) % 3;
            auto const x = a[u];
            a[u] = cos_[i] * x - sin_[i] * a[v];
            a[v] = sin_[i] * x + cos_[i] * a[v];
        }
        auto const& r = joints_[i].turn;
        vector result;
        for (std::size_t k = 0; k < 3; ++k)
            result[k] = r[k][0] * a[0] + r[k][1] * a[1] + r[k][2] * a[2];
        return result;
    }
    [[nodiscard]] vector seen_by_body(std::size_t i, vector const& a) const {
        auto const& r = joints_[i].turn;
        vector b;
        for (std::size_t k = 0; k < 3; ++k) b[k] = r[0][k] * a[0] + r[1][k] * a[1] + r[2][k] * a[2];
        if (joints_[i].slides) return b;
        auto const u = (joints_[i].axis + 1) % 3, v = (joints_[i].axis + 2) % 3;
        auto const x = b[u];
        b[u] = cos_[i] * x + sin_[i] * b[v];
        b[v] = cos_[i] * b[v] - sin_[i] * x;
        return b;
    }

    /// The velocity, angular and of the frame's origin, that the parent's gives a body whose joint
    /// stands still.
    [[nodiscard]] std::pair<vector, vector>
    velocity_of_body(std::size_t i, std::pair<vector, vector> const& parent) const {
        auto const turning = seen_by_body(i, parent.first);
        return {turning, seen_by_body(i, sum(parent.second, cross(parent.first, at_[i])))};
    }
    /// The same body, of the parent's frame.
    [[nodiscard]] body_inertia<T> seen_by_parent(std::size_t i, body_inertia<T> b) const {
        auto const& m = b.inertia;
        // R I R^T: the columns turned, then the rows.
        std::array<vector, 3> rows{seen_by_parent(i, vector{m[0], m[3], m[4]}),
                                   seen_by_parent(i, vector{m[3], m[1], m[5]}),
                                   seen_by_parent(i, vector{m[4], m[5], m[2]})};
        std::array<vector, 3> turned;
        for (std::size_t k = 0; k < 3; ++k)
            turned[k] = seen_by_parent(i, vector{rows[0][k], rows[1][k], rows[2][k]});
        b.inertia = {turned[0][0], turned[1][1], turned[2][2],
                     turned[0][1], turned[0][2], turned[1][2]};
        b.first = seen_by_parent(i, b.first);
        return shifted(b, at_[i]);
    }

private:
    static constexpr std::array<char const*, 6> moments{"Cxx", "Cyy", "Czz", "Cxy", "Cxz", "Cyz"};

    static vector sum(vector const& a, vector const& b) {
        return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
    }
    static vector scaled(sparse<T> const& k, vector const& a) {
        return {k * a[0], k * a[1], k * a[2]};
    }
    static vector cross(vector const& a, vector const& b) {
        return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    }
    static vector times(symmetric3<T> const& m, vector const& a) {
        return {m[0] * a[0] + m[3] * a[1] + m[4] * a[2], m[3] * a[0] + m[1] * a[1] + m[5] * a[2],
                m[4] * a[0] + m[5] * a[1] + m[2] * a[2]};
    }
    [[nodiscard]] sparse<T> along(std::size_t i, vector const& force, vector const& moment) const {
        auto const& of = joints_[i].slides ? force : moment;
        return joints_[i].sense * of[joints_[i].axis];
    }
    vector named(std::string const& what, std::size_t i, vector const& a) const {
        return {name_(what + "x", i, a[0]), name_(what + "y", i, a[1]), name_(what + "z", i, a[2])};
    }
    /// Angular velocities, and the accelerations that centrifugal forces and gravity amount to,
    /// joints not being accelerated.
    void velocities() {
        std::size_t const n = joints_.size();
        turning_.resize(n);
        turned_.resize(n);
        moved_.resize(n);
        vector const still, falling{-motion_.gravity[0], -motion_.gravity[1], -motion_.gravity[2]};
        for (std::size_t i = 0; i < n; ++i) {
            bool const first = joints_[i].parent == body_joint::base, slides = joints_[i].slides;
            auto const p = joints_[i].parent;
            auto const &w = first ? still : turning_[p], &a = first ? still : turned_[p],
                       &l = first ? falling : moved_[p], &r = at_[i];
            auto const turning = seen_by_body(i, w);
            auto const speed = axis(i, sparse<T>(motion_.speed[i]));
            auto const own = slides ? vector{} : speed;
            turning_[i] = named("omega", i, sum(turning, own));
            turned_[i] = named("alpha", i, sum(seen_by_body(i, a), cross(turning, own)));
            auto const linear = seen_by_body(i, sum(l, sum(cross(a, r), cross(w, cross(w, r)))));
            auto const coriolis = slides ? cross(turning, speed) : vector{};
            moved_[i] = named("a", i, sum(linear, sum(coriolis, coriolis)));
        }
    }

    /// Force and moment about the body's origin become those about the parent's, as it sees them.
    void to_parent(std::size_t i, vector& force, vector& moment) const {
        force = seen_by_parent(i, force);
        moment = sum(seen_by_parent(i, moment), cross(at_[i], force));
    }
    /// About a point from which the origin of the frame is seen at p.
    [[nodiscard]] static body_inertia<T> shifted(body_inertia<T> b, vector const& p) {
        auto const &h = b.first, later = sum(h, scaled(b.mass, p)); // I += ... of h and h + m p
        auto const pair = [&](std::size_t j, std::size_t k) {
            return p[j] * later[k] + h[j] * p[k];
        };
        auto const x = pair(0, 0), y = pair(1, 1), z = pair(2, 2);
        auto& i = b.inertia;
        i = {i[0] + (y + z),    i[1] + (x + z),    i[2] + (x + y),
             i[3] - pair(0, 1), i[4] - pair(0, 2), i[5] - pair(1, 2)};
        b.first = later;
        return b;
    }
    std::vector<body_joint> joints_;
    std::vector<body_inertia<T>> bodies_;
    body_motion<T> motion_;
    Names name_;
    std::vector<sparse<T>> cos_, sin_;
    std::vector<vector> at_; ///< where the frames' origins are, in the parents' frames
    std::vector<vector> turning_, turned_, moved_;
};

} // namespace sivid

#endif
