// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_DETAIL_DERIVATIVE_BOUND_HPP
#define SIVID_PAVING_RELATION_DETAIL_DERIVATIVE_BOUND_HPP

#include <sivid/number/interval_traits.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sivid {

/// What marks of q tell of its rate r, \f$ q' = r \f$, as time goes on in one direction. From a
/// mark at \f$ t_0 \f$ to one at t, with T = t - t_0 (negative backward) and bounds of r' piece by
/// piece in between,
///   \f[ r(t) = \frac{\Delta q}{T} + \frac 1 T \int_{t_0}^t (s - t_0) \, r'(s) \, ds \f]
/// since \f$ q(t) - q(t_0) = T r(t) - \int (s - t_0) r'(s) ds \f$: far marks tell the mean well,
/// near ones what r has done since. A mark on either side tells more: q(t) itself and its error
/// cancel (`between`).
class derivative_bound {
    using traits = interval_traits<interval>;

public:
    /// r' over the next piece of time, which takes so long.
    /// @param duration  encloses it, at least 0 in either direction
    void add(interval const& duration, interval const& rate) {
        auto const before = elapsed_;
        elapsed_ = traits::add(elapsed_, duration);
        bounded_ = bounded_ && is_bounded(rate);
        if (!bounded_) return;
        auto const middle = traits::mul(traits::point(0.5), traits::add(before, elapsed_));
        for (bool const upper : {false, true}) {
            auto const& end = traits::point(upper ? rate.upper() : rate.lower());
            auto& own = upper ? upper_ : lower_;
            auto const gained = traits::mul(duration, end);
            own.sum = traits::add(own.sum, gained);
            own.moment = traits::add(own.moment, traits::mul(middle, gained));
        }
    }
    /// q at the time that is reached.
    void mark(double t, interval const& q) {
        marks_.push_back({t, q, elapsed_, lower_, upper_, bounded_});
        elapsed_ = traits::point(0.0);
        lower_ = upper_ = {};
        bounded_ = true;
    }
    /// What an earlier mark says: \f$ T r(t) = q(t) - q_0 + M \f$.
    struct view {
        interval T, q0, moment;
    };
    /// What earlier marks say of r at the last one.
    struct account {
        interval rate = traits::entire(); ///< encloses r
        std::vector<view> views; ///< of the marks 1, 2, 3, 5, 8, 12 ... before, while they help
    };
    /// @cost  looks at 64 marks at most, and keeps 10
    [[nodiscard]] account told() const {
        account result;
        auto const& last = marks_.back();
        auto const most = std::min(marks_.size() - 1, farthest);
        // Backward, s - t_0 and ds change their signs both: the integral is the same, T is
        // negative.
        sums low, high;
        std::size_t kept = 1;
        for (std::size_t k = 1; k <= most; ++k) {
            auto const& next = marks_[marks_.size() - k]; // with what lies before it
            auto const& first = marks_[marks_.size() - 1 - k];
            if (!next.bounded) break;
            low = earlier(next.lower, next.elapsed, low);
            high = earlier(next.upper, next.elapsed, high);
            view const v{traits::sub(traits::point(last.t), traits::point(first.t)), first.q,
                         traits::bounds(low.moment.lower(), high.moment.upper())};
            bool undefined = false;
            auto const change = traits::add(traits::sub(last.q, v.q0), v.moment);
            auto const here = traits::div(change, v.T, undefined);
            if (undefined || !is_bounded(here)) break;
            result.rate = agreed(result.rate, here);
            if (width(here) > 4 * width(result.rate)) break; // r does too much
            if (k < kept) continue;
            result.views.push_back(v);
            kept = k + (k + 1) / 2;
        }
        return result;
    }
    /// Encloses r at a mark from what marks before and after it say.
    [[nodiscard]] static interval between(std::vector<view> const& before,
                                          std::vector<view> const& after) {
        auto result = traits::entire();
        for (auto const& a : before) {
            for (auto const& b : after) {
                bool undefined = false;
                auto const change =
                    traits::add(traits::sub(b.q0, a.q0), traits::sub(a.moment, b.moment));
                auto const here = traits::div(change, traits::sub(a.T, b.T), undefined);
                if (!undefined) result = agreed(result, here);
            }
        }
        return result;
    }

private:
    static constexpr std::size_t farthest = 64;
    /// \f$ \int r' \f$ and \f$ \int s r' \f$ over a stretch, s since its begin.
    struct sums {
        interval sum{0.0}, moment{0.0};
    };
    /// A stretch and what comes after it.
    [[nodiscard]] static sums earlier(sums const& first, interval const& lasting,
                                      sums const& after) {
        return {
            traits::add(first.sum, after.sum),
            traits::add(first.moment, traits::add(after.moment, traits::mul(lasting, after.sum)))};
    }
    struct sample {
        double t = 0;
        interval q;
        interval elapsed;    ///< since the mark before
        sums lower, upper;   ///< of the least and the greatest r' since then
        bool bounded = true; ///< all r' since then
    };
    std::vector<sample> marks_;
    interval elapsed_{0.0};
    sums lower_, upper_;
    bool bounded_ = true;
};

} // namespace sivid

#endif
