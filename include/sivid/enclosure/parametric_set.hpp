// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_PARAMETRIC_SET_HPP
#define SIVID_ENCLOSURE_PARAMETRIC_SET_HPP

#include <sivid/number/taylor_model_functions.hpp>
#include <sivid/space/box.hpp>
#include <sivid/space/matrix.hpp>
#include <sivid/space/orthogonal_frame.hpp>

#include <Eigen/Core>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace sivid {

/// What is unknown about a family of trajectories, as variables \f$ q \in [-1,1]^N \f$: every side
/// of the boxes of parameters and initial states that has a width is centre + radius * q_v.
struct normalised_unknowns {
    struct side {
        double centre = 0;
        double radius = 0; ///< 0: the side is a point up to `rest`
        double rest = 0;   ///< width of what has no variable
        std::size_t variable = 0;
    };
    std::vector<side> initial;
    std::vector<side> parameters;
    std::size_t variables = 0;

    /// Sides narrower than this, relative to their size, get no variable: they are decimals.
    static constexpr double negligible = 1e-13;

    normalised_unknowns(box const& x0, box const& p) {
        auto const add = [this](interval const& x) {
            side s;
            s.centre = mid(x);
            double const r = rad(x);
            if (r <= negligible * std::abs(s.centre)) {
                s.rest = r;
            } else {
                s.radius = r;
                s.variable = variables++;
            }
            return s;
        };
        for (auto const& x : p) parameters.push_back(add(x));
        for (auto const& x : x0) initial.push_back(add(x));
    }

    template <std::size_t N, std::size_t D>
    [[nodiscard]] static taylor_model<N, D> model(side const& s) {
        if (s.radius == 0) return widened(taylor_model<N, D>::constant(s.centre), s.rest);
        return taylor_model<N, D>::variable(s.variable, s.centre, s.radius);
    }
    template <std::size_t N, std::size_t D>
    [[nodiscard]] std::vector<taylor_model<N, D>> parameter_models() const {
        std::vector<taylor_model<N, D>> models;
        for (auto const& s : parameters) models.push_back(model<N, D>(s));
        return models;
    }
};

/// The states of a family at one time,
///   \f$ x(q) \in P(q) + \sum_j g_j(q) \xi_j,\; \xi \in [-1,1]^m \f$, for each q in \f$ [-1,1]^N
///   \f$:
/// polynomials of degree D in the unknowns, and what is lost on the way in generators that are
/// themselves polynomials of degree (D+1)/2, so that they keep their dependence on q as they are
/// carried, and never have to be inverted.
template <std::size_t N, std::size_t D>
struct parametric_set {
    static constexpr std::size_t column_degree = (D + 1) / 2;
    using polynomial = taylor_model<N, D>;
    using column_entry = taylor_model<N, column_degree>;
    using column = std::vector<column_entry>;

    double time = 0;
    std::vector<polynomial> centre; ///< P, radii 0
    std::vector<column> columns;    ///< g_j, radii 0
    std::vector<double> reach;      ///< \f$ E_i \ge \sum_j \|g_{ij}\| \f$

    [[nodiscard]] static parametric_set start(double time, normalised_unknowns const& unknowns) {
        parametric_set set;
        set.time = time;
        std::vector<double> rest;
        for (auto const& s : unknowns.initial) {
            set.centre.push_back(normalised_unknowns::model<N, D>(s));
            rest.push_back(set.centre.back().r);
            set.centre.back().r = 0;
        }
        set.append(rest);
        set.measure();
        return set;
    }

    /// Adds the box \f$ \prod [-s_i, s_i] \f$ as generators along the axes.
    void append(std::vector<double> const& s) {
        for (std::size_t i = 0; i < s.size(); ++i) {
            if (s[i] == 0) continue;
            column g(s.size());
            bool const known = s[i] > 0; // NaN: nothing is known
            g[i] = column_entry::constant(known ? s[i] : std::numeric_limits<double>::infinity());
            columns.push_back(std::move(g));
        }
    }
    /// Recomputes the reach.
    void measure() {
        reach.assign(centre.size(), 0.0);
        for (auto const& g : columns) {
            for (std::size_t i = 0; i < g.size(); ++i) reach[i] += g[i].norm();
        }
        double const up = 1 + static_cast<double>(columns.size() + 4) * polynomial::unit;
        for (auto& e : reach) e = e >= 0 ? e * up : std::numeric_limits<double>::infinity();
    }

