// SPDX-License-Identifier: MIT
#ifndef SIVID_MEASUREMENT_IMPL_LIMITED_SIGNAL_IPP
#define SIVID_MEASUREMENT_IMPL_LIMITED_SIGNAL_IPP

#include <sivid/measurement/limited_signal.hpp>

#include <sivid/measurement/detail/widened_signal.hpp>
#include <sivid/number/interval_traits.hpp>
#include <sivid/number/text/nearest_text.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sivid {

namespace measurement_detail {

/// Follows the pieces of an input by straight lines, with how far any limit is from them.
class rate_limiter {
    using traits = interval_traits<interval>;

public:
    rate_limiter(interval const& limit, double begin, interval const& u)
        : limit_(limit), middle_(mid(limit)), time_(begin), value_(mid(u)) {
        spread_ = mag(traits::sub(limit, interval(middle_)));
        off_ = from_line_ = mag(traits::sub(u, interval(value_)));
    }

    struct knot {
        double time, value;
        double off;                 ///< of any limit from the value there
        double within;              ///< more than the line between the two, until the next knot
        double by_limit, by_change; ///< slope by the limit, and its change per second
        /// Of any limit from its line in the limit, at both ends of the piece that begins here.
        double from_line, from_line_at_end;
    };
    /// All but the last one.
    [[nodiscard]] std::vector<knot> const& knots() const { return knots_; }
    /// Where it stands.
    [[nodiscard]] knot last() const {
        return {time_, value_, off_, 0, by_limit_, 0, from_line_, from_line_};
    }

