// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_DETAIL_WEAK_WINDOWS_HPP
#define SIVID_PAVING_RELATION_DETAIL_WEAK_WINDOWS_HPP

#include <sivid/paving/relation/detail/observed_motion.hpp>
#include <sivid/paving/relation/detail/relation_row.hpp>
#include <sivid/paving/relation/detail/window_integrals.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
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
    [[nodiscard]] static interval curvature(interval const& s) { // 32 (1 - 6 s (1 - s))
        auto const inner = traits::mul(traits::point(6.0), around_middle(s));
        return traits::mul(traits::point(32.0), traits::sub(traits::point(1.0), inner));
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
/// in which r stands no longer, and a constant error of q does not either. It needs \f$ \phi_j \f$
/// that are affine in r with constant slopes \f$ \kappa_j \f$.
class weak_windows {
    using traits = interval_traits<interval>;

public:
    /// Nothing if some function is not affine in r.
    [[nodiscard]] static std::optional<weak_windows> of(integrand_set const& set,
                                                        derivative_pair const& pair) {
        weak_windows result;
        result.pair_ = pair;
        for (std::size_t j = 0; j < set.functions.size(); ++j) {
            auto const slope = set.slopes[j][pair.r];
            if (!set.g->is_literal(slope) || !set.continuous[j]) return std::nullopt;
            result.kappa_.push_back(set.g->value((*set.g)[slope]).enclosure);
        }
        result.set_ = &set;
        return result;
    }

    /// All windows of some lengths between `shortest` and `longest` on a grid of starts.
    /// @param go_on  false ends with those found by then; may be empty
    /// @cost  O(cells) for each window
    [[nodiscard]] std::vector<window_row> over(observed_motion const& motion, std::size_t index,
                                               double shortest, double longest,
                                               std::function<bool()> const& go_on = {}) const {
        std::vector<window_row> result;
        auto const& tube = motion.sensed[pair_.q];
        if (!tube || motion.cells.empty()) return result;
        auto const psi = functions_without_r(motion);
        auto const& times = tube->times();
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
                window_row w;
                w.motion = index;
                w.from = times[a];
                w.to = *at;
                if (fill(motion, psi, w)) result.push_back(std::move(w));
            }
        }
        return result;
    }

private:
    /// \f$ \psi_j \f$ over each cell: the function with r = 0.
    [[nodiscard]] std::vector<std::vector<interval>>
    functions_without_r(observed_motion const& motion) const {
        graph_range range(*set_->g, set_->functions);
        std::vector<std::vector<interval>> result;
        for (auto const& cell : motion.cells) {
            auto at = cell.at;
            at.states[pair_.r] = traits::point(0.0);
            range.evaluate(at);
            auto& row = result.emplace_back();
            for (auto const f : set_->functions) {
                row.push_back(range.undefined(f) ? traits::entire() : range.value(f));
            }
        }
        return result;
    }

    [[nodiscard]] bool fill(observed_motion const& motion,
                            std::vector<std::vector<interval>> const& psi, window_row& w) const {
        bool undefined = false;
        auto const first = motion.boundary_at(w.from);
        auto const last = motion.boundary_at(w.to);
        auto const begin = traits::point(w.from);
        auto const length = traits::sub(traits::point(w.to), begin);
        auto const square = traits::sqr(length);
        // int w'' (alpha + beta t) = 0: q is taken relative to a straight line.
        double const q0 = mid(motion.state_over(pair_.q, w.from, w.from));
        double const q1 = mid(motion.state_over(pair_.q, w.to, w.to));
        auto const line = [&](interval const& s) {
            return traits::add(traits::point(q0),
                               traits::mul(s, traits::sub(traits::point(q1), traits::point(q0))));
        };
        auto bent = traits::point(0.0); // int w'' q
        // int w' q = int w' (q - line) - (q1 - q0) int w / length.
        auto turned = traits::point(0.0);
        std::vector<interval> weighted(set_->functions.size(), traits::point(0.0));
        for (std::size_t c = first; c < last; ++c) {
            auto const& cell = motion.cells[c];
            auto const place = [&](double t) {
                return traits::intersect(
                    traits::div(traits::sub(traits::point(t), begin), length, undefined),
                    traits::bounds(0.0, 1.0));
            };
            auto const s = traits::hull(place(cell.from), place(cell.to));
            auto const h = traits::sub(traits::point(cell.to), traits::point(cell.from));
            auto const off = traits::sub(cell.at.states[pair_.q], line(s));
            auto const w2 = traits::div(bump::curvature(s), square, undefined);
            auto const w1 = traits::div(bump::slope(s), length, undefined);
            bent = traits::add(bent, traits::mul(h, traits::mul(w2, off)));
            turned = traits::add(turned, traits::mul(h, traits::mul(w1, off)));
            auto const hw = traits::mul(h, bump::value(s));
            for (std::size_t j = 0; j < weighted.size(); ++j) {
                weighted[j] = traits::add(weighted[j], traits::mul(hw, psi[c][j]));
            }
        }
        bool bad = undefined;
        auto const mean = traits::div(traits::point(8.0), traits::point(15.0), undefined);
        auto const rise = traits::sub(traits::point(q1), traits::point(q0));
        turned = traits::sub(turned, traits::mul(rise, mean));
        w.difference = bent;
        w.length = traits::mul(mean, length);
        for (std::size_t j = 0; j < weighted.size(); ++j) {
            w.a.push_back(traits::sub(weighted[j], traits::mul(kappa_[j], turned)));
            bad = bad || !is_bounded(w.a.back());
        }
        return !bad && is_bounded(bent);
    }

    derivative_pair pair_;
    std::vector<interval> kappa_;
    integrand_set const* set_ = nullptr;
};

} // namespace sivid

#endif