    /// A box that contains the set.
    [[nodiscard]] box hull() const {
        using traits = interval_traits<interval>;
        box result(centre.size());
        for (std::size_t i = 0; i < centre.size(); ++i) {
            result[i] = std::isfinite(reach[i]) && std::isfinite(centre[i].norm())
                            ? traits::add(range(centre[i]), traits::bounds(-reach[i], reach[i]))
                            : traits::entire();
        }
        return result;
    }

    /// Limits the number of generators: the longest stay, the others are boxed in the orthogonal
    /// frame of the longest directions.
    void reduce(std::size_t most) {
        auto const n = centre.size();
        if (columns.size() <= most || columns.size() < 2 * n) return;
        std::vector<double> length(columns.size(), 0.0);
        for (std::size_t j = 0; j < columns.size(); ++j) {
            for (auto const& entry : columns[j]) length[j] += entry.norm();
        }
        std::vector<std::size_t> order(columns.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return length[a] > length[b]; });
        std::size_t const kept = most > 3 * n ? most - 3 * n : 0;
        auto const axes = frame_of(order, kept);
        std::vector<double> side(n, 0.0);
        for (std::size_t k = kept; k < order.size(); ++k) {
            for (std::size_t i = 0; i < n; ++i) {
                product_sum<N, column_degree> along;
                for (std::size_t l = 0; l < n; ++l) {
                    along.add(scaled(columns[order[k]][l], axes.inverse(i, l)));
                }
                side[i] += along.result().norm();
            }
        }
        std::vector<column> next;
        for (std::size_t k = 0; k < kept; ++k) next.push_back(std::move(columns[order[k]]));
        std::vector<double> lost(n, 0.0); // by rounding the new columns
        for (std::size_t i = 0; i < n; ++i) {
            double const s =
                side[i] * (1 + 4 * static_cast<double>(order.size()) * polynomial::unit);
            if (s == 0) continue;
            column g(n);
            for (std::size_t l = 0; l < n; ++l) {
                auto const q =
                    axes.axes(static_cast<Eigen::Index>(l), static_cast<Eigen::Index>(i));
                g[l] = column_entry::constant(q * s);
                lost[l] += 2 * polynomial::unit * std::abs(q * s) + polynomial::tiny;
            }
            next.push_back(std::move(g));
        }
        columns = std::move(next);
        for (auto& l : lost) l *= 1 + 64 * polynomial::unit;
        append(lost);
    }

private:
    /// An orthogonal frame of the longest independent directions among the columns after `kept`.
    [[nodiscard]] orthogonal_frame<interval> frame_of(std::vector<std::size_t> const& order,
                                                      std::size_t kept) const {
        auto const n = static_cast<Eigen::Index>(centre.size());
        auto const dropped = static_cast<Eigen::Index>(order.size() - kept);
        Eigen::MatrixXd directions(n, dropped);
        for (Eigen::Index k = 0; k < dropped; ++k) {
            auto const& g = columns[order[kept + static_cast<std::size_t>(k)]];
            for (Eigen::Index l = 0; l < n; ++l) {
                directions(l, k) = g[static_cast<std::size_t>(l)].c[0];
            }
        }
        orthogonal_frame<interval> frame{Eigen::MatrixXd::Identity(n, n),
                                         interval_matrix<interval>::identity(centre.size())};
        if (!directions.allFinite()) return frame;
        Eigen::MatrixXd const q =
            Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(directions).householderQ();
        interval_matrix<interval> inverse;
        if (q.allFinite() && enclose_inverse<interval>(q, inverse)) {
            frame.axes = q;
            frame.inverse = std::move(inverse);
        }
        return frame;
    }
};

} // namespace sivid

#endif
