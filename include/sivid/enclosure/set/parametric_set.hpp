// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_SET_PARAMETRIC_SET_HPP
#define SIVID_ENCLOSURE_SET_PARAMETRIC_SET_HPP

#include <sivid/enclosure/failure.hpp>
#include <sivid/enclosure/normalised_unknowns.hpp>
#include <sivid/number/polynomial/taylor_model_functions.hpp>
#include <sivid/space/box.hpp>
#include <sivid/space/frame/detail/lane_frame.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace sivid {

namespace enclosure_detail {
/// By what states are measured: sizes of theirs, but 1 for one that is beyond 1e100, below 1e-100
/// or no number.
template <class C>
[[nodiscard]] std::vector<C> fair_units(std::vector<C> const& sizes) {
    std::vector<C> units;
    for (auto const& size : sizes) {
        auto const fair = (size > C(1e-100)) & (size < C(1e100));
        units.push_back(lane_traits<C>::select(fair, size, C(1.0)));
    }
    return units;
}

/// A box in an almost orthogonal frame \f$ Q \f$ that contains \f$ \sum_j g_j(q) \xi_j \f$ for all
/// q and \f$ \xi \in [-1,1]^m \f$ (`docs/theory/taylor_models.md`, section 2, "Reduction").
/// @tparam Model  of the entries of g_j, with radius 0
template <class Model>
class framed_box {
    using C = typename Model::scalar;
    using side_by_side = lane_traits<C>;
    using column = std::vector<Model>;

public:
    /// @param first, last  of the columns g_j, with an entry for each state
    /// @param sizes  one for each state: the frame is orthogonal in `fair_units` of them
    template <class Iterator>
    framed_box(Iterator first, Iterator last, std::vector<C> const& sizes)
        : unit_(fair_units(sizes)), sides_(sizes.size()) {
        auto const n = sizes.size();
        std::vector<std::vector<C>> directions;
        double up = 1; // enough for the sums over the terms of an entry
        std::size_t count = 0;
        for (auto g = first; g != last; ++g, ++count) {
            auto& d = directions.emplace_back(n);
            for (std::size_t i = 0; i < n; ++i) {
                d[i] = (*g)[i].c()[0] / unit_[i];
                up = std::max(up, (*g)[i].shape().up);
            }
        }
        frame_ = make_lane_frame(std::move(directions));
        for (auto g = first; g != last; ++g) add(*g, up);
        for (auto& s : sides_) s = s * (1 + 8 * static_cast<double>(count + 4) * Model::unit);
    }

    /// Half the length of the side along axis k, in units.
    [[nodiscard]] C const& side(std::size_t k) const { return sides_[k]; }
    /// The vector from the middle to the side, as doubles.
    /// @param lost  for each state: what their roundings are at most is added
    [[nodiscard]] std::vector<C> edge(std::size_t k, std::vector<C>& lost) const {
        std::vector<C> e(unit_.size());
        for (std::size_t i = 0; i < e.size(); ++i) {
            e[i] = frame_.axis[k][i] * sides_[k] * unit_[i];
            lost[i] += (side_by_side::abs(e[i]) * (2 * Model::unit) + Model::tiny) *
                       (1 + 64 * Model::unit);
        }
        return e;
    }

private:
    /// The coordinates of a column in the frame are \f$ (1 + R)^{-1} Q^T g \f$ with |R| <= defect.
    /// Quotient, product and n - 1 sums of a term are rounded: by less than (n + 4) units together.
    void add(column const& g, double up) {
        auto const n = unit_.size();
        std::vector<C> along(n);
        C most_along{};
        std::size_t terms = 1;
        for (auto const& entry : g) terms = std::max(terms, entry.terms());
        for (std::size_t k = 0; k < n; ++k) {
            C sum{}, mass{};
            for (std::size_t m = 0; m < terms; ++m) {
                C c{};
                for (std::size_t i = 0; i < n; ++i) {
                    if (m < g[i].terms()) c += frame_.axis[k][i] * (g[i].c(m) / unit_[i]);
                }
                sum += side_by_side::abs(c);
            }
            for (std::size_t i = 0; i < n; ++i) {
                mass += side_by_side::abs(frame_.axis[k][i]) * (g[i].norm() / unit_[i]);
            }
            along[k] = sum * up + mass * (static_cast<double>(n + 4) * Model::unit) + Model::tiny;
            most_along = side_by_side::max(along[k], most_along);
        }
        for (std::size_t k = 0; k < n; ++k) sides_[k] += along[k] + frame_.defect * most_along;
    }

