// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_DETAIL_WEAK_WINDOWS_HPP
#define SIVID_PAVING_RELATION_DETAIL_WEAK_WINDOWS_HPP

#include <sivid/model/graph/rewrite.hpp>
#include <sivid/paving/relation/detail/cell_means.hpp>
#include <sivid/paving/relation/detail/observed_motion.hpp>
#include <sivid/paving/relation/detail/relation_row.hpp>
#include <sivid/paving/relation/integrand_set.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace sivid {

/// A bump on [0, 1]: \f$ w(s) = 16 s^2 (1 - s)^2 \f$, zero with its first derivative at both ends,
/// 1 in the middle, \f$ \int w = 8/15 \f$.
struct bump {
    using traits = interval_traits<interval>;

    /// Encloses w, w' or w'' over s.
    [[nodiscard]] static interval value(interval const& s) {
        return traits::mul(traits::point(16.0), traits::sqr(around_middle(s)));
    }
    [[nodiscard]] static interval slope(interval const& s) { // 32 s (1 - s)(1 - 2 s)
        auto const turn = traits::sub(traits::point(1.0), traits::mul(traits::point(2.0), s));
        return traits::mul(traits::point(32.0), traits::mul(around_middle(s), turn));
    }
    /// \f$ \int_0^s w \f$, which ends at 8/15.
    [[nodiscard]] static interval integral(interval const& s) { // 16 s^3 (1/3 - s/2 + s^2/5)
        bool undefined = false;
        auto const third = traits::div(traits::point(1.0), traits::point(3.0), undefined);
        auto const fifth = traits::div(s, traits::point(5.0), undefined);
        auto const inner = traits::sub(traits::point(0.5), fifth);
        auto const sum = traits::sub(third, traits::mul(s, inner));
        return traits::mul(traits::mul(traits::point(16.0), s), traits::mul(traits::sqr(s), sum));
    }
    [[nodiscard]] static interval curvature(interval const& s) { // 32 (1 - 6 s (1 - s))
        auto const inner = traits::mul(traits::point(6.0), around_middle(s));
        return traits::mul(traits::point(32.0), traits::sub(traits::point(1.0), inner));
    }

    [[nodiscard]] static interval whole() {
        bool undefined = false;
        return traits::div(traits::point(8.0), traits::point(15.0), undefined);
    }

private:
    /// s (1 - s) = 1/4 - (s - 1/2)^2, without overestimation.
    [[nodiscard]] static interval around_middle(interval const& s) {
        return traits::sub(traits::point(0.25), traits::sqr(traits::sub(s, traits::point(0.5))));
    }
};

/// A weight that begins where a motion does: \f$ w(s) = 1 - s \f$ on [0, 1], zero at the end,
/// \f$ \int w = 1/2 \f$.
struct ramp {
    using traits = interval_traits<interval>;

    [[nodiscard]] static interval value(interval const& s) {
        return traits::sub(traits::point(1.0), s);
    }
    [[nodiscard]] static interval slope(interval const&) { return traits::point(-1.0); }
    /// \f$ \int_0^s w = s - s^2/2 = (1 - (1 - s)^2)/2 \f$
    [[nodiscard]] static interval integral(interval const& s) {
        return traits::mul(whole(), traits::sub(traits::point(1.0), traits::sqr(value(s))));
    }
    [[nodiscard]] static interval curvature(interval const&) { return traits::point(0.0); }
    [[nodiscard]] static interval whole() { return traits::point(0.5); }
};

/// Windows of an equation \f$ r' = \sum \theta_j \phi_j + \phi_0 \f$ for a state r that was not
/// measured while q with \f$ q' = r \f$ was: multiplied by a bump w and integrated by parts,
///   \f[ \int w'' q = \sum_j \theta_j (\int w \psi_j - \sum_p \kappa_{jp} \int w' q_p), \quad
///       \phi_j = \psi_j + \sum_p \kappa_{jp} r_p \f]
/// in which r stands no longer, nor do the rates \f$ r_p \f$ of other measured states, and a
/// constant error of q does not either: where \f$ \phi_j \f$ is affine in a rate, with a constant
/// slope \f$ \kappa_j \f$. Where it is not, the rate stays in \f$ \psi_j \f$.
///   A motion whose start is known says more with a weight that is not zero there (`ramp`), over
/// a time T:
///   \f[ \int_0^T (1 - t/T) \, r' \, dt = \frac{q(T) - q(0)}{T} - r(0) , \f]
/// in which the error of one position counts once, divided by T.
///   Each q runs along straight lines between the middles of what is known of it at the ends of
/// cells, for which the integrals are sums, and beside them within what is open.
class weak_windows {
    using traits = interval_traits<interval>;

public:
    /// A state over one cell: along a straight line, but for what is open beside it.
    struct straight {
        interval slope{0.0};  ///< of the line
        interval beside{0.0}; ///< at any time
        double off = 0;       ///< and besides, on the average: at most