    /// To the end of a straight piece of the input.
    /// @param u  its value at a time of the piece
    template <class Input>
    void follow(double end, interval const& slope, Input const& u) {
        crossing_.reset();
        while (time_ < end) {
            auto const now = u(time_);
            double const here = mid(now), p = mid(slope);
            double const gap = here - value_;
            // Closed, but for rounding.
            if (std::abs(gap) <= 2 * rad(now) + 4 * unit * (std::abs(here) + std::abs(value_))) {
                double const closed = distance(interval(here), interval(value_));
                off_ = sum(off_, closed);
                from_line_ = sum(from_line_, closed);
                if (crossing_) crossing_->from_line = sum(crossing_->from_line, closed);
                value_ = here;
                if (std::abs(p) <= middle_) {
                    keep_up(end, slope, u);
                } else {
                    double const way = std::copysign(1.0, p);
                    // Another limit would have met u at another time, from where it falls behind.
                    by_limit_ *= (p - way * middle_) / (p - came_by_ * middle_);
                    go_as_fast_as_possible(end, way, false, p, u);
                }
                continue;
            }
            double const way = std::copysign(1.0, gap);
            double const closing = middle_ - way * p; // how fast the gap closes
            double met = closing > 0 ? time_ + std::abs(gap) / closing : HUGE_VAL;
            met = std::max(met, std::nextafter(time_, HUGE_VAL));
            go_as_fast_as_possible(std::min(met, end), way, met <= end, p, u);
        }
    }

private:
    [[nodiscard]] static double distance(interval const& a, interval const& b) {
        return mag(traits::sub(a, b));
    }
    [[nodiscard]] static double sum(double a, double b) {
        return traits::upper(traits::add(interval(a), interval(b)), 0);
    }
    [[nodiscard]] static double product(double a, double b) {
        return traits::upper(traits::mul(interval(a), interval(b)), 0);
    }
    void stand(double within, double change, double from_line, double from_line_at_end) {
        knots_.push_back(
            {time_, value_, off_, within, by_limit_, change, from_line, from_line_at_end});
    }
    /// It is u. So are limits that have caught up; others come nearer by what they are faster.
    template <class Input>
    void keep_up(double end, interval const& slope, Input const& u) {
        by_limit_ = 0;
        auto const gains = traits::sub(interval(limit_.lower()), interval(mag(slope)));
        double const caught_up = time_ + off_ / gains.lower() * (1 + 1e-12);
        if (gains.lower() > 0 && caught_up > time_ && caught_up < end) go_with(caught_up, gains, u);
        go_with(end, gains, u);
    }
    template <class Input>
    void go_with(double end, interval const& gains, Input const& u) {
        auto const there = u(end);
        double const value = mid(there);
        double const rounding =
            std::max(distance(u(time_), interval(value_)), distance(there, interval(value)));
        off_ = sum(off_, rounding); // from u
        auto const begin_off = off_;
        stand(rounding, 0, 0, 0);
        auto const passed = traits::sub(interval(end), interval(time_));
        auto const left = traits::sub(interval(off_), traits::mul(gains, passed));
        off_ = sum(std::max(0.0, left.upper()), rounding);
        knots_.back().from_line = begin_off;
        from_line_ = knots_.back().from_line_at_end = off_;
        time_ = end;
        value_ = value;
    }
    /// What a limit may be from the line in the limit: what it is off, and that line itself.
    [[nodiscard]] double with_line(double off, double slope) const {
        return (off + std::abs(slope) * spread_) * safe;
    }
    struct turn_times {
        double sooner, soon, late, later;
    };
    /// Shortly before and after the gap has become as large as what any limit is off.
    /// @param clear, clear_at_end  the difference of both at the ends
    [[nodiscard]] static turn_times around_turn(double begin, double end, double clear,
                                                double clear_at_end) {
        double const turn = clear / (clear - clear_at_end); // share of the way
        double const soon = begin + (end - begin) * (turn * (1 - 1e-6));
        double const late = begin + (end - begin) * (turn + (1 - turn) * 1e-6);
        return {soon - std::min(0.05 * (end - soon), 0.5 * (soon - begin)), soon, late,
                late + std::min(0.05 * (late - begin), 0.5 * (end - late))};
    }
    /// To a time on the way, at full speed.
    void go_on(double t, double way) {
        by_limit_ += way * (t - time_);
        off_ = sum(off_, product(spread_, t - time_));
        value_ += way * middle_ * (t - time_);
        time_ = t;
    }
    /// It goes towards u by its limit, and meets it at the end or does not.
    ///   Where the gap is larger than any limit is off, all limits go the same way: what they are
    /// from their line stays as it is. Elsewhere it is what they are off and the line itself.
    template <class Input>
    void go_as_fast_as_possible(double end, double way, bool meets, double p, Input const& u) {
        auto const passed = traits::sub(interval(end), interval(time_));
        auto const reached =
            traits::add(interval(value_), traits::mul(interval(way * middle_), passed));
        auto const there = u(end);
        double const value = meets ? mid(there) : mid(reached);
        // What it may have passed u by before the end: from there on it is no farther than that.
        auto const beyond = traits::mul(interval(way), traits::sub(reached, there));
        double const passed_by = 2 * std::max(0.0, beyond.upper());
        double const rounding = sum(distance(reached, interval(value)), passed_by);
        double const off = sum(sum(off_, product(spread_, passed.upper())), rounding);
        double const slope = by_limit_ + way * mid(passed);
        double const blurred = with_line(off, std::max(std::abs(by_limit_), std::abs(slope)));
        double const slack = sum(rounding, 64 * unit * (std::abs(slope) + std::abs(end)) * spread_);
        // How far the gap is from what any limit is off: a line.
        double const tight = 16 * unit * (std::abs(value_) + std::abs(value));
        double const gap = way * (mid(u(time_)) - value_);
        double const left = meets ? 0 : way * (mid(there) - value);
        double const clear = gap - off_ - tight, clear_at_end = left - off - tight;
        double const begin = time_;
        auto const [sooner, soon, late, later] = around_turn(begin, end, clear, clear_at_end);
        // Of the values in between, which are sums of what is on the way.
        double const ulps =
            4 * unit * (std::abs(value_) + std::abs(value) + middle_ * passed.upper());
        auto const piece = [&](double until, double from, double to) {
            stand(sum(rounding, ulps), way, from, to);
            if (until < end) go_on(until, way);
        };
        from_line_ = sum(from_line_, slack);
        if (spread_ == 0) { // there is but one limit
            piece(end, off, off);
        } else if (clear > 0 && clear_at_end > 0) {
            piece(end, from_line_, from_line_);
        } else if (clear > 0 && begin < sooner && sooner < soon && soon < end) {
            piece(sooner, from_line_, from_line_);
            piece(soon, from_line_, blurred);
            if (meets)
                crossing_ = {by_limit_, gap + (left - gap) * (soon - begin) / (end - begin),
                             from_line_, way};
            piece(end, blurred, blurred);
        } else if (clear_at_end > 0 && begin < late && late < later && later < end) {
            double const since = late - begin;
            double const behind =
                after_crossing(way, p, off)
                    .value_or(with_line(off_ + spread_ * since, by_limit_ + way * since));
            from_line_ = std::min(sum(behind, slack), blurred);
            piece(late, blurred, blurred);
            piece(later, blurred, from_line_);
            piece(end, from_line_, from_line_);
        } else {
            piece(end, blurred, blurred);
        }
        from_line_ = knots_.back().from_line_at_end;
        by_limit_ = slope;
        off_ = off;
        came_by_ = way;
        time_ = end;
        value_ = value;
    }
    /// What limits are from their line once all of them have crossed a straight piece of u that is
    /// too fast for them. With the gap g and the slope s by the limit before, and v = R + |p|,
    ///     \f$ y_R - y = s d - d t + 2 (f(d) - f(0)), \quad f(d) = (R + d)(g - s d)/(v + d), \f$
    /// whose part beyond the line in d is \f$ -2 d^2 (s + f'(0))/(v + d) \f$.
    [[nodiscard]] std::optional<double> after_crossing(double way, double p, double off) const {
        if (!crossing_ || crossing_->way != -way || !(std::abs(p) > limit_.upper() * safe))
            return {};
        auto const& c = *crossing_;
        double const v = middle_ + std::abs(p), g = std::abs(c.gap), s = std::abs(c.slope);
        double const change = (g + s * middle_) / v + middle_ * g / (v * v);
        double const bent = 2 * spread_ * spread_ * (s + change) / (v - spread_);
        return (c.from_line + bent) * safe + 1e-9 * off;
    }

