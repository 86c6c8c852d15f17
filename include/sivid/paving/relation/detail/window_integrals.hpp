// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_DETAIL_WINDOW_INTEGRALS_HPP
#define SIVID_PAVING_RELATION_DETAIL_WINDOW_INTEGRALS_HPP

#include <sivid/paving/relation/detail/cell_means.hpp>
#include <sivid/paving/relation/integrand_set.hpp>
#include <sivid/paving/relation/time_cell.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace sivid {

/// Encloses \f$ \int_{t_a}^{t_b} \phi_j dt \f$ between any two boundaries of a grid of cells.
///   Directly: each cell contributes its length times the mean of \f$ \phi_j \f$, which lies in the
///   natural range and in the mean value form; there a drift averages out but for the width of the
///   slope: the mean of D v lies in \f$ [D] spread + rad [D] drift/4 + mag [D] departure \f$. By
///   parts, for pairs \f$ q' = r \f$: \f[ \int \phi = \int (\phi - g r) + [g q] - \int g' q \f]
///   with a known g(t) near \f$ \partial\phi/\partial r \f$, piecewise linear and slow, so that the
///   first integrand hardly depends on r, and the others need the bounds of q, once at each end,
///   where those of r would count all along the window.
/// @guarantee  encloses the integral for every motion in the cells (by parts: with \f$ q' = r \f$)
///             along which \f$ \phi_j \f$ is defined
/// @cost  three evaluations of the graph for each cell; O(1) for each window
class window_integrals {
    using traits = interval_traits<interval>;

public:
    /// @param cells   adjacent, in the order of time
    /// @param pairs   one for each r; none where the integrals are weighted
    /// @param growth  a: every integrand is multiplied by \f$ e^{a (t - t_{end})} \f$ [1/s]
    /// @param slow    the time over which g is straight; 0: all that the cells span
    window_integrals(integrand_set const& set, std::vector<time_cell> const& cells,
                     std::vector<derivative_pair> const& pairs, double growth = 0, double slow = 0)
        : pairs_(pairs) {
        auto const count = set.functions.size();
        auto const n = cells.size();
        direct_.assign(count, {});
        parts_.assign(count, {});
        weight_.assign(count, std::vector<std::vector<double>>(pairs.size()));
        auto const ranges = means_over(set, cells, pairs);
        if (growth > 0) weigh(cells, growth);
        for (std::size_t j = 0; j < count; ++j) {
            std::vector<interval> whole(n), rest(n);
            for (std::size_t c = 0; c < n; ++c) {
                auto const h =
                    traits::sub(traits::point(cells[c].to), traits::point(cells[c].from));
                whole[c] = traits::mul(h, weighted(ranges[j][c], c));
                rest[c] = traits::mul(h, ranges[j][c].frozen);
            }
            for (std::size_t p = 0; p < pairs.size(); ++p) {
                if (!set.uses(j, pairs[p].r)) continue;
                weight_[j][p] = slow_weight(ranges[j], cells, p, slow);
                for (std::size_t c = 0; c < n; ++c) {
                    rest[c] = traits::add(rest[c], in_parts(ranges[j][c], cells[c], p, c, j));
                }
            }
            direct_[j] = prefix(whole);
            parts_[j] = prefix(rest);
        }
    }

    /// The weight at a boundary.
    [[nodiscard]] interval weight_at(std::size_t k) const {
        return weights_.empty() ? traits::point(1.0) : weights_[k].at;
    }
    /// Whether parts differ from the direct way.
    [[nodiscard]] bool has_parts(std::size_t j) const {
        return std::any_of(weight_[j].begin(), weight_[j].end(),
                           [](auto const& g) { return !g.empty(); });
    }
    /// Encloses the integral of function j from boundary a to boundary b.
    [[nodiscard]] interval direct(std::size_t j, std::size_t a, std::size_t b) const {
        return between(direct_[j], a, b);
    }
    /// The same by parts.
    /// @param q_at  encloses state q at a boundary: (q, boundary) -> interval
    template <class StateAt>
    [[nodiscard]] interval by_parts(std::size_t j, std::size_t a, std::size_t b,
                                    StateAt const& q_at) const {
        auto result = between(parts_[j], a, b);
        for (std::size_t p = 0; p < pairs_.size(); ++p) {
            auto const& g = weight_[j][p];
            if (g.empty()) continue;
            auto const end = traits::mul(traits::point(g[b]), q_at(pairs_[p].q, b));
            auto const begin = traits::mul(traits::point(g[a]), q_at(pairs_[p].q, a));
            result = traits::add(result, traits::sub(end, begin));
        }
        return result;
    }

private:
    /// The weight at the begin of a cell, its mean over the cell, and by how much it is off that.
    struct cell_weight {
        interval at, mean{0.0};
        double off = 0;
    };
    /// Running sums of the lower and of the upper ends, each enclosed.
    struct prefix_sums {
        std::vector<interval> lower, upper;
        std::vector<std::size_t> unbounded;
    };