        /// Encloses the mean of a weight times what is open beside the line. What is known on the
        /// average only may lie where the weight is largest: it counts apart.
        [[nodiscard]] interval times(interval const& weight) const {
            if (!std::isfinite(off)) return traits::entire();
            auto const apart = traits::mul(traits::point(mag(weight)), traits::bounds(-off, off));
            return traits::add(traits::mul(weight, beside), apart);
        }
    };

    /// Nothing if nothing is known of r and some function is not affine in it.
    /// @param g       of the functions; functions without the rates are added
    /// @param own     r and q
    /// @param others  pairs of measured states and their rates
    /// @param known   whether r is known by other means, and the starts
    [[nodiscard]] static std::optional<weak_windows>
    of(graph& g, integrand_set const& set, derivative_pair const& own,
       std::vector<derivative_pair> const& others = {}, bool known = false) {
        weak_windows result;
        result.from_start_ = known;
        auto const affine = [&](std::size_t j, std::size_t r) {
            return g.is_literal(set.slopes[j][r]) && set.continuous[j];
        };
        auto const count = set.functions.size();
        for (std::size_t j = 0; j < count && !known; ++j) {
            if (!affine(j, own.r)) return std::nullopt;
        }
        result.pairs_.push_back(own);
        for (auto const& p : others) {
            bool used = false;
            for (std::size_t j = 0; j < count; ++j)
                used = used || (set.uses(j, p.r) && affine(j, p.r));
            if (used && p.r != own.r) result.pairs_.push_back(p);
        }
        for (auto const& p : result.pairs_) {
            auto& kappa = result.kappa_.emplace_back();
            for (std::size_t j = 0; j < count; ++j) {
                kappa.push_back(affine(j, p.r) ? g.value(g[set.slopes[j][p.r]]).enclosure
                                               : interval(0.0));
            }
        }
        auto const same = graph(g);
        std::vector<node_id> without;
        for (std::size_t j = 0; j < count; ++j) {
            std::vector<node_id> rates;
            for (auto const& p : result.pairs_) {
                if (affine(j, p.r)) rates.push_back(g.leaf(operation::state, p.r));
            }
            auto const own_part =
                copy_into(g, same, {set.functions[j]}, [&](node const& n, graph& to) {
                    auto const leaf = to.leaf(n.op, static_cast<std::size_t>(n.index));
                    return std::find(rates.begin(), rates.end(), leaf) == rates.end()
                               ? leaf
                               : to.constant(0.0);
                });
            without.push_back(own_part[0]);
        }
        result.still_ = integrand_set::of(g, without, set.states, set.inputs);
        return result;
    }
    /// Whose rates are integrated by parts, beside that of the equation's own state.
    [[nodiscard]] std::vector<derivative_pair> const& pairs() const { return pairs_; }

