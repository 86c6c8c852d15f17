// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_ROBOT_BASE_PARAMETERS_HPP
#define SIVID_IMPORTING_ROBOT_BASE_PARAMETERS_HPP

#include <sivid/importing/robot/described_robot.hpp>
#include <sivid/io/text/exact_decimal.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <boost/multiprecision/cpp_int.hpp>
#include <boost/operators.hpp>

namespace sivid {

/// What motions and torques of a robot can tell of its inertial constants, ten a body.
struct base_parameters {
    struct term {
        std::size_t constant; ///< 10 body + number among the ten
        double factor;        ///< exact where it has few digits, else nearest
    };
    struct combination {
        std::size_t kept;        ///< counts 1, and stands for all of it in the model
        std::vector<term> terms; ///< what cannot be told from it
    };
    std::vector<combination> known; ///< with what these alone give, any motion and torque agree
    std::vector<std::size_t> without_effect;
    /// The geometry is in right angles and decimals, so that all of it is proved. Else turns are
    /// rounded to doubles, and what is below 1e-11 counts as 0.
    bool exact = true;
};

namespace importing_detail {

/// A rational number. As a place of a joint that turns it is the tangent of half the angle.
struct exact_scalar : boost::field_operators<exact_scalar> {
    boost::multiprecision::cpp_rational value;

    exact_scalar(double exact = 0) : value(exact) {}
    explicit exact_scalar(boost::multiprecision::cpp_rational v) : value(std::move(v)) {}
    exact_scalar& operator+=(exact_scalar const& b) { return value += b.value, *this; }
    exact_scalar& operator-=(exact_scalar const& b) { return value -= b.value, *this; }
    exact_scalar& operator*=(exact_scalar const& b) { return value *= b.value, *this; }
    exact_scalar& operator/=(exact_scalar const& b) { return value /= b.value, *this; }
    friend exact_scalar operator-(exact_scalar const& a) { return exact_scalar() - a; }
    friend exact_scalar sin(exact_scalar const& t) { return (t + t) / (1.0 + t * t); }
    friend exact_scalar cos(exact_scalar const& t) { return (1.0 - t * t) / (1.0 + t * t); }
};

/// Rows in reduced echelon form over the rationals; columns are eliminated in a stated order. What
/// is no larger than the noise counts as 0.
class exact_rows {
public:
    using row = std::vector<exact_scalar>;
    exact_rows(std::vector<std::size_t> order, double noise)
        : order_(std::move(order)), noise_(noise) {}

    void add(row r) {
        for (auto& v : r)
            if (abs(v.value) <= noise_.value) v = 0;
        for (std::size_t k = 0; k < rows_.size(); ++k) subtract(r, rows_[k], pivots_[k]);
        auto const at = std::find_if(order_.begin(), order_.end(),
                                     [&](std::size_t c) { return r[c].value != 0; });
        if (at == order_.end()) return;
        auto const lead = r[*at];
        for (auto& v : r) v /= lead;
        for (auto& other : rows_) subtract(other, r, *at);
        rows_.push_back(std::move(r));
        pivots_.push_back(*at);
    }
    [[nodiscard]] std::vector<row> const& rows() const { return rows_; }
    [[nodiscard]] std::vector<std::size_t> const& pivots() const { return pivots_; }
    [[nodiscard]] bool is_pivot(std::size_t c) const {
        return std::find(pivots_.begin(), pivots_.end(), c) != pivots_.end();
    }
    /// What all rows give 0 for.
    [[nodiscard]] std::vector<row> null_space() const {
        std::vector<row> result;
        for (auto const c : order_) {
            if (is_pivot(c)) continue;
            row x(order_.size());
            x[c] = 1.0;
            for (std::size_t k = 0; k < rows_.size(); ++k) x[pivots_[k]] = -rows_[k][c];
            result.push_back(std::move(x));
        }
        return result;
    }

private:
    void subtract(row& from, row const& what, std::size_t pivot) const {
        if (from[pivot].value == 0) return;
        auto const factor = from[pivot];
        for (std::size_t j = 0; j < from.size(); ++j) {
            if (what[j].value != 0) from[j] -= factor * what[j];
            if (abs(from[j].value) <= noise_.value) from[j] = 0;
        }
    }
    std::vector<std::size_t> order_;
    exact_scalar noise_;
    std::vector<row> rows_;
    std::vector<std::size_t> pivots_;
};

/// Finds which inertial constants no motion tells apart, body after body from the base.
///   The kinetic energy of a body is a linear form of its ten constants for each velocity that it
///   can have, and its weight's potential one for each direction of gravity. Constants of a body
///   act as if the body before it had them exactly where none of these forms depends on the joint
///   between: those of the joint's own speed vanish, the others are the same at all its places.
///   Forms are polynomials of degree two in the place, or in its sine and cosine: what holds at
///   three, or five, places holds at all.
class base_parameter_search {
public:
    explicit base_parameter_search(described_robot const& r)
        : robot_(r),
          joints_(r.structure()),
          exact_(has_right_angles(joints_)),
          noise_(exact_ ? 0 : 1e-11),
          null_(null_order(), noise_) {}

