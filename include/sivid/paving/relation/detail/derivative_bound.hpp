// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_DETAIL_DERIVATIVE_BOUND_HPP
#define SIVID_PAVING_RELATION_DETAIL_DERIVATIVE_BOUND_HPP

#include <sivid/number/interval_traits.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sivid {

/// What marks of q tell of its rate r, \f$ q' = r \f$, as time goes on in one direction. Between
/// two marks at distance T (negative backward), with \f$ r' \in R \f$ in between,
///   \f[ r(t) = \frac{\Delta q}{T} + \frac 1 T \int (r(t) - r(s)) \, ds
///   \in \frac{\Delta q}{T} + \frac T 2 R \f]
/// at the later one: far marks tell the mean well, near ones what r has done since.
class derivative_bound {
    using traits = interval_traits<interval>;

public:
    /// r' over the next piece of time.
    void add(interval const& rate) { since_ = traits::hull(since_, rate); }
    /// q at the time that is reached.
    void mark(double t, interval const& q) {
        marks_.push_back({t, q, since_});
        since_ = traits::empty();
    }
    /// Encloses r at the last mark.
    [[nodiscard]] interval now() const {
        auto result = traits::entire();
        auto slope = traits::empty();
        auto const& last = marks_.back();
        auto const most = std::min(marks_.size() - 1, farthest);
        for (std::size_t k = 1; k <= most; ++k) {
            slope = traits::hull(slope, marks_[marks_.size() - k].slope);
            if (!is_bounded(slope)) break;
            auto const& first = marks_[marks_.size() - 1 - k];
            auto const T = traits::sub(traits::point(last.t), traits::point(first.t));
            bool undefined = false;
            auto const mean = traits::div(traits::sub(last.q, first.q), T, undefined);
            auto const bent = traits::mul(traits::mul(traits::point(0.5), T), slope);
            auto const here = traits::add(mean, bent);
            if (undefined || !is_bounded(here)) break;
            auto const both = traits::intersect(result, here);
            if (!is_empty(both)) result = both;
            if (width(here) > 4 * width(result)) break; // r does too much
        }
        return result;
    }

private:
    static constexpr std::size_t farthest = 64;
    struct sample {
        double t = 0;
        interval q, slope; ///< r' since the mark before
    };
    std::vector<sample> marks_;
    interval since_ = traits::empty();
};

} // namespace sivid

#endif
