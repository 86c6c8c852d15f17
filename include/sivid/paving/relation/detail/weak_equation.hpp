// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_DETAIL_WEAK_EQUATION_HPP
#define SIVID_PAVING_RELATION_DETAIL_WEAK_EQUATION_HPP

#include <sivid/paving/relation/detail/parted_functions.hpp>
#include <sivid/paving/relation/detail/relation_row.hpp>
#include <sivid/paving/relation/relation_finding.hpp>
#include <sivid/paving/relation/state_samples.hpp>
#include <sivid/work_clock.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace sivid {

/// An equation as it is stated, \f$ \sum_j \theta_j \psi_j(t, x, x', u) + \psi_0 = 0 \f$, under
/// weights \f$ \varphi \f$ that are linear between the samples of a state q: \f$ \int \varphi
/// \psi_j \f$ where neither q' nor q'' is measured.
///   Of functions in two parts (`parted_functions`) the linear one has integrals that are sums over
/// samples, with X, linear between them too, and its slopes s,
///   \f[ \int X q'' = X q' \big| - \sum s_k (q_{k+1} - q_k), \quad
///       \int X q' = X q \big| - \sum s_k \int_{t_k}^{t_{k+1}} q : \f]
/// errors of q count by what the whole equation says of them, nothing is differentiated.
/// @guarantee  encloses the integrals for every motion in the cells
/// @cost  some tens of operations for each sample, function and window
class weak_equation {
    using traits = interval_traits<interval>;

public:
    explicit weak_equation(parted_functions const& functions)
        : functions_(&functions), times_(functions.times()) {}

    /// Windows under bumps, and, where starts are known, such that begin with the motion. Of some
    /// lengths from `options.shortest_gaps` to the record; of shorter ones where that is not eight
    /// times as long as the shortest.
    /// @param options  whose `go_on` ends with those found by then where it is false
    [[nodiscard]] std::vector<window_row> over(std::size_t index,
                                               relation_options const& options) const {
        auto const& go_on = options.go_on;
        std::vector<window_row> result;
        if (times_.size() < 3) return result; // a window spans two gaps at least
        auto const add = [&](std::size_t a, std::size_t b, auto const& weight) {
            std::vector<double> phi;
            for (std::size_t k = a; k <= b; ++k)
                phi.push_back(weight((times_[k] - times_[a]) / (times_[b] - times_[a])));
            phi.back() = 0;
            window_row w;
            w.motion = index;
            w.from = times_[a];
            w.to = times_[b];
            if (fill(a, phi, w)) result.push_back(std::move(w));
        };
        auto const bump = [](double s) { return 16 * s * s * (1 - s) * (1 - s); };
        auto const ramp = [](double s) { return 1 - s; };
        double const all = times_.back() - times_.front();
        auto const first_after = [this](double t) {
            return static_cast<std::size_t>(
                std::lower_bound(times_.begin(), times_.end(), t - 1e-9 * (times_[1] - times_[0])) -
                times_.begin());
        };
        double least_gap = all;
        for (std::size_t k = 0; k + 1 < times_.size(); ++k)
            least_gap = std::min(least_gap, times_[k + 1] - times_[k]);
        state_samples const samples{times_, {}};
        double length = samples.seen().span(options.shortest_gaps, options.shortest_share);
        while (8 * length > all) length /= 1.3;
        while (length < least_gap) length *= 1.3;
        double const longest = all * (1 + 1e-9);
        for (; length <= longest; length *= 1.3) {
            double const step = length / 6;
            double from = times_.front();
            for (std::size_t a = 0;; ++a) {
                if (go_on && !go_on()) return result;
                a = std::max(a, first_after(from));
                if (a >= times_.size()) break;
                auto const b = first_after(times_[a] + length);
                if (b >= times_.size()) break;
                if (b > a + 1) add(a, b, bump);
                from += step * (1 + std::floor(std::max(times_[a] - from, 0.0) / step));
            }
        }
        if (!starts_known()) return result;
        for (std::size_t b = 2; b < times_.size(); b += 1 + b / 10) {
            if (times_[b] - times_[0] > longest || (go_on && !go_on())) break;
            add(0, b, ramp);
        }
        return result;
    }

private:
    /// Whether the motion begins with the samples, in what is known of all rates that count.
    [[nodiscard]] bool starts_known() const {
        auto const& motion = functions_->motion();
        auto const& parts = functions_->parts();
        return times_.front() == motion.begin &&
               std::all_of(parts.begin(), parts.end(), [&](auto const& p) {
                   return p.order < 2 || functions_->rate_of(p) < motion.start.size();
               });
    }
    /// @param phi  the weight at samples from number a on, 0 at the last
    [[nodiscard]] bool fill(std::size_t a, std::vector<double> const& phi, window_row& w) const {
        w.difference = traits::point(0.0);
        w.length = traits::point(0.0);
        auto const gaps = phi.size() - 1;
        auto const half = traits::point(0.5);
        for (std::size_t g = 0; g < gaps; ++g) {
            auto const sum = traits::add(traits::point(phi[g]), traits::point(phi[g + 1]));
            w.length = traits::add(w.length, traits::mul(traits::mul(half, gap(a + g)), sum));
        }
        for (std::size_t j = 0; j < functions_->functions(); ++j) {
            auto total = traits::point(0.0);
            for (std::size_t g = 0; g < gaps; ++g) {
                auto const& [even, rising] = functions_->rest(j, a + g);
                auto const first = traits::point(phi[g]);
                auto const change = traits::sub(traits::point(phi[g + 1]), first);
                total = traits::add(total, traits::mul(first, even));
                total = traits::add(total, traits::mul(change, rising));
            }
            for (std::size_t q = 0; q < functions_->states(); ++q)
                total = traits::add(total, sampled_part(j, q, a, phi));
            w.a.push_back(total);
            if (!is_bounded(total)) return false;
        }
        return true;
    }
    [[nodiscard]] interval gap(std::size_t k) const {
        return traits::sub(traits::point(times_[k + 1]), traits::point(times_[k]));
    }

