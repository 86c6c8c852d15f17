// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_SET_PARAMETRIC_SET_HPP
#define SIVID_ENCLOSURE_SET_PARAMETRIC_SET_HPP

#include <sivid/enclosure/failure.hpp>
#include <sivid/enclosure/normalised_unknowns.hpp>
#include <sivid/number/polynomial/taylor_model_functions.hpp>
#include <sivid/space/box.hpp>
#include <sivid/space/frame/detail/common_frame.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace sivid {

namespace enclosure_detail {
/// Writes one side's model into a lane.
template <class C>
void put(normalised_unknowns::side const& s, std::size_t lane, taylor_model<C>& m) {
    using side_by_side = lane_traits<C>;
    for (auto& c : m.coefficients()) side_by_side::put(c, lane, 0.0);
    side_by_side::put(m.c(0), lane, s.centre);
    side_by_side::put(m.r(), lane, s.radius == 0 ? s.rest : 0.0);
    if (s.radius != 0) side_by_side::put(m.c(m.space().variable(s.variable)), lane, s.radius);
    m.finish();
}
} // namespace enclosure_detail

/// The states of a family at one time,
///   \f$ x(q) \in P(q) + \ell + \sum_j g_j(q) \xi_j,\; \xi \in [-1,1]^m \f$, for each q in
///   \f$ [-1,1]^N \f$:
/// polynomials of degree D in the unknowns, digits of theirs beyond those of doubles, and what is
/// lost on the way in generators that are themselves polynomials of degree (D+1)/2, so that they
/// keep their dependence on q as they are carried, and never have to be inverted.
/// @tparam Model  of single families, or in lanes: families side by side, each at its own time
template <class Model = taylor_model<double>>
struct parametric_set {
    using C = typename Model::scalar;
    using shape_type = typename Model::shape_type;
    using side_by_side = lane_traits<C>;
    using mask = typename side_by_side::mask;
    using column = std::vector<Model>;

    C time{};
    std::vector<Model> centre;   ///< P, radii 0
    std::vector<C> tail;         ///< \f$ \ell \f$, 0 but for points: see `parametric_flow`
    std::vector<column> columns; ///< g_j, radii 0
    std::vector<C> reach;        ///< \f$ E_i \ge |\ell_i| + \sum_j \|g_{ij}\| \f$

    explicit parametric_set(std::size_t states = 0, shape_type const& s = shape_type::number())
        : centre(states, Model(s)), tail(states), reach(states) {}

    /// Starts the family of one lane.
    /// @param alone  no other lane is in use: all start so, since functions of what stands idle are
    ///   computed, too, and bounds of nothing cost most
    void begin(std::size_t lane, double t, normalised_unknowns const& unknowns,
               bool alone = false) {
        std::vector<C> rest(centre.size());
        tail.resize(centre.size());
        for (std::size_t l = 0; l < side_by_side::count; ++l) {
            if (l != lane && !alone) continue;
            side_by_side::put(time, l, t);
            for (auto& g : columns) {
                for (auto& entry : g) {
                    for (auto& c : entry.coefficients()) side_by_side::put(c, l, 0.0);
                    side_by_side::put(entry.r(), l, 0.0); // infinite where the lane was lost
                    entry.finish();
                }
            }
            for (std::size_t i = 0; i < centre.size(); ++i) {
                enclosure_detail::put(unknowns.initial[i], l, centre[i]);
                side_by_side::put(rest[i], l, side_by_side::get(centre[i].r(), l));
                side_by_side::put(tail[i], l, 0.0);
            }
        }
        for (auto& p : centre) p.r() = 0.0;
        append(rest);
        measure();
    }

    /// Adds the box \f$ \prod [-s_i, s_i] \f$ as generators along the axes.
    void append(std::vector<C> const& s) {
        for (std::size_t i = 0; i < s.size(); ++i) {
            if (side_by_side::all(s[i] == C(0.0))) continue;
            column g(s.size());
            g[i] = Model::constant(known(s[i])); // NaN: nothing is known
            columns.push_back(std::move(g));
        }
    }
    /// Recomputes the reach.
    void measure() {
        reach.assign(centre.size(), C(0.0));
        for (std::size_t i = 0; i < tail.size(); ++i) reach[i] = side_by_side::abs(tail[i]);
        for (auto const& g : columns) {
            for (std::size_t i = 0; i < g.size(); ++i) reach[i] += g[i].norm();
        }
        double const up = 1 + static_cast<double>(columns.size() + 4) * Model::unit;
        for (auto& e : reach) e = known(e * up);
    }

    /// A box that contains the set.
    [[nodiscard]] box hull(std::size_t lane = 0) const {
        using traits = interval_traits<interval>;
        box result(centre.size());
        for (std::size_t i = 0; i < centre.size(); ++i) {
            double const e = side_by_side::get(reach[i], lane);
            auto const p = lane_of(centre[i], lane);
            result[i] = std::isfinite(e) && std::isfinite(p.norm())
                            ? traits::add(range(p), traits::bounds(-e, e))
                            : traits::entire();
        }
        return result;
    }

