// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_SET_DOUBLETON_HPP
#define SIVID_ENCLOSURE_SET_DOUBLETON_HPP

#include <sivid/enclosure/failure.hpp>
#include <sivid/space/box.hpp>
#include <sivid/space/frame/orthogonal_frame.hpp>
#include <sivid/space/matrix.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sivid {

/// What is unknown about a family of trajectories and stays fixed along it: the initial state and
/// the parameters, written as a centre plus the deviation \f$ r_0 = (x_0, p) - centre \f$.
template <class I>
struct ensemble {
    basic_box<I> parameters;
    std::vector<double> parameter_centre;
    basic_box<I> deviation; ///< \f$ r_0 \f$: states first, then parameters
    bool wide = false;      ///< a side is wider than the rounding of a decimal

    ensemble(basic_box<I> const& initial, basic_box<I> p)
        : parameters(std::move(p)),
          parameter_centre(mid(parameters)),
          deviation(initial.size() + parameters.size()) {
        auto const n = initial.size();
        using traits = interval_traits<I>;
        for (std::size_t j = 0; j < parameters.size(); ++j) {
            parameters[j] = traits::hull(parameters[j], traits::point(parameter_centre[j]));
        }
        auto const x = subtract(initial, mid(initial));
        auto const q = subtract(parameters, parameter_centre);
        for (std::size_t i = 0; i < n; ++i) deviation[i] = x[i];
        for (std::size_t j = 0; j < q.size(); ++j) deviation[n + j] = q[j];
        auto const look = [this](I const& side) {
            wide = wide || traits::rad(side) > 1e-13 * traits::mag(side);
        };
        for (I const& side : initial) look(side);
        for (I const& side : parameters) look(side);
    }
};

/// The set carried by the flow, \f$ \{ m + C r_0 + B r \mid r \in [r] \} \cap [hull] \f$ for each
/// deviation \f$ r_0 \f$ of an ensemble: the dependence on parameters and initial state is kept to
/// the end, everything else is boxed in a well-conditioned frame B.
/// @ref  Lohner 1987; Mrozek and Zgliczynski 2000 (doubletons)
template <class I>
struct doubleton {
    double time = 0;
    std::vector<double> centre;  ///< m
    Eigen::MatrixXd shape;       ///< C, n x (n + parameters)
    Eigen::MatrixXd axes;        ///< B, n x n
    basic_box<I> remainder;      ///< [r]
    basic_box<I> hull;           ///< a box that contains the set
    std::vector<double> largest; ///< about the largest |x_i| so far; no proof rests on it

    /// The set at the start: m the centre of the box, C the identity on the initial state.
    [[nodiscard]] static doubleton start(double time, basic_box<I> const& initial,
                                         std::size_t parameters) {
        auto const n = static_cast<Eigen::Index>(initial.size());
        doubleton set;
        set.time = time;
        set.centre = mid(initial);
        set.shape = Eigen::MatrixXd::Zero(n, n + static_cast<Eigen::Index>(parameters));
        set.shape.leftCols(n).setIdentity();
        set.axes = Eigen::MatrixXd::Identity(n, n);
        set.remainder = basic_box<I>(initial.size());
        set.hull = initial;
        set.largest.assign(initial.size(), 0.0);
        set.note_sizes(initial);
        return set;
    }
    /// Takes note of a box that was met.
    void note_sizes(basic_box<I> const& x) {
        for (std::size_t i = 0; i < largest.size(); ++i) {
            double const size = interval_traits<I>::mag(x[i]);
            if (std::isfinite(size)) largest[i] = std::max(largest[i], size);
        }
    }

    /// The hull and m: over what slopes from m to members are taken. More than the hull where it
    /// holds no double.
    [[nodiscard]] basic_box<I> hull_and_centre() const {
        using traits = interval_traits<I>;
        auto x = hull;
        for (std::size_t i = 0; i < x.size(); ++i) {
            if (!traits::contains(x[i], centre[i]))
                x[i] = traits::hull(x[i], traits::point(centre[i]));
        }
        return x;
    }
    /// \f$ m + C r_0 + B [r] \f$ over the whole ensemble.
    [[nodiscard]] basic_box<I> affine_hull(basic_box<I> const& deviation) const {
        return add(add(point_box<I>(centre), product(shape, deviation)), product(axes, remainder));
    }