    [[nodiscard]] base_parameters operator()() {
        at_.reserve(places.size());
        for (double const t : places) at_.push_back(bodies_at(t));
        for (std::size_t i = 0; i < joints_.size(); ++i) add_body(i);
        return result();
    }

private:
    using scalar = exact_scalar;
    using row = exact_rows::row;
    using vector = vector3<scalar>;
    /// Tangents of half the angles, or places.
    static constexpr std::array<double, 5> places{0, 1, -1, 2, 0.5};

    /// What a body can undergo: each list spans it.
    struct reached {
        std::vector<row> velocities; ///< angular, and of the origin; gravity is one of them
        std::vector<row> energies;   ///< forms of ten constants
    };

    static std::vector<std::size_t> all(std::size_t n) {
        std::vector<std::size_t> result(n);
        for (std::size_t k = 0; k < n; ++k) result[k] = k;
        return result;
    }
    /// Which constants are left out first where several may be: small ones, which widen what stands
    /// for them least; of those alike, the last bodies'.
    [[nodiscard]] std::vector<std::size_t> null_order() const {
        double length = 0; // by which masses and first moments are moments of inertia
        for (auto const& j : robot_.joints)
            length = std::max(length, std::hypot(j.origin[0], j.origin[1], j.origin[2]));
        auto const size = [&](std::size_t c) {
            auto const k = c % 10;
            return robot_.size_of(c) * std::pow(length, k == 0 ? 2 : k < 4 ? 1 : 0);
        };
        auto order = all(10 * joints_.size());
        std::reverse(order.begin(), order.end());
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return size(a) < size(b); });
        return order;
    }
    static sparse<scalar> as_sparse(scalar x) {
        return x.value == 0 ? sparse<scalar>() : sparse<scalar>(std::move(x));
    }
    /// The decimal that is written, exactly.
    static scalar decimal_value(double x) {
        static auto const ten = *exact_decimal::parse("10");
        auto digits = exact_decimal::shortest(std::abs(x));
        boost::multiprecision::cpp_rational power = 1;
        for (; !digits.whole(); digits = digits.times(ten)) power *= 10;
        return scalar((x < 0 ? -1 : 1) * (*digits.whole() / power));
    }
    [[nodiscard]] rigid_bodies<scalar> bodies_at(double t) const {
        body_motion<scalar> motion;
        for (auto const& j : robot_.joints) {
            vector origin;
            for (std::size_t k = 0; k < 3; ++k) origin[k] = as_sparse(decimal_value(j.origin[k]));
            motion.origin.push_back(origin);
            motion.place.emplace_back(t);
            motion.speed.emplace_back();
        }
        return {joints_, std::vector<body_inertia<scalar>>(joints_.size()), motion};
    }

    /// \f$ \sum m\, (v + \omega \times r) \cdot (v' + \omega' \times r) \f$ as a form of the ten.
    static row energy(row const& a, row const& b) {
        row r(10);
        for (std::size_t k = 0; k < 3; ++k) {
            auto const i = (k + 1) % 3, j = (k + 2) % 3;
            r[0] += a[3 + k] * b[3 + k];
            r[1 + k] = a[3 + i] * b[j] - a[3 + j] * b[i] + b[3 + i] * a[j] - b[3 + j] * a[i];
            r[4 + k] = a[k] * b[k];
            r[9 - k] = a[i] * b[j] + a[j] * b[i];
        }
        return r;
    }
    template <class... Parts>
    static row row_of(Parts const&... parts) {
        row r;
        (std::for_each(parts.begin(), parts.end(),
                       [&](auto const& x) { r.push_back(x.value_or({})); }),
         ...);
        return r;
    }
    static vector vector_of(row const& r, std::size_t from) {
        return {as_sparse(r[from]), as_sparse(r[from + 1]), as_sparse(r[from + 2])};
    }
    /// The ten constants of the parent that those of body i amount to.
    [[nodiscard]] row pushed(rigid_bodies<scalar> const& at, std::size_t i, row const& own) const {
        std::array<sparse<scalar>, 10> c;
        for (std::size_t k = 0; k < 10; ++k) c[k] = as_sparse(own[k]);
        auto const b = at.seen_by_parent(i, body_of(c));
        return row_of(std::array{b.mass}, b.first, b.inertia);
    }

