// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_DETAIL_WEAK_WINDOWS_HPP
#define SIVID_PAVING_RELATION_DETAIL_WEAK_WINDOWS_HPP

#include <sivid/model/graph/rewrite.hpp>
#include <sivid/paving/relation/detail/cell_means.hpp>
#include <sivid/paving/relation/detail/observed_motion.hpp>
#include <sivid/paving/relation/detail/relation_row.hpp>
#include <sivid/paving/relation/integrand_set.hpp>
#include <sivid/paving/relation/relation_finding.hpp>
#include <sivid/paving/relation/state_samples.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <tuple>
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

/// Windows of an equation \f$ r' = \sum \theta_j \phi_j + \phi_0 \f$ for a state r that was not
/// measured while q with \f$ q' = r \f$ was: multiplied by a bump w and integrated by parts,
///   \f[ \int w'' q = \sum_j \theta_j (\int w \psi_j - \kappa_j \int w' q), \quad
///       \phi_j = \psi_j + \kappa_j r \f]
/// in which r stands no longer and a constant error of q does not either: nothing has to be known
/// of r, where each \f$ \phi_j \f$ is affine in it with a constant slope \f$ \kappa_j \f$.
///   q runs along straight lines between the middles of what is known of it at the ends of cells,
/// for which the integrals are sums, and beside them within what is open.
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

    /// Nothing if some function is not affine in r.
    /// @param g    of the functions; functions without r are added
    /// @param own  r and q
    [[nodiscard]] static std::optional<weak_windows> of(graph& g, integrand_set const& set,
                                                        derivative_pair const& own) {
        weak_windows result;
        result.own_ = own;
        for (std::size_t j = 0; j < set.functions.size(); ++j) {
            auto const slope = set.slopes[j][own.r];
            if (!g.is_literal(slope) || !set.continuous[j]) return std::nullopt;
            result.kappa_.push_back(g.value(g[slope]).enclosure);
        }
        auto const same = graph(g);
        auto const r = g.leaf(operation::state, own.r);
        auto const without = copy_into(g, same, set.functions, [&](node const& n, graph& to) {
            auto const leaf = to.leaf(n.op, static_cast<std::size_t>(n.index));
            return leaf == r ? to.constant(0.0) : leaf;
        });
        result.still_ = integrand_set::of(g, without, set.states, set.inputs);
        return result;
    }

    /// All windows of some lengths, from the shortest of the options to the record, on a grid of
    /// starts.
    /// @param options  whose `go_on` ends with those found by then where it is false
    /// @cost  O(cells) for each window
    [[nodiscard]] std::vector<window_row> over(observed_motion const& motion, std::size_t index,
                                               relation_options const& options) const {
        std::vector<window_row> result;
        auto const& tube = motion.sensed[own_.q];
        if (!tube || motion.cells.empty()) return result;
        auto const means = means_over(still_, motion.cells, {own_});
        auto const lines = lines_along(motion);
        auto const& times = tube->times();
        double const all = times.back() - times.front();
        state_samples const samples{times, {}};
        double length = samples.seen().span(options.shortest_gaps, options.shortest_share);
        for (; length > 0 && length <= all * (1 + 1e-9); length *= 1.25) {
            double next = times.front();
            for (std::size_t a = 0; a < times.size(); ++a) {
                if (times[a] < next) continue;
                if (options.go_on && !options.go_on()) return result;
                auto const at =
                    std::lower_bound(times.begin(), times.end(), times[a] + length * (1 - 1e-9));
                if (at == times.end()) break;
                next = times[a] + length / 8;
                window_row w;
                w.motion = index;
                w.from = times[a];
                w.to = *at;
                if (fill(motion, means, lines, w)) result.push_back(std::move(w));
            }
        }
        return result;
    }

