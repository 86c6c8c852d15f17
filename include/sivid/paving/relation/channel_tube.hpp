// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_CHANNEL_TUBE_HPP
#define SIVID_PAVING_RELATION_CHANNEL_TUBE_HPP

#include <sivid/number/interval_traits.hpp>
#include <sivid/number/text/nearest_text.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sivid {

/// A declared bound on how a quantity moves between its samples: over any time of length `period`,
/// its rate of change varies by at most `variation` (the difference of any two values of the rate).
///   Unlike a bound on the second derivative it allows jumps of the rate: an actuator that
///   switches, a gust, dry friction at rest.
struct rate_variation {
    double period = 0;    ///< [time]
    double variation = 0; ///< in the quantity's unit per time
};

/// Where a quantity lies at all times, from bounds at some times and a declared rate variation.
///   Between samples \f$ t_k, t_{k+1} \f$ at distance h, with
///   \f$ s = (t - t_k)/h \f$: the quantity departs from the chord of its values at the samples by
///   at most \f$ J h s (1 - s) \f$, J being what its rate can vary by within h (worst case: two
///   slopes, as far apart as they may be, that meet at t). Where the rate has a rate of its own in
///   R, it departs by \f$ -R h^2 s (1 - s) / 2 \f$. The chord lies between the chords of the
///   bounds.
class channel_tube {
public:
    using traits = interval_traits<interval>;

    /// @given  as many bounds as times, at least one; times increase strictly (checked)
    /// @param variations  what the rate varies by in each gap; may be infinite
    /// @param curvatures  where the rate of the rate lies in each gap; or none
    [[nodiscard]] static channel_tube of_gaps(std::vector<double> times,
                                              std::vector<interval> bounds,
                                              std::vector<double> const& variations,
                                              std::vector<interval> const& curvatures = {}) {
        if (times.empty() || times.size() != bounds.size() ||
            variations.size() + 1 != times.size()) {
            throw std::invalid_argument(
                "channel_tube: needs as many bounds as times, a variation for each gap");
        }
        channel_tube result;
        for (std::size_t k = 0; k + 1 < times.size(); ++k) {
            if (!(times[k] < times[k + 1])) {
                throw std::invalid_argument("channel_tube: times must increase strictly; " +
                                            nearest_text(times[k + 1]) + " follows " +
                                            nearest_text(times[k]));
            }
            if (!(variations[k] >= 0)) {
                throw std::invalid_argument("channel_tube: the rate variation must be stated");
            }
            auto const gap = traits::point(detail::add_up(times[k + 1], -times[k]));
            double const most = std::isfinite(variations[k])
                                    ? traits::mul(gap, traits::point(variations[k])).upper()
                                    : HUGE_VAL;
            auto bend = traits::bounds(-most, most);
            if (k < curvatures.size() && is_bounded(curvatures[k])) {
                auto const half = traits::mul(traits::point(-0.5), traits::sqr(gap));
                bend = agreed(bend, traits::mul(half, curvatures[k]));
            }
            result.bend_.push_back(bend);
        }
        result.times_ = std::move(times);
        result.bounds_ = std::move(bounds);
        return result;
    }

    /// What a declared law says of each gap.
    [[nodiscard]] static std::vector<double> in_gaps(rate_variation const& law,
                                                     std::vector<double> const& times) {
        if (!(law.period > 0) || !(law.variation >= 0)) {
            throw std::invalid_argument("channel_tube: the rate variation must be stated");
        }
        std::vector<double> result;
        for (std::size_t k = 0; k + 1 < times.size(); ++k) {
            // The least number of periods that cover the gap, which may exceed it by rounding only.
            double const gap = detail::add_up(times[k + 1], -times[k]);
            double const periods = std::max(1.0, std::ceil(gap / law.period * (1 - 1e-9)));
            result.push_back(
                traits::mul(traits::point(periods),
                            traits::mul(traits::point(law.variation), traits::point(1 + 1e-8)))
                    .upper());
        }
        return result;
    }

    [[nodiscard]] std::vector<double> const& times() const { return times_; }
    /// The bound at sample k.
    [[nodiscard]] interval const& bound(std::size_t k) const { return bounds_[k]; }
    /// What it departs by from the chord in gap k, times s (1 - s).
    [[nodiscard]] interval const& departure(std::size_t k) const { return bend_[k]; }
    [[nodiscard]] bool covers(double from, double to) const {
        return times_.front() <= from && to <= times_.back();
    }