    std::vector<C> unit_;
    lane_frame<C> frame_;
    std::vector<C> sides_;
};
} // namespace enclosure_detail

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
    std::vector<column> columns; ///< g_j, radii 0, oldest first
    std::vector<C> reach;        ///< \f$ E_i \ge |\ell_i| + \sum_j \|g_{ij}\| \f$
    std::vector<C> largest;      ///< about the largest |x_i| so far; no proof rests on it

    explicit parametric_set(std::size_t states = 0, shape_type const& s = shape_type::number())
        : centre(states, Model(s)), tail(states), reach(states), largest(states) {}

    /// Starts the family of one lane.
    /// @param alone  no other lane is in use: all start so, since functions of what stands idle are
    ///   computed, too, and bounds of nothing cost most
    void begin(std::size_t lane, double t, normalised_unknowns const& unknowns,
               bool alone = false) {
        std::vector<C> rest(centre.size());
        tail.resize(centre.size());
        largest.resize(centre.size());
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
                side_by_side::put(largest[i], l, 0.0);
            }
        }
        for (auto& p : centre) p.r() = 0.0;
        append(rest);
        measure();
    }

    /// Adds the box \f$ \prod [-s_i, s_i] \f$ as generators along the axes.
    void append(std::vector<C> const& s) {
        std::size_t added = 0;
        for (std::size_t i = 0; i < s.size(); ++i) {
            if (side_by_side::all(s[i] == C(0.0))) continue;
            column g(s.size());
            g[i] = Model::constant(known(s[i])); // NaN: nothing is known
            columns.push_back(std::move(g));
            ++added;
        }
        if (added > 0) groups_.push_back({1, added});
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
        for (std::size_t i = 0; i < largest.size(); ++i)
            largest[i] = side_by_side::max(largest[i], centre[i].norm() + reach[i]);
    }

    /// Some lanes of another set; each keeps generators of its own.
    void take(mask lanes, parametric_set const& from) {
        auto const all = std::max(columns.size(), from.columns.size());
        if (all > columns.size()) groups_.push_back({1, all - columns.size()});
        columns.resize(all, column(centre.size()));
        time = side_by_side::select(lanes, from.time, time);
        for (std::size_t i = 0; i < centre.size(); ++i) {
            centre[i] = select(lanes, from.centre[i], centre[i]);
            tail[i] = side_by_side::select(lanes, from.tail[i], tail[i]);
            reach[i] = side_by_side::select(lanes, from.reach[i], reach[i]);
            largest[i] = side_by_side::select(lanes, from.largest[i], largest[i]);
            for (std::size_t j = 0; j < all; ++j) {
                auto const other = j < from.columns.size() ? from.columns[j][i] : Model();
                columns[j][i] = select(lanes, other, columns[j][i]);
            }
        }
    }
    /// State i is 0 in these lanes.
    void rest(mask lanes, std::size_t i) {
        centre[i] = select(lanes, Model::constant(C(0.0)), centre[i]);
        for (auto& g : columns) g[i] = select(lanes, Model::constant(C(0.0)), g[i]);
        tail[i] = side_by_side::select(lanes, C(0.0), tail[i]);
        reach[i] = side_by_side::select(lanes, C(0.0), reach[i]);
    }
    /// Whether state i is 0, exactly and whatever the unknowns.
    [[nodiscard]] mask rests(std::size_t i) const {
        return centre[i].norm() + reach[i] == C(0.0);
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

    /// Limits the number of generators. Most of the longest stay as they are; the others are boxed,
    /// those of neighbouring steps together, in the orthogonal frame of their longest directions,
    /// in units of what each state has lost.
    ///   Each time that something is boxed it loses some dependence. So the steps are parted in
    /// groups, and two neighbours are joined whose older one has fewest steps for each of the newer
    /// one's: of N steps none is boxed much more often than log(N) times, however few the columns.
    /// @param lost  what this costs by rounding is added
    /// @param used  the lanes that matter for the choice; sound in all of them
    void reduce(std::size_t most, std::vector<C>& lost, mask used = mask(true));

private:
    /// Of steps that follow each other.
    struct group {
        std::size_t steps, columns;
    };

    /// @param unit  one for each state
    /// @given  count is at least the number of states
    /// @returns how many columns stand for them, at most one a state
    std::size_t box_together(std::size_t first, std::size_t count, std::vector<C> const& unit,
                             std::vector<C>& lost);
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
                double const share = side_by_side::get(lengths[j], l) / longest;
                result[j] += share >= 0 ? share : 0; // else no number
            }
        }
        return result;
    }

    std::vector<group> groups_; ///< whose columns stand one after the other
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
    if (why.help == advice::other_set) why.help = advice::higher_degree;
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
    for (auto const& x : set.largest) result.largest.push_back(lane_traits<C>::get(x, lane));
    return result;
}