    /// All windows of some lengths between `shortest` and `longest` on a grid of starts; and, where
    /// starts are known, those that begin with the motion, of any length up to `longest`.
    /// @param go_on  false ends with those found by then; may be empty
    /// @cost  O(cells) for each window
    [[nodiscard]] std::vector<window_row> over(observed_motion const& motion, std::size_t index,
                                               double shortest, double longest,
                                               std::function<bool()> const& go_on = {}) const {
        std::vector<window_row> result;
        auto const& tube = motion.sensed[pairs_[0].q];
        if (!tube || motion.cells.empty()) return result;
        auto const known = known_along(motion);
        auto const& times = tube->times();
        auto const add = [&](auto const& weight, double from, double to) {
            window_row w;
            w.motion = index;
            w.from = from;
            w.to = to;
            if (fill(weight, motion, known, w)) result.push_back(std::move(w));
        };
        double const all = times.back() - times.front();
        for (double length = shortest; length <= std::min(longest, all) * (1 + 1e-9);
             length *= 1.25) {
            double next = times.front();
            for (std::size_t a = 0; a < times.size(); ++a) {
                if (times[a] < next) continue;
                if (go_on && !go_on()) return result;
                auto const at =
                    std::lower_bound(times.begin(), times.end(), times[a] + length * (1 - 1e-9));
                if (at == times.end()) break;
                next = times[a] + length / 8;
                add(bump(), times[a], *at);
            }
        }
        bool const begins = from_start_ && motion.boundaries.front() == motion.begin;
        if (!begins || pairs_[0].r >= motion.start.size()) return result; // a state of an effect
        double next = motion.begin;
        for (double const to : times) {
            if (to <= motion.begin || to < next || (go_on && !go_on())) continue;
            if (to - motion.begin > longest * (1 + 1e-9)) break;
            next = to + 0.1 * (to - motion.begin);
            add(ramp(), motion.begin, to);
        }
        return result;
    }

private:
    struct known_cells {
        std::vector<std::vector<cell_means>> means; ///< of \f$ \psi_j \f$: [function][cell]
        std::vector<std::vector<straight>> lines;   ///< of each pair's q: [pair][cell]
        /// Of functions that are affine in r over a cell alone, by which slope: [function][cell].
        std::vector<std::vector<interval>> bends;
    };

    [[nodiscard]] known_cells known_along(observed_motion const& motion) const {
        auto const r = pairs_[0].r;
        known_cells result{means_over(still_, motion.cells, {pairs_[0]}), lines_along(motion), {}};
        for (auto& means : result.means) {
            auto& bends = result.bends.emplace_back();
            for (std::size_t c = 0; c < means.size(); ++c) {
                auto& m = means[c];
                auto const& slope = m.slopes[0];
                bool const affine =
                    from_start_ && is_bounded(m.frozen) && slope.lower() == slope.upper();
                bends.push_back(affine ? slope : traits::point(0.0));
                if (!affine || slope.lower() == 0) continue;
                auto const& cell = motion.cells[c];
                auto const centre = traits::point(cell.lines[r].centre);
                auto const moved = traits::mul(slope, traits::point(width(cell.at.states[r])));
                m.whole = traits::sub(m.frozen, traits::mul(slope, centre));
                m.swing = traits::add(traits::point(m.swing), traits::abs(moved)).upper();
            }
        }
        return result;
    }

    [[nodiscard]] std::vector<std::vector<straight>>
    lines_along(observed_motion const& motion) const {
        std::vector<std::vector<straight>> result;
        for (auto const& p : pairs_) {
            auto& own = result.emplace_back();
            for (auto const& cell : motion.cells) {
                auto const& tube = motion.tubes[p.q];
                auto& line = own.emplace_back();
                if (!tube || !tube->covers(cell.from, cell.to)) {
                    line.off = HUGE_VAL;
                    continue;
                }
                double const first = mid(tube->over(cell.from, cell.from));
                double const last = mid(tube->over(cell.to, cell.to));
                std::tie(line.beside, line.off) =
                    tube->beside_line(cell.from, cell.to, first, last);
                bool undefined = false;
                auto const h = traits::sub(traits::point(cell.to), traits::point(cell.from));
                line.slope = traits::div(traits::sub(traits::point(last), traits::point(first)), h,
                                         undefined);
            }
        }
        return result;
    }

