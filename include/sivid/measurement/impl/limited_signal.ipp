// SPDX-License-Identifier: MIT
#ifndef SIVID_MEASUREMENT_IMPL_LIMITED_SIGNAL_IPP
#define SIVID_MEASUREMENT_IMPL_LIMITED_SIGNAL_IPP

#include <sivid/measurement/limited_signal.hpp>

#include <sivid/measurement/detail/widened_signal.hpp>
#include <sivid/number/interval_traits.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
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
        off_ = mag(traits::sub(u, interval(value_)));
    }

    struct knot {
        double time, value;
        double off;                 ///< of any limit from the value there
        double within;              ///< more than the line between the two, until the next knot
        double by_limit, by_change; ///< slope by the limit, and its change per second
    };
    /// All but the last one.
    [[nodiscard]] std::vector<knot> const& knots() const { return knots_; }
    /// Where it stands.
    [[nodiscard]] knot last() const { return {time_, value_, off_, 0, by_limit_, 0}; }

    /// To the end of a straight piece of the input.
    /// @param u  its value at a time of the piece
    template <class Input>
    void follow(double end, interval const& slope, Input const& u) {
        while (time_ < end) {
            auto const now = u(time_);
            double const here = mid(now), p = mid(slope);
            double const gap = here - value_;
            // Closed, but for rounding.
            if (std::abs(gap) <= 2 * rad(now) + 4 * unit * (std::abs(here) + std::abs(value_))) {
                off_ = sum(off_, distance(interval(here), interval(value_)));
                value_ = here;
                if (std::abs(p) <= middle_) {
                    keep_up(end, slope, u);
                } else {
                    double const way = std::copysign(1.0, p);
                    // Another limit would have met u at another time, from where it falls behind.
                    by_limit_ *= (p - way * middle_) / (p - came_by_ * middle_);
                    go_as_fast_as_possible(end, way, false, u);
                }
                continue;
            }
            double const way = std::copysign(1.0, gap);
            double const closing = middle_ - way * p; // how fast the gap closes
            double met = closing > 0 ? time_ + std::abs(gap) / closing : HUGE_VAL;
            met = std::max(met, std::nextafter(time_, HUGE_VAL));
            go_as_fast_as_possible(std::min(met, end), way, met <= end, u);
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
    void stand(double within, double change) {
        knots_.push_back({time_, value_, off_, within, by_limit_, change});
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
        stand(rounding, 0);
        auto const passed = traits::sub(interval(end), interval(time_));
        auto const left = traits::sub(interval(off_), traits::mul(gains, passed));
        off_ = sum(std::max(0.0, left.upper()), rounding);
        time_ = end;
        value_ = value;
    }
    /// It goes towards u by its limit, and meets it at the end or does not.
    template <class Input>
    void go_as_fast_as_possible(double end, double way, bool meets, Input const& u) {
        auto const passed = traits::sub(interval(end), interval(time_));
        auto const reached =
            traits::add(interval(value_), traits::mul(interval(way * middle_), passed));
        auto const there = u(end);
        double const value = meets ? mid(there) : mid(reached);
        // What it may have passed u by before the end: from there on it is no farther than that.
        auto const beyond = traits::mul(interval(way), traits::sub(reached, there));
        double const passed_by = 2 * std::max(0.0, beyond.upper());
        double const rounding = sum(distance(reached, interval(value)), passed_by);
        stand(rounding, way);
        off_ = sum(sum(off_, product(spread_, passed.upper())), rounding);
        by_limit_ += way * mid(passed);
        came_by_ = way;
        time_ = end;
        value_ = value;
    }

    static constexpr double unit = std::numeric_limits<double>::epsilon();
    interval limit_;
    double middle_, spread_ = 0, time_, value_, off_ = 0, by_limit_ = 0;
    double came_by_ = 0; ///< which way it went last
    std::vector<knot> knots_;
};

} // namespace measurement_detail

SIVID_DECL limited_signal rate_limited(sampled_signal const& u, double begin, double end,
                                       interval const& limit) {
    if (!(limit.lower() > 0))
        throw std::invalid_argument("rate_limited: the limit of a rate is above 0");
    auto const grid = measurement_detail::grid_of(u.times(), begin, end);
    auto const on = [&u](std::size_t piece) {
        return [&u, piece](double t) { return u.value<interval>(piece, interval(t)); };
    };
    measurement_detail::rate_limiter y(limit, begin, on(u.piece(begin))(begin));
    std::vector<double> worst; // error of the input so far, by knot
    double so_far = 0;
    for (std::size_t k = 0; k + 1 < grid.size(); ++k) {
        auto const piece = u.piece(grid[k]);
        so_far =
            std::max({so_far, u.error_bound(piece, grid[k]), u.error_bound(piece, grid[k + 1])});
        y.follow(grid[k + 1], u.slope<interval>(piece), on(piece));
        worst.resize(y.knots().size(), so_far);
    }
    limited_signal result;
    measurement_detail::widened_signal all(interpolation::linear);
    double before = 0; // what the piece before adds at its end
    auto const add = [&](auto const& knot, double error) {
        all.add(knot.time, interval(knot.value), std::max(before, knot.within + error) + knot.off);
        before = knot.within + error;
    };
    for (std::size_t k = 0; k < y.knots().size(); ++k) {
        add(y.knots()[k], worst[k]);
        result.slope_by_limit.push_back(y.knots()[k].by_limit);
        result.slope_change.push_back(y.knots()[k].by_change);
    }
    add(y.last(), std::max(so_far, u.error_bound(u.piece(grid.back()), grid.back())));
    result.within = std::move(all).take();
    return result;
}

} // namespace sivid

#endif