template <class Model>
void parametric_set<Model>::reduce(std::size_t most, std::vector<C>& lost, mask used) {
    if (columns.size() <= most) return;
    auto const n = centre.size();
    measure();
    // By what each has lost, so that no unit of a state decides on the frame.
    auto const unit = enclosure_detail::fair_units(reach);
    std::vector<C> length(columns.size());
    for (std::size_t j = 0; j < columns.size(); ++j) {
        for (std::size_t i = 0; i < n; ++i) length[j] += columns[j][i].norm() / unit[i];
    }
    auto score = shares(length, used);
    double const longest = [&] {
        auto order = score;
        auto const at = order.begin() + static_cast<std::ptrdiff_t>(
                                            std::min(most / 2, most - std::min(most, 2 * n)));
        std::nth_element(order.begin(), at, order.end(), std::greater<>());
        return *at;
    }();
    while (columns.size() > most && groups_.size() > 1) {
        std::size_t older = 0;
        auto const gap = [this](std::size_t k) {
            return static_cast<double>(groups_[k].steps) /
                   static_cast<double>(groups_[k + 1].steps);
        };
        for (std::size_t k = 1; k + 1 < groups_.size(); ++k)
            older = gap(k) < gap(older) ? k : older;
        std::size_t first = 0;
        for (std::size_t k = 0; k < older; ++k) first += groups_[k].columns;
        auto& both = groups_[older];
        both.steps += groups_[older + 1].steps;
        both.columns += groups_[older + 1].columns;
        groups_.erase(groups_.begin() + static_cast<std::ptrdiff_t>(older) + 1);
        std::size_t shorter = 0; // these come first
        for (std::size_t k = first; k < first + both.columns; ++k) {
            if (score[k] > longest * (1 + 1e-9)) continue; // no rounding decides
            std::swap(score[k], score[first + shorter]);
            columns[k].swap(columns[first + shorter]);
            ++shorter;
        }
        // Fewer are not worth what boxing loses.
        if (shorter < 3 * n && (groups_.size() > 1 || shorter <= n)) continue;
        auto const made = box_together(first, shorter, unit, lost);
        score.erase(score.begin() + static_cast<std::ptrdiff_t>(first + made),
                    score.begin() + static_cast<std::ptrdiff_t>(first + shorter));
        both.columns -= shorter - made;
    }
}

template <class Model>
std::size_t parametric_set<Model>::box_together(std::size_t first, std::size_t count,
                                                std::vector<C> const& unit, std::vector<C>& lost) {
    auto const begin = columns.begin() + static_cast<std::ptrdiff_t>(first);
    enclosure_detail::framed_box<Model> const around(
        begin, begin + static_cast<std::ptrdiff_t>(count), unit);
    std::size_t made = 0;
    for (std::size_t k = 0; k < centre.size(); ++k) {
        if (side_by_side::all(around.side(k) == C(0.0))) continue;
        auto const edge = around.edge(k, lost);
        auto& g = columns[first + made++];
        for (std::size_t i = 0; i < edge.size(); ++i) g[i] = Model::constant(edge[i]);
    }
    columns.erase(columns.begin() + static_cast<std::ptrdiff_t>(first + made),
                  columns.begin() + static_cast<std::ptrdiff_t>(first + count));
    return made;
}

} // namespace sivid

#endif