    static constexpr double safe = 1 + 1e-9; ///< for roundings of a few operations
    struct crossing {
        double slope, gap, from_line, way;
    };
    static constexpr double unit = std::numeric_limits<double>::epsilon();
    interval limit_;
    double middle_, spread_ = 0, time_, value_, off_ = 0, by_limit_ = 0;
    double came_by_ = 0;               ///< which way it went last
    double from_line_ = 0;             ///< of any limit from its line in the limit
    std::optional<crossing> crossing_; ///< about to begin, on this piece of the input
    std::vector<knot> knots_;
};

/// A limiter that has followed the whole input, and errors of that so far, by knot and at the end.
struct followed_input {
    rate_limiter limiter;
    std::vector<double> worst{};

    followed_input(sampled_signal const& u, double begin, double end, interval const& limit)
        : limiter(limit, begin, u.value<interval>(u.piece(begin), interval(begin))) {
        auto const grid = grid_of(u.times(), begin, end);
        double so_far = 0;
        for (std::size_t k = 0; k + 1 < grid.size(); ++k) {
            auto const piece = u.piece(grid[k]);
            so_far = std::max(
                {so_far, u.error_bound(piece, grid[k]), u.error_bound(piece, grid[k + 1])});
            limiter.follow(grid[k + 1], u.slope<interval>(piece),
                           [&](double t) { return u.value<interval>(piece, interval(t)); });
            worst.resize(limiter.knots().size(), so_far);
        }
        worst.push_back(std::max(so_far, u.error_bound(u.piece(grid.back()), grid.back())));
    }
    /// The lines between its knots, with these errors at the begin and the end of each piece.
    template <class Begin, class End>
    [[nodiscard]] sampled_signal lines(Begin const& at_begin, End const& at_end) const {
        widened_signal result(interpolation::linear);
        double before = 0; // what the piece before has at its end
        for (std::size_t k = 0; k < worst.size(); ++k) {
            bool const last = k + 1 == worst.size();
            auto const knot = last ? limiter.last() : limiter.knots()[k];
            double const more = knot.within + worst[k];
            result.add(knot.time, interval(knot.value), std::max(before, more + at_begin(knot)));
            if (!last) before = more + at_end(k);
        }
        return std::move(result).take();
    }
};

} // namespace measurement_detail

SIVID_DECL limited_signal rate_limited(sampled_signal const& u, double begin, double end,
                                       interval const& limit) {
    if (!(limit.lower() > 0))
        throw std::invalid_argument("rate_limited: the limit of a rate is above 0, not from " +
                                    nearest_text(limit.lower()) + " on");
    measurement_detail::followed_input const y(u, begin, end, limit);
    auto const& knots = y.limiter.knots();
    limited_signal result;
    result.within =
        y.lines([](auto const& knot) { return knot.off; },
                [&](std::size_t k) {
                    return k + 1 < knots.size() ? knots[k + 1].off : y.limiter.last().off;
                });
    for (auto const& knot : knots) {
        result.slope_by_limit.push_back(knot.by_limit);
        result.slope_change.push_back(knot.by_change);
    }
    return result;
}

SIVID_DECL limited_line rate_limited_line(sampled_signal const& u, double begin, double end,
                                          interval const& limit) {
    if (!(limit.lower() > 0))
        throw std::invalid_argument("rate_limited: the limit of a rate is above 0, not from " +
                                    nearest_text(limit.lower()) + " on");
    measurement_detail::followed_input const y(u, begin, end, limit);
    auto const& knots = y.limiter.knots();
    std::vector<double> times, slopes;
    for (std::size_t k = 0; k <= knots.size(); ++k) {
        auto const knot = k < knots.size() ? knots[k] : y.limiter.last();
        times.push_back(knot.time);
        slopes.push_back(knot.by_limit);
    }
    return {y.lines([](auto const& knot) { return knot.from_line; },
                    [&](std::size_t k) { return knots[k].from_line_at_end; }),
            sampled_signal(std::move(times), std::move(slopes), interpolation::linear)};
}

} // namespace sivid

#endif