    /// @tparam Weight  a `bump`, or a `ramp` where the motion begins with the window
    template <class Weight>
    [[nodiscard]] bool fill(Weight const&, observed_motion const& motion, known_cells const& known,
                            window_row& w) const {
        bool undefined = false;
        auto const first = motion.boundary_at(w.from);
        auto const last = motion.boundary_at(w.to);
        auto const begin = traits::point(w.from);
        auto const length = traits::sub(traits::point(w.to), begin);
        auto const square = traits::sqr(length);
        auto bent = traits::point(0.0);                                  // int w r'
        std::vector<interval> turned(pairs_.size(), traits::point(0.0)); // - int w r_p
        std::vector<interval> weighted(known.means.size(), traits::point(0.0));
        auto bend = weighted; // in the cell before
        auto const place = [&](double t) {
            return traits::intersect(
                traits::div(traits::sub(traits::point(t), begin), length, undefined),
                traits::bounds(0.0, 1.0));
        };
        auto from = place(motion.cells[first].from);
        if constexpr (std::is_same_v<Weight, ramp>) {
            auto const open = beside_line(motion, pairs_[0].q, w.to);
            bent = traits::sub(traits::div(open, length, undefined), motion.start[pairs_[0].r]);
            for (std::size_t p = 0; p < pairs_.size(); ++p)
                turned[p] = beside_line(motion, pairs_[p].q, w.from);
            bent = traits::sub(bent, traits::div(turned[0], length, undefined));
        }
        auto until = Weight::integral(from);
        for (std::size_t c = first; c < last; ++c) {
            auto const& cell = motion.cells[c];
            auto const to = place(cell.to);
            auto const up_to = Weight::integral(to);
            auto const s = traits::hull(from, to);
            auto const h = traits::sub(traits::point(cell.to), traits::point(cell.from));
            auto const value = Weight::value(s);
            auto const w1 = traits::div(Weight::slope(s), length, undefined);
            auto const w2 = traits::div(Weight::curvature(s), square, undefined);
            // int w over the cell; straight lines meet at the ends of cells, where what [w' q] and
            // [w q] give cancels: int w'' q = - sum (slope [w]), int w' q = - sum (slope int w),
            // but for the begin.
            auto const whole = traits::mul(length, traits::sub(up_to, until));
            auto const rise = traits::sub(Weight::value(to), Weight::value(from));
            auto const& own = known.lines[0][c];
            auto const open = traits::mul(h, own.times(w2));
            bent = traits::add(bent, traits::sub(open, traits::mul(own.slope, rise)));
            auto const turn = [&](straight const& q) {
                auto const apart = traits::mul(h, q.times(w1));
                return traits::sub(apart, traits::mul(q.slope, whole));
            };
            for (std::size_t p = 0; p < pairs_.size(); ++p)
                turned[p] = traits::add(turned[p], turn(known.lines[p][c]));
            auto const mean = traits::div(whole, h, undefined);
            double const off = mag(traits::sub(value, mean));
            for (std::size_t j = 0; j < weighted.size(); ++j) {
                auto const& f = known.means[j][c];
                auto const swung = traits::mul(traits::point(off), traits::point(f.swing)).upper();
                auto const part =
                    traits::mul(h, traits::add(traits::mul(traits::intersect(value, mean), f.whole),
                                               traits::bounds(-swung, swung)));
                weighted[j] = traits::add(weighted[j], part);
                auto const& now = known.bends[j][c];
                if (mag(now) == 0 && mag(bend[j]) == 0) continue;
                // What q lies beside its line by cancels at the ends of cells of one slope.
                auto const change = traits::mul(traits::sub(bend[j], now), Weight::value(from));
                auto const left = traits::mul(change, beside_line(motion, pairs_[0].q, cell.from));
                weighted[j] =
                    traits::add(weighted[j], traits::sub(left, traits::mul(now, turn(own))));
                bend[j] = now;
            }
            from = to;
            until = up_to;
        }
        bool bad = undefined;
        w.difference = bent;
        w.length = traits::mul(Weight::whole(), length);
        for (std::size_t j = 0; j < weighted.size(); ++j) {
            for (std::size_t p = 0; p < pairs_.size(); ++p) {
                weighted[j] = traits::sub(weighted[j], traits::mul(kappa_[p][j], turned[p]));
            }
            w.a.push_back(weighted[j]);
            bad = bad || !is_bounded(w.a.back());
        }
        return !bad && is_bounded(bent);
    }

    /// By how much q lies beside its line where a cell begins or ends.
    [[nodiscard]] static interval beside_line(observed_motion const& motion, std::size_t q,
                                              double t) {
        auto const known = motion.tubes[q]->over(t, t);
        return traits::sub(known, traits::point(mid(known)));
    }

    std::vector<derivative_pair> pairs_;       ///< the equation's own first
    std::vector<std::vector<interval>> kappa_; ///< [pair][function]
    integrand_set still_;                      ///< \f$ \psi_j \f$
    bool from_start_ = false;
};

} // namespace sivid

#endif