private:
    [[nodiscard]] std::vector<straight> lines_along(observed_motion const& motion) const {
        std::vector<straight> result;
        auto const& tube = motion.tubes[own_.q];
        for (auto const& cell : motion.cells) {
            auto& line = result.emplace_back();
            if (!tube || !tube->covers(cell.from, cell.to)) {
                line.off = HUGE_VAL;
                continue;
            }
            double const first = mid(tube->over(cell.from, cell.from));
            double const last = mid(tube->over(cell.to, cell.to));
            std::tie(line.beside, line.off) = tube->beside_line(cell.from, cell.to, first, last);
            bool undefined = false;
            auto const h = traits::sub(traits::point(cell.to), traits::point(cell.from));
            line.slope =
                traits::div(traits::sub(traits::point(last), traits::point(first)), h, undefined);
        }
        return result;
    }

    [[nodiscard]] bool fill(observed_motion const& motion,
                            std::vector<std::vector<cell_means>> const& means,
                            std::vector<straight> const& lines, window_row& w) const {
        bool undefined = false;
        auto const first = motion.boundary_at(w.from);
        auto const last = motion.boundary_at(w.to);
        auto const begin = traits::point(w.from);
        auto const length = traits::sub(traits::point(w.to), begin);
        auto const square = traits::sqr(length);
        auto bent = traits::point(0.0);   // int w'' q
        auto turned = traits::point(0.0); // int w' q
        std::vector<interval> weighted(means.size(), traits::point(0.0));
        auto const place = [&](double t) {
            return traits::intersect(
                traits::div(traits::sub(traits::point(t), begin), length, undefined),
                traits::bounds(0.0, 1.0));
        };
        auto from = place(motion.cells[first].from);
        auto until = bump::integral(from);
        for (std::size_t c = first; c < last; ++c) {
            auto const& cell = motion.cells[c];
            auto const to = place(cell.to);
            auto const up_to = bump::integral(to);
            auto const s = traits::hull(from, to);
            auto const h = traits::sub(traits::point(cell.to), traits::point(cell.from));
            auto const value = bump::value(s);
            auto const w1 = traits::div(bump::slope(s), length, undefined);
            auto const w2 = traits::div(bump::curvature(s), square, undefined);
            // int w over the cell; straight lines meet at the ends of cells, where what [w' q] and
            // [w q] give cancels: int w'' q = - sum (slope [w]), int w' q = - sum (slope int w).
            auto const whole = traits::mul(length, traits::sub(up_to, until));
            auto const rise = traits::sub(bump::value(to), bump::value(from));
            auto const& q = lines[c];
            auto const open = traits::mul(h, q.times(w2));
            bent = traits::add(bent, traits::sub(open, traits::mul(q.slope, rise)));
            auto const apart = traits::mul(h, q.times(w1));
            turned = traits::add(turned, traits::sub(apart, traits::mul(q.slope, whole)));
            auto const mean = traits::div(whole, h, undefined);
            double const off = mag(traits::sub(value, mean));
            for (std::size_t j = 0; j < weighted.size(); ++j) {
                auto const& f = means[j][c];
                auto const swung = traits::mul(traits::point(off), traits::point(f.swing)).upper();
                auto const part =
                    traits::mul(h, traits::add(traits::mul(traits::intersect(value, mean), f.whole),
                                               traits::bounds(-swung, swung)));
                weighted[j] = traits::add(weighted[j], part);
            }
            from = to;
            until = up_to;
        }
        bool bad = undefined;
        w.difference = bent;
        w.length = traits::mul(bump::whole(), length);
        for (std::size_t j = 0; j < weighted.size(); ++j) {
            w.a.push_back(traits::sub(weighted[j], traits::mul(kappa_[j], turned)));
            bad = bad || !is_bounded(w.a.back());
        }
        return !bad && is_bounded(bent);
    }

    derivative_pair own_;
    std::vector<interval> kappa_; ///< of each function
    integrand_set still_;         ///< \f$ \psi_j \f$
};

} // namespace sivid

#endif