    /// Limits the number of generators: the longest stay, the others are boxed in the orthogonal
    /// frame of the longest directions.
    /// @param used  the lanes that matter for the choice; sound in all of them
    void reduce(std::size_t most, mask used = mask(true));

private:
    static C known(C const& x) {
        return side_by_side::select(x >= C(0.0), x, C(std::numeric_limits<double>::infinity()));
    }
    /// Sum over the used lanes of each length as a share of the lane's longest: a common order.
    static std::vector<double> shares(std::vector<C> const& lengths, mask used) {
        std::vector<double> result(lengths.size(), 0.0);
        for (std::size_t l = 0; l < side_by_side::count; ++l) {
            if (!side_by_side::test(used, l)) continue;
            double longest = 0;
            for (auto const& x : lengths) longest = std::max(longest, side_by_side::get(x, l));
            if (!(longest > 0) || !std::isfinite(longest)) continue;
            for (std::size_t j = 0; j < result.size(); ++j) {
                result[j] += side_by_side::get(lengths[j], l) / longest;
            }
        }
        return result;
    }
};

/// Completes a failure by what its state spans as a function of the unknowns, what the set has lost
/// besides, and what is likely to help.
template <class Model>
void complete(enclosure_failure& why, parametric_set<Model> const& set, std::size_t lane,
              normalised_unknowns const& unknowns) {
    using side_by_side = typename parametric_set<Model>::side_by_side;
    why.time = side_by_side::get(set.time, lane);
    why.until = std::max(why.until, why.time);
    why.spread = side_by_side::get(set.centre[why.component].spread(), lane);
    why.lost = side_by_side::get(set.reach[why.component], lane);
    why.help = advise(why.reason, unknowns.variables > 0, why.spread, why.lost);
}

/// One of the families that lie side by side.
template <class Model>
[[nodiscard]] auto lane_of(parametric_set<Model> const& set, std::size_t lane) {
    using C = typename Model::scalar;
    parametric_set<decltype(lane_of(set.centre.front(), lane))> result;
    result.time = lane_traits<C>::get(set.time, lane);
    for (auto const& p : set.centre) result.centre.push_back(lane_of(p, lane));
    for (auto const& x : set.tail) result.tail.push_back(lane_traits<C>::get(x, lane));
    for (auto const& g : set.columns) {
        auto& column = result.columns.emplace_back();
        for (auto const& entry : g) column.push_back(lane_of(entry, lane));
    }
    for (auto const& e : set.reach) result.reach.push_back(lane_traits<C>::get(e, lane));
    return result;
}

template <class Model>
void parametric_set<Model>::reduce(std::size_t most, mask used) {
    auto const n = centre.size();
    if (columns.size() <= most || columns.size() < 2 * n) return;
    std::vector<C> length(columns.size());
    for (std::size_t j = 0; j < columns.size(); ++j) {
        for (auto const& entry : columns[j]) length[j] += entry.norm();
    }
    auto const score = shares(length, used);
    std::vector<std::size_t> order(columns.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return score[a] > score[b]; });
    std::size_t const kept = most > 3 * n ? most - 3 * n : 0;

    std::vector<std::vector<C>> directions;
    for (std::size_t k = kept; k < order.size(); ++k) {
        auto& d = directions.emplace_back(n);
        for (std::size_t i = 0; i < n; ++i) d[i] = columns[order[k]][i].c()[0];
    }
    auto const frame =
        common_frame(std::move(directions), [&](auto const& x) { return shares(x, used); });
    double up = 1; // enough for the sums over the terms of an entry
    for (auto const& g : columns) {
        for (auto const& entry : g) up = std::max(up, entry.shape().up);
    }
    // Coordinates of the dropped columns in the frame: (1 + R)^{-1} Q^T g with |R| <= defect.
    std::vector<C> side(n);
    std::vector<C> along(n);
    for (std::size_t k = kept; k < order.size(); ++k) {
        auto const& g = columns[order[k]];
        C most_along{};
        for (std::size_t i = 0; i < n; ++i) {
            C sum{}, mass{};
            std::size_t terms = 1;
            for (auto const& entry : g) terms = std::max(terms, entry.terms());
            for (std::size_t m = 0; m < terms; ++m) {
                C c{};
                for (std::size_t l = 0; l < n; ++l) {
                    if (m < g[l].terms()) c += frame.axis[i][l] * g[l].c(m);
                }
                sum += side_by_side::abs(c);
            }
            for (std::size_t l = 0; l < n; ++l) {
                mass += side_by_side::abs(frame.axis[i][l]) * g[l].norm();
            }
            along[i] = sum * up + mass * (static_cast<double>(n + 4) * Model::unit) + Model::tiny;
            most_along = side_by_side::max(along[i], most_along);
        }
        for (std::size_t i = 0; i < n; ++i) side[i] += along[i] + frame.defect * most_along;
    }
    std::vector<column> next;
    for (std::size_t k = 0; k < kept; ++k) next.push_back(std::move(columns[order[k]]));
    std::vector<C> lost(n); // by rounding the new columns
    for (std::size_t i = 0; i < n; ++i) {
        C const s = side[i] * (1 + 8 * static_cast<double>(order.size() + 4) * Model::unit);
        if (side_by_side::all(s == C(0.0))) continue;
        column g(n);
        for (std::size_t l = 0; l < n; ++l) {
            C const e = frame.axis[i][l] * s;
            g[l] = Model::constant(e);
            lost[l] += side_by_side::abs(e) * (2 * Model::unit) + Model::tiny;
        }
        next.push_back(std::move(g));
    }
    columns = std::move(next);
    for (auto& l : lost) l *= 1 + 64 * Model::unit;
    append(lost);
}

} // namespace sivid

#endif