    /// Encloses the quantity at all times in [from, to].
    /// @given  `covers(from, to)` (checked)
    [[nodiscard]] interval over(double from, double to) const {
        if (!(from <= to) || !covers(from, to)) {
            throw std::invalid_argument("channel_tube: no samples from " + nearest_text(from) +
                                        " to " + nearest_text(to));
        }
        auto k = gap_at(from);
        if (from == to && times_[k] == from) return bounds_[k];
        auto result = traits::empty();
        for (; k + 1 < times_.size() && (times_[k] < to || sivid::is_empty(result)); ++k) {
            result = traits::hull(
                result, in_gap(k, std::max(from, times_[k]), std::min(to, times_[k + 1])));
        }
        return sivid::is_empty(result) ? bounds_.back() : result;
    }

    /// What is open, over a time within one gap, beside the straight line from `start` at `from` to
    /// `end` at `to`: the chord's part, and an upper bound of the mean departure from the chord,
    /// \f$ J h \, \overline{s (1 - s)} \f$.
    /// @given  no sample strictly between `from` and `to` (checked)
    [[nodiscard]] std::pair<interval, double> beside_line(double from, double to, double start,
                                                          double end) const {
        auto const k = gap_at(from);
        if (!(from < to) || !covers(from, to) || times_[k + 1] < to) {
            throw std::invalid_argument("channel_tube: from " + nearest_text(from) + " to " +
                                        nearest_text(to) + " is not within one gap");
        }
        bool undefined = false;
        auto const s0 = place(k, from);
        auto const s1 = place(k, to);
        auto const first = traits::mul(traits::point(0.5), traits::add(s0, s1));
        auto const squares =
            traits::add(traits::add(traits::sqr(s0), traits::mul(s0, s1)), traits::sqr(s1));
        auto const mean = traits::sub(first, traits::div(squares, traits::point(3.0), undefined));
        auto const beside = traits::hull(traits::sub(chord(k, s0), traits::point(start)),
                                         traits::sub(chord(k, s1), traits::point(end)));
        if (!is_bounded(bend_[k])) return {beside, HUGE_VAL};
        // The middle of what it departs by has the shape s (1 - s).
        auto const middle = traits::point(mid(bend_[k]));
        auto const open = traits::point(mag(traits::sub(bend_[k], middle)));
        return {traits::add(beside, traits::mul(middle, heights(s0, s1))),
                traits::mul(open, mean).upper()};
    }

private:
    [[nodiscard]] std::size_t gap_at(double t) const {
        auto const after = std::upper_bound(times_.begin(), times_.end(), t);
        return after == times_.begin() ? 0 : static_cast<std::size_t>(after - times_.begin()) - 1;
    }
    /// (t - t_k)/h.
    [[nodiscard]] interval place(std::size_t k, double t) const {
        bool undefined = false;
        auto const h = traits::sub(traits::point(times_[k + 1]), traits::point(times_[k]));
        auto const s = traits::sub(traits::point(t), traits::point(times_[k]));
        return traits::intersect(traits::div(s, h, undefined), traits::bounds(0.0, 1.0));
    }
    [[nodiscard]] interval chord(std::size_t k, interval const& s) const {
        return traits::add(traits::mul(traits::sub(traits::point(1.0), s), bounds_[k]),
                           traits::mul(s, bounds_[k + 1]));
    }
    /// s (1 - s) between two places.
    [[nodiscard]] static interval heights(interval const& s0, interval const& s1) {
        auto const height = [](interval const& s) {
            return traits::mul(s, traits::sub(traits::point(1.0), s));
        };
        auto const ends = traits::hull(height(s0), height(s1));
        bool const top = s0.lower() <= 0.5 && 0.5 <= s1.upper();
        return traits::bounds(std::max(ends.lower(), 0.0),
                              top ? 0.25 : std::max(ends.upper(), 0.0));
    }
    [[nodiscard]] interval in_gap(std::size_t k, double from, double to) const {
        auto const s0 = place(k, from);
        auto const s1 = place(k, to);
        auto const off = is_bounded(bend_[k]) ? traits::mul(bend_[k], heights(s0, s1)) : bend_[k];
        return traits::add(traits::hull(chord(k, s0), chord(k, s1)), off);
    }

    std::vector<double> times_;
    std::vector<interval> bounds_;
    std::vector<interval> bend_; ///< of each gap: times s (1 - s), what departs from the chord
};

} // namespace sivid

#endif