    /// Image under a map with \f$ F(x, p) \in image + J_x (x - m) + J_p (p - \hat p) \f$ on the
    /// set.
    /// @param image  encloses F(m, centre of p)
    /// @param j      encloses \f$ (J_x, J_p) \f$, n x (n + parameters)
    /// @param direct a box that contains the image as well; the new hull is the intersection
    /// @guarantee for every \f$ r_0 \f$ and every member x of the set, F(x, p) is in the new set.
    [[nodiscard]] doubleton mapped(double to, basic_box<I> const& image,
                                   interval_matrix<I> const& j, basic_box<I> const& direct,
                                   basic_box<I> const& deviation) const {
        using traits = interval_traits<I>;
        auto const n = image.size();
        auto const columns = deviation.size();
        interval_matrix<I> jx(n, n);
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t k = 0; k < n; ++k) jx(i, k) = j(i, k);
        }
        auto slope = product(jx, shape);
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t c = n; c < columns; ++c) {
                slope(i, c) = traits::add(slope(i, c), j(i, c));
            }
        }
        doubleton next;
        next.time = to;
        next.centre = mid(image);
        next.shape = approximate_mid(slope);
        // What the new centre and the new C leave over goes into the remainder.
        auto rest = subtract(image, next.centre);
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t c = 0; c < columns; ++c) {
                auto const kept = traits::point(
                    next.shape(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c)));
                rest[i] =
                    traits::add(rest[i], traits::mul(traits::sub(slope(i, c), kept), deviation[c]));
            }
        }
        auto const turned = product(jx, axes);
        std::vector<double> weights(n);
        for (std::size_t i = 0; i < n; ++i) weights[i] = traits::mag(remainder[i]);
        next.largest = largest;
        next.note_sizes(direct);
        std::vector<double> sizes(n); // a frame that no unit of a state decides on
        for (std::size_t i = 0; i < n; ++i) {
            double const r = traits::rad(direct[i]);
            sizes[i] = r > 0 && std::isfinite(r) ? r : 1;
        }
        auto frame = make_frame<I>(approximate_mid(turned), weights, sizes);
        next.axes = std::move(frame.axes);
        next.remainder =
            add(product(frame.inverse, rest), product(product(frame.inverse, turned), remainder));
        next.hull = intersect(direct, next.affine_hull(deviation));
        if (is_empty(next.hull)) {
            throw std::logic_error("doubleton: two enclosures of one set are disjoint");
        }
        next.recentre(frame.inverse);
        return next;
    }

private:
    /// The next step expands about m and needs it in the hull: moves m there, and what that changes
    /// into the remainder.
    void recentre(interval_matrix<I> const& inverse) {
        using traits = interval_traits<I>;
        auto const before = centre;
        bool moved = false;
        for (std::size_t i = 0; i < centre.size(); ++i) {
            if (traits::contains(hull[i], centre[i])) continue;
            centre[i] = std::clamp(centre[i], traits::lower(hull[i]), traits::upper(hull[i]));
            moved = true;
        }
        if (!moved) return;
        auto const shift = subtract(point_box<I>(before), centre);
        remainder = add(remainder, product(inverse, shift));
    }
};

/// Completes a failure by what its state spans over the ensemble, what the set has lost besides,
/// and what is likely to help.
template <class I>
void complete(enclosure_failure& why, doubleton<I> const& set, ensemble<I> const& e) {
    using traits = interval_traits<I>;
    why.time = set.time;
    why.until = std::max(why.until, set.time);
    why.spread = traits::rad(product(set.shape, e.deviation)[why.component]);
    why.lost = traits::rad(product(set.axes, set.remainder)[why.component]);
    why.help = advise(why.reason, e.wide, why.spread, why.lost);
}

} // namespace sivid

#endif