    /// \f$ \int X_0 q + X_1 q' + X_2 q'' \f$ over a window, from the samples of q.
    [[nodiscard]] interval sampled_part(std::size_t j, std::size_t q, std::size_t a,
                                        std::vector<double> const& phi) const {
        auto const zero = traits::point(0.0);
        auto total = zero;
        std::vector<interval> share(phi.size(), zero);
        auto const& tube = functions_->motion().tubes[q];
        auto const& parts = functions_->parts();
        bool used = false;
        for (std::size_t p = 0; p < parts.size(); ++p) {
            if (parts[p].q != q) continue;
            used = true;
            work_clock::count(2 * phi.size(), work_clock::interval);
            auto const weight = [&](std::size_t k) {
                return traits::mul(traits::point(phi[k]),
                                   traits::point(functions_->factor(j, p, a + k)));
            };
            auto x = weight(0);
            if (parts[p].order == 2 && phi[0] != 0) {
                auto const r = functions_->rate_of(parts[p]);
                total = traits::sub(total, traits::mul(x, functions_->motion().start[r]));
            }
            for (std::size_t g = 0; g + 1 < phi.size(); ++g) {
                auto const next = weight(g + 1);
                add_gap(parts[p].order, x, next, gap(a + g), tube->departure(a + g), share[g],
                        share[g + 1], total);
                x = next;
            }
        }
        for (std::size_t k = 0; used && k < share.size(); ++k)
            total = traits::add(total, traits::mul(share[k], functions_->sample(q, a + k)));
        return total;
    }
    /// One gap's integral: shares of the samples at its ends, and what q departs from its chord by.
    static void add_gap(std::size_t order, interval const& x0, interval const& x1,
                        interval const& h, interval const& departure, interval& first,
                        interval& last, interval& rest) {
        bool undefined = false;
        auto const change = traits::sub(x1, x0);
        auto const sixth = [&](interval const& v) {
            return traits::div(v, traits::point(6.0), undefined);
        };
        auto const two = traits::point(2.0);
        if (order == 2) {
            auto const slope = traits::div(change, h, undefined);
            first = traits::add(first, slope);
            last = traits::sub(last, slope);
        } else if (order == 1) {
            auto const mean = traits::mul(traits::point(0.5), traits::add(x0, x1));
            first = traits::sub(first, mean);
            last = traits::add(last, mean);
            rest = traits::sub(rest, traits::mul(change, sixth(departure)));
        } else {
            auto const part = sixth(h);
            first = traits::add(first, traits::mul(part, traits::add(traits::mul(two, x0), x1)));
            last = traits::add(last, traits::mul(part, traits::add(x0, traits::mul(two, x1))));
            rest =
                traits::add(rest, traits::mul(part, traits::mul(traits::hull(x0, x1), departure)));
        }
    }

    parted_functions const* functions_;
    std::vector<double> times_;
};

} // namespace sivid

#endif