    void add_body(std::size_t i) {
        reached before;
        before.velocities.emplace_back(6);
        for (std::size_t k = 0; k < 3; ++k)
            before.velocities[0][3 + k] = decimal_value(robot_.gravity[k]);
        if (joints_[i].parent != body_joint::base) before = reached_[joints_[i].parent];
        exact_rows conditions(all(10), noise_), energies(all(10), noise_),
            velocities(all(6), noise_);
        row own(6);
        own[(joints_[i].slides ? 3 : 0) + joints_[i].axis] = 1.0;

        for (std::size_t k = 0; k < places_of(i); ++k)
            for (auto const& v : before.velocities) {
                auto const [turning, linear] =
                    at_[k].velocity_of_body(i, {vector_of(v, 0), vector_of(v, 3)});
                velocities.add(row_of(turning, linear));
            }
        velocities.add(own);
        for (auto const& v : velocities.rows()) energies.add(energy(own, v));
        energies.add(energy(own, own));
        for (auto const& e : energies.rows()) conditions.add(e);
        carry_energies(i, before.energies, energies, conditions);
        reached_.push_back({velocities.rows(), energies.rows()});
        add_null(i, conditions.null_space());
    }
    [[nodiscard]] std::size_t places_of(std::size_t i) const { return joints_[i].slides ? 3 : 5; }
    void carry_energies(std::size_t i, std::vector<row> const& before, exact_rows& energies,
                        exact_rows& conditions) const {
        std::vector<row> at_zero;
        for (std::size_t k = 0; k < places_of(i); ++k) {
            std::vector<row> images; // of each constant alone
            for (std::size_t c = 0; c < 10; ++c) {
                row unit(10);
                unit[c] = 1.0;
                images.push_back(pushed(at_[k], i, unit));
            }
            for (std::size_t e = 0; e < before.size(); ++e) {
                row r(10);
                for (std::size_t c = 0; c < 10; ++c)
                    for (std::size_t j = 0; j < 10; ++j) r[c] += before[e][j] * images[c][j];
                energies.add(r);
                if (k == 0) at_zero.push_back(r);
                for (std::size_t c = 0; c < 10; ++c) r[c] -= at_zero[e][c];
                conditions.add(r);
            }
        }
    }
    /// What body i has and the one before it lacks, so that nothing changes.
    void add_null(std::size_t i, std::vector<row> const& own) {
        for (auto const& v : own) {
            row whole(10 * joints_.size());
            std::copy(v.begin(), v.end(), whole.begin() + static_cast<std::ptrdiff_t>(10 * i));
            if (joints_[i].parent != body_joint::base) {
                auto const p = pushed(at_[0], i, v);
                for (std::size_t k = 0; k < 10; ++k) whole[10 * joints_[i].parent + k] = -p[k];
            }
            null_.add(std::move(whole));
        }
    }
    [[nodiscard]] base_parameters result() const {
        base_parameters found;
        auto const n = 10 * joints_.size();
        for (std::size_t c = 0; c < n; ++c) {
            if (null_.is_pivot(c)) continue;
            base_parameters::combination one{c, {}};
            for (std::size_t k = 0; k < null_.rows().size(); ++k) {
                auto const& factor = null_.rows()[k][c].value;
                if (factor != 0)
                    one.terms.push_back({null_.pivots()[k], -factor.convert_to<double>()});
            }
            found.known.push_back(std::move(one));
        }
        for (std::size_t k = 0; k < null_.rows().size(); ++k) {
            auto const& r = null_.rows()[k];
            if (std::count_if(r.begin(), r.end(), [](auto const& v) { return v.value != 0; }) == 1)
                found.without_effect.push_back(null_.pivots()[k]);
        }
        std::sort(found.without_effect.begin(), found.without_effect.end());
        found.exact = exact_;
        return found;
    }

    static bool has_right_angles(std::vector<body_joint> const& joints) {
        return std::all_of(joints.begin(), joints.end(), [](body_joint const& j) {
            return std::all_of(j.turn.begin(), j.turn.end(), [](auto const& row) {
                return std::all_of(row.begin(), row.end(),
                                   [](double x) { return x == 0 || std::abs(x) == 1; });
            });
        });
    }

    described_robot const& robot_;
    std::vector<body_joint> joints_;
    bool exact_;
    double noise_; ///< of turns that are rounded
    std::vector<rigid_bodies<scalar>> at_;
    std::vector<reached> reached_;
    exact_rows null_;
};

} // namespace importing_detail

/// What alone motions and torques tell of a robot's inertial constants.
/// @guarantee  where it is `exact`, a theorem about all motions
/// @cost  milliseconds a joint
/// @ref   Wensing, Niemeyer and Slotine, A geometric characterization of observability in inertial
///        parameter identification, Int. J. Robotics Research 43 (2024)
[[nodiscard]] inline base_parameters base_parameters_of(described_robot const& r) {
    return importing_detail::base_parameter_search(r)();
}

} // namespace sivid

#endif