    void weigh(std::vector<time_cell> const& cells, double growth) {
        auto const at = [&](interval const& t) {
            auto const since = traits::sub(t, traits::point(cells.back().to));
            return traits::exp(traits::mul(traits::point(growth), since));
        };
        for (auto const& c : cells) {
            auto const from = traits::point(c.from);
            auto const to = traits::point(c.to);
            auto const half = traits::point(0.5);
            auto const chord = traits::mul(half, traits::add(at(from), at(to)));
            // It is convex: the mean lies between the middle of the arc and that of the chord.
            auto const mean = traits::hull(at(traits::mul(half, traits::add(from, to))), chord);
            auto const off = traits::sub(traits::hull(at(from), at(to)), mean);
            weights_.push_back({at(from), mean, mag(off)});
        }
        if (!cells.empty()) weights_.push_back({traits::point(1.0)});
    }
    /// The mean of weight times function over a cell: of the mean weight, and what moves it times
    /// what moves the function, whose means are 0.
    [[nodiscard]] interval weighted(cell_means const& f, std::size_t c) const {
        if (weights_.empty()) return f.whole;
        auto const& w = weights_[c];
        double const off = traits::mul(traits::point(w.off), traits::point(f.swing)).upper();
        return traits::add(traits::mul(w.mean, f.whole), traits::bounds(-off, off));
    }

    /// g at the boundaries: the mean slope around knots at distance `slow`, straight in between.
    [[nodiscard]] static std::vector<double> slow_weight(std::vector<cell_means> const& ranges,
                                                         std::vector<time_cell> const& cells,
                                                         std::size_t p, double slow) {
        if (cells.empty()) return {0.0};
        double const from = cells.front().from;
        double const length = cells.back().to - from;
        auto const pieces = slow > 0 ? std::max(1.0, std::ceil(length / slow * (1 - 1e-9))) : 1;
        auto const knots = static_cast<std::size_t>(pieces) + 1;
        double const step = length / static_cast<double>(knots - 1);
        std::vector<double> sum(knots, 0.0), share(knots, 1e-300);
        for (std::size_t c = 0; c < cells.size(); ++c) {
            if (!is_bounded(ranges[c].slopes[p])) continue;
            double const h = cells[c].to - cells[c].from;
            auto const k = static_cast<std::size_t>(
                std::round(((cells[c].from + cells[c].to) / 2 - from) / step));
            sum[std::min(k, knots - 1)] += h * mid(ranges[c].slopes[p]);
            share[std::min(k, knots - 1)] += h;
        }
        std::vector<double> result;
        for (std::size_t c = 0; c <= cells.size(); ++c) {
            double const t = c < cells.size() ? cells[c].from : cells.back().to;
            double const place = std::clamp((t - from) / step, 0.0, static_cast<double>(knots - 1));
            auto const k = std::min(static_cast<std::size_t>(place), knots - 2);
            double const s = place - static_cast<double>(k);
            result.push_back((1 - s) * sum[k] / share[k] + s * sum[k + 1] / share[k + 1]);
        }
        return result;
    }

    /// What one pair adds in one cell, up to the boundary terms [g q]: the mean of
    /// \f$ (\partial\phi/\partial r - g)(r - r_c) - g r_c \f$ times the length, minus the mean of q
    /// times the change of g.
    [[nodiscard]] interval in_parts(cell_means const& r, time_cell const& cell, std::size_t p,
                                    std::size_t c, std::size_t j) const {
        auto const& weight = weight_[j][p];
        auto const g0 = traits::point(weight[c]);
        auto const g1 = traits::point(weight[c + 1]);
        auto const h = traits::sub(traits::point(cell.to), traits::point(cell.from));
        auto const& line_r = cell.lines[pairs_[p].r];
        auto const& line_q = cell.lines[pairs_[p].q];
        auto const remainder = mean_product(traits::sub(r.slopes[p], traits::hull(g0, g1)), line_r);
        auto const mean = traits::mul(traits::point(0.5), traits::add(g0, g1));
        auto const inner = traits::sub(remainder, traits::mul(mean, traits::point(line_r.centre)));
        auto const mean_q = traits::add(traits::add(traits::point(line_q.centre), line_q.spread),
                                        traits::bounds(-line_q.departure, line_q.departure));
        auto const change = traits::mul(traits::sub(g1, g0), mean_q);
        return traits::sub(traits::mul(h, inner), change);
    }

    [[nodiscard]] static prefix_sums prefix(std::vector<interval> const& cells) {
        prefix_sums result;
        result.lower.push_back(traits::point(0.0));
        result.upper.push_back(traits::point(0.0));
        result.unbounded.push_back(0);
        for (auto const& x : cells) {
            bool const usable = is_bounded(x);
            auto const lo = traits::point(usable ? x.lower() : 0.0);
            auto const hi = traits::point(usable ? x.upper() : 0.0);
            result.lower.push_back(traits::add(result.lower.back(), lo));
            result.upper.push_back(traits::add(result.upper.back(), hi));
            result.unbounded.push_back(result.unbounded.back() + (usable ? 0 : 1));
        }
        return result;
    }
    [[nodiscard]] static interval between(prefix_sums const& s, std::size_t a, std::size_t b) {
        if (s.unbounded[a] != s.unbounded[b]) return traits::entire();
        return traits::bounds(traits::sub(s.lower[b], s.lower[a]).lower(),
                              traits::sub(s.upper[b], s.upper[a]).upper());
    }

    std::vector<derivative_pair> pairs_;
    std::vector<prefix_sums> direct_, parts_;
    std::vector<cell_weight> weights_;                     ///< and that at the end; empty: 1
    std::vector<std::vector<std::vector<double>>> weight_; ///< g: [function][pair][boundary]
};

} // namespace sivid

#endif
