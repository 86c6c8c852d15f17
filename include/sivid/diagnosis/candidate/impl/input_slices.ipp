// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CANDIDATE_IMPL_INPUT_SLICES_IPP
#define SIVID_DIAGNOSIS_CANDIDATE_IMPL_INPUT_SLICES_IPP

#include <sivid/diagnosis/candidate/detail/input_slices.hpp>

#include <sivid/measurement/detail/widened_signal.hpp>
#include <sivid/number/interval_traits.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <variant>
#include <vector>

namespace sivid {

SIVID_DECL sampled_signal lagged_within(sampled_signal const& u, double begin, double end,
                                        double longest, bool rests) {
    using traits = interval_traits<interval>;
    bool const holds = u.kind() == interpolation::hold;
    std::vector<double> times = u.times();
    for (std::size_t k = 0; k < u.times().size(); ++k) {
        // Where a piece is long, the bound falls to its limit at its begin.
        double const next = k + 1 < u.times().size() ? u.times()[k + 1] : end;
        for (double const after : {1.0, 3.0, 8.0}) {
            double const t = std::max(u.times()[k], begin) + after * longest;
            if (t < next) times.push_back(t);
        }
    }
    auto const grid = measurement_detail::grid_of(std::move(times), begin, end);
    auto const value = [&](double t) { return u.value<interval>(u.piece(t), interval(t)); };

    std::vector<double> lag; // what |d - u| is at most, after a jump at a knot
    std::vector<double> error;
    double now = rests ? mag(value(begin)) : 0;
    double worst = u.error_bound(u.piece(begin), begin);
    if (rests) now += worst;
    for (std::size_t k = 0; k < grid.size(); ++k) {
        lag.push_back(now);
        if (k + 1 == grid.size()) {
            error.push_back(worst);
            break;
        }
        auto const piece = u.piece(grid[k]);
        worst = std::max({worst, u.error_bound(piece, grid[k]), u.error_bound(piece, grid[k + 1])});
        error.push_back(worst);
        bool undefined = false;
        auto const span = traits::sub(interval(grid[k + 1]), interval(grid[k]));
        auto const left = traits::intersect(
            traits::exp(traits::neg(traits::div(span, interval(longest), undefined))),
            interval(0.0, 1.0));
        auto const limit = traits::mul(interval(mag(u.slope<interval>(piece))), interval(longest));
        now = traits::add(traits::mul(interval(now), left),
                          traits::mul(limit, traits::sub(interval(1.0), left)))
                  .upper();
        if (holds) {
            auto const jump = traits::sub(value(grid[k + 1]), value(grid[k]));
            now = traits::add(interval(now), interval(mag(jump))).upper();
        }
    }
    measurement_detail::widened_signal result(u.kind());
    for (std::size_t k = 0; k < grid.size(); ++k) {
        // Between two knots of straight lines the bound is convex where it falls, and otherwise
        // at most its value at the right end.
        double const next = holds || k + 1 == grid.size() ? 0 : lag[k + 1];
        result.add(grid[k], value(grid[k]), std::max(lag[k], next) + error[k]);
    }
    return std::move(result).take();
}

namespace diagnosis_detail {

/// More than the relative error of a few roundings.
inline constexpr double rounding_unit = 4 * std::numeric_limits<double>::epsilon();

/// How far an interval reaches from its middle, as that is rounded.
inline double about_middle(interval const& x) {
    return std::max(x.upper() - mid(x), mid(x) - x.lower());
}

/// The time that is farthest from 0, of the samples or the ends.
inline double farthest_time(sampled_signal const& u, double begin, double end) {
    double farthest = std::max(std::abs(begin), std::abs(end));
    for (double const t : u.times()) farthest = std::max(farthest, std::abs(t));
    return farthest;
}

} // namespace diagnosis_detail

SIVID_DECL sampled_signal delayed_within(sampled_signal const& u, double begin, double end,
                                         interval const& delays, interval const& drifts) {
    using namespace diagnosis_detail;
    if (!(drifts.upper() < 1)) { // the clock may stand: anything that was
        auto const all = seen_between(u, begin, begin, end);
        measurement_detail::widened_signal any(interpolation::hold);
        any.add(begin, all.values, all.error);
        return std::move(any).take();
    }
    bool const holds = u.kind() == interpolation::hold;
    dead_time const middle{mid(delays), mid(drifts)};
    // Sums of times are rounded: knots lie safely beyond what is within reach.
    double const farthest = farthest_time(u, begin, end);
    double const pace = 1 - drifts.upper(); // of the slowest clock
    double const rounding =
        rounding_unit * (farthest + delays.upper()) * (drifts.upper() > 0 ? 8 / (pace * pace) : 1);
    // How far what is seen at t may be from where it is in the middle.
    auto const reach = [&](double t) {
        double const since = std::max(0.0, t - begin);
        return (about_middle(delays) + about_middle(drifts) * since) * (1 + rounding_unit) +
               rounding;
    };
    auto const source = [&](double t) {
        return t - middle.delay - middle.drift * std::max(0.0, t - begin);
    };
    std::vector<double> times;
    for (double const t : u.times()) {
        if (!holds) {
            times.push_back(middle.seen(t, begin));
            continue;
        }
        double const pad = 3 * rounding / pace;
        times.push_back(dead_time{delays.lower(), drifts.lower()}.seen(t, begin) - pad);
        times.push_back(dead_time{delays.upper(), drifts.upper()}.seen(t, begin) + pad);
    }
    if (!holds) times.push_back(middle.seen(begin, begin)); // where u(begin) is left
    auto const grid = measurement_detail::grid_of(std::move(times), begin, end);
    auto const seen = [&](double from, double until) {
        return seen_between(u, begin, source(from) - reach(from), source(until) + reach(until));
    };
    measurement_detail::widened_signal result(u.kind());
    double before = 0; // of the piece to the left
    for (std::size_t k = 0; k < grid.size(); ++k) {
        bool const last = k + 1 == grid.size();
        double const next = last ? grid[k] : grid[k + 1];
        auto const after = seen(grid[k], next);
        if (holds) {
            result.add(grid[k], after.values, after.error);
            continue;
        }
        double const error =
            (reach(std::min(next, end)) + 2 * rounding) * after.steepest * (1 + rounding_unit) +
            after.error;
        double const t = std::max(begin, source(grid[k]));
        result.add(grid[k], u.value<interval>(u.piece(t), interval(t)), std::max(before, error));
        before = error;
    }
    return std::move(result).take();
}

namespace diagnosis_detail {

/// The slopes of straight lines: where they change, and by how much, from 0 at the begin, where
/// u(begin) is left.
struct line_slopes {
    struct knot {
        double time;
        interval change;
    };
    std::vector<knot> knots;
    double steepest = 0, vague = 0; ///< the largest size of a slope, and radius of its enclosure
    /// Less the slope's middle, as it is seen `late` after the begin and the knots, held.
    sampled_signal by_delay;

    line_slopes(sampled_signal const& u, double begin, double late) {
        using traits = interval_traits<interval>;
        std::vector<double> times{begin}, slopes{0.0};
        auto const turn = [&](double at, interval const& to) {
            double const t = std::max(begin, at + late);
            steepest = std::max(steepest, mag(to));
            vague = std::max(vague, rad(to));
            if (!(t > times.back())) { // as close as rounding: the later one holds
                slopes.back() = -mid(to);
                return;
            }
            times.push_back(t);
            slopes.push_back(-mid(to));
        };
        auto slope = u.slope<interval>(u.piece(begin));
        knots.push_back({begin, slope});
        turn(begin, slope);
        for (std::size_t k = 1; k + 1 < u.times().size(); ++k) {
            if (!(u.times()[k] > begin)) continue;
            auto const next = u.slope<interval>(k);
            if (u.exact() && mag(next) == 0 && mag(slope) == 0) continue; // it stands still
            knots.push_back({u.times()[k], traits::sub(next, slope)});
            turn(u.times()[k], next);
            slope = next;
        }
        by_delay = sampled_signal(std::move(times), std::move(slopes), interpolation::hold);
    }
};

} // namespace diagnosis_detail

SIVID_DECL input_of_parameter late_by_parameter(sampled_signal const& u, double begin, double end,
                                                interval const& delays) {
    using namespace diagnosis_detail;
    using traits = interval_traits<interval>;
    double const middle = mid(delays);
    double const rounding = rounding_unit * (farthest_time(u, begin, end) + delays.upper());
    double const reach = about_middle(delays) * (1 + rounding_unit) + rounding;
    line_slopes lines(u, begin, middle);
    auto const& knots = lines.knots;

    std::vector<double> grid_times;
    for (auto const& k : knots)
        for (double const side : {-reach, 0.0, reach}) grid_times.push_back(k.time + middle + side);
    auto const grid = measurement_detail::grid_of(std::move(grid_times), begin, end);
    // The lines between these times turn there but for the rounding of the times themselves.
    double const slack = 8 * (static_cast<double>(knots.size()) + 2) * lines.steepest * rounding +
                         4 * reach * lines.vague;
    measurement_detail::widened_signal result(interpolation::linear);
    std::size_t first = 0;
    for (std::size_t n = 0; n < grid.size(); ++n) {
        auto const past = traits::sub(interval(grid[n]), interval(middle));
        double const seen = std::max(begin, mid(past));
        auto value = u.value<interval>(u.piece(seen), interval(seen));
        double error = slack;
        while (first + 1 < knots.size() && knots[first].time < grid[n] - middle - 2 * reach)
            ++first;
        for (std::size_t k = first; k < knots.size(); ++k) {
            if (knots[k].time > grid[n] - middle + 2 * reach) break;
            auto const off = traits::abs(traits::sub(past, interval(knots[k].time)));
            auto const left = traits::max(traits::sub(interval(reach), off), interval(0.0));
            auto const half = traits::mul(traits::mul(interval(0.5), knots[k].change), left);
            value = traits::add(value, half);
            error += mag(half);
        }
        if (!u.exact()) {
            double const from = n == 0 ? grid[n] : grid[n - 1];
            double const to = n + 1 == grid.size() ? grid[n] : grid[n + 1];
            error += seen_between(u, begin, from - middle - reach, to - middle + reach).error;
        }
        auto const roundings = static_cast<double>(knots.size() + 4);
        result.add(grid[n], value, error * (1 + rounding_unit * roundings));
    }
    return {std::move(result).take(), std::move(lines.by_delay), middle};
}

SIVID_DECL input_of_parameter limited_by_parameter(sampled_signal const& u, double begin,
                                                   double end, interval const& limits) {
    auto y = rate_limited_line(u, begin, end, limits);
    return {std::move(y.about), std::move(y.by_limit), mid(limits)};
}

namespace diagnosis_detail {

/// Thresholds in an interval, by its middle and half its width.
struct threshold_range {
    bool stands; ///< beyond it: saturation; else dead band
    double middle, half;

    threshold_range(bool beyond, interval const& thresholds)
        : stands(beyond),
          middle(mid(thresholds)),
          half(about_middle(thresholds) * (1 + rounding_unit)) {}

    /// Sizes at which what the input becomes bends: the ends of the interval, its middle, and 0.
    [[nodiscard]] std::array<double, 4> levels() const {
        return {middle - half, middle, middle + half, 0.0};
    }
    /// What a size becomes at the middle threshold.
    [[nodiscard]] interval behind(interval const& size) const {
        using traits = interval_traits<interval>;
        return stands ? traits::min(size, interval(middle))
                      : traits::max(traits::sub(size, interval(middle)), interval(0.0));
    }
    /// How far it bends from there about the middle: half of what is left of the half width.
    [[nodiscard]] interval bent(interval const& size) const {
        using traits = interval_traits<interval>;
        auto const left = traits::max(
            traits::sub(interval(half), traits::abs(traits::sub(size, interval(middle)))),
            interval(0.0));
        return traits::mul(interval(stands ? -0.5 : 0.5), left);
    }
};

/// The knots within [begin, end], and where the input's size passes one of the levels.
inline std::vector<double> times_at_levels(sampled_signal const& u, double begin, double end,
                                           std::array<double, 4> const& levels) {
    std::vector<double> times = u.times();
    auto const add = [&](double from, double value, double slope) {
        if (slope == 0 || u.kind() == interpolation::hold) return;
        for (double const level : levels)
            for (double const sign : {1.0, -1.0})
                times.push_back(from + (sign * level - value) / slope);
    };
    auto const slope = [&](double t) { return mid(u.slope<interval>(u.piece(t))); };
    for (std::size_t k = 0; k < u.times().size(); ++k)
        add(u.times()[k], u.values()[k], slope(u.times()[k]));
    add(begin, u.approximate(begin), slope(begin)); // straight lines go on to the left, too
    std::erase_if(times, [&](double t) { return !(t >= begin && t <= end); });
    return measurement_detail::grid_of(std::move(times), begin, end);
}

/// By how much the input moves at most where the times at which levels are passed are rounded.
inline double slack_at_levels(sampled_signal const& u, double begin, double end,
                              threshold_range const& threshold) {
    double largest = std::max(std::abs(u.approximate(begin)), std::abs(u.approximate(end)));
    double steepest = 0;
    for (std::size_t k = 0; k < u.times().size(); ++k) {
        largest = std::max(largest, std::abs(u.values()[k]));
        double const slope = mid(u.slope<interval>(u.piece(u.times()[k])));
        steepest = std::max(steepest, std::abs(slope));
    }
    return 16 * rounding_unit *
           (largest + threshold.middle + threshold.half + steepest * farthest_time(u, begin, end));
}

} // namespace diagnosis_detail

SIVID_DECL input_of_parameter threshold_by_parameter(sampled_signal const& u, double begin,
                                                     double end, bool stands,
                                                     interval const& thresholds) {
    using namespace diagnosis_detail;
    using traits = interval_traits<interval>;
    bool const holds = u.kind() == interpolation::hold;
    threshold_range const threshold(stands, thresholds);
    auto const grid = times_at_levels(u, begin, end, threshold.levels());
    double const slack = slack_at_levels(u, begin, end, threshold);
    measurement_detail::widened_signal values(u.kind());
    std::vector<double> slope_times, slopes;
    for (std::size_t n = 0; n < grid.size(); ++n) {
        auto const piece = u.piece(grid[n]);
        auto const size = traits::abs(u.value<interval>(piece, interval(grid[n])));
        // On which side the input is, on the way to the next time.
        bool const last = n + 1 == grid.size();
        double const soon = holds || last ? grid[n] : grid[n] + 0.5 * (grid[n + 1] - grid[n]);
        double const typical = mid(u.value<interval>(piece, interval(soon)));
        double const sign = typical < 0 ? -1 : 1;
        bool const beyond = std::abs(typical) >= threshold.middle;
        auto const signed_size = [&](interval const& x) { return traits::mul(interval(sign), x); };
        auto const bent = threshold.bent(size);
        auto const value = traits::add(signed_size(threshold.behind(size)), signed_size(bent));
        double const from = n == 0 ? grid[n] : grid[n - 1], to = last ? grid[n] : grid[n + 1];
        double const own = std::max({u.error_bound(u.piece(from), from),
                                     u.error_bound(piece, grid[n]), u.error_bound(piece, to)});
        values.add(grid[n], value, mag(bent) + own + slack);
        double const slope = beyond ? (stands ? sign : -sign) : 0;
        if (!slopes.empty() && slopes.back() == slope) continue;
        slope_times.push_back(grid[n]);
        slopes.push_back(slope);
    }
    return {std::move(values).take(),
            sampled_signal(std::move(slope_times), std::move(slopes), interpolation::hold),
            threshold.middle};
}

namespace diagnosis_detail {
/// From one time to the next at which what is known of a switch changes: it may be off, on, or
/// either. The last one is the end itself.
struct switch_piece {
    double from, to;
    bool may_be_off, may_be_on;
};
inline std::vector<switch_piece> switch_pieces(double begin, double end, switch_times const& t) {
    std::vector<double> knots{begin, end};
    for (double const at : {t.on.lower(), t.on.upper(), t.off.lower(), t.off.upper()})
        if (begin < at && at < end) knots.push_back(at);
    std::sort(knots.begin(), knots.end());
    knots.erase(std::unique(knots.begin(), knots.end()), knots.end());
    knots.push_back(end);
    std::vector<switch_piece> pieces;
    for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
        double const from = knots[k], to = knots[k + 1];
        bool const off = t.on.upper() >= to || t.off.lower() <= from;
        bool const on = t.on.lower() <= from && t.off.upper() >= to;
        pieces.push_back({from, to, off || !on, on});
    }
    return pieces;
}
} // namespace diagnosis_detail

SIVID_DECL sampled_signal remembered_within(experiment const& x, signal_memory const& m,
                                            interval const& sizes) {
    auto const& u = std::get<sampled_signal>(x.inputs[m.index]);
    if (m.kind == memory_kind::delay) return delayed_within(u, x.begin, x.end(), sizes);
    if (m.kind == memory_kind::drift)
        return delayed_within(u, x.begin, x.end(), interval(0.0), sizes);
    return resolved_input(u, m.kind, x, sizes);
}

SIVID_DECL switch_values switch_at(double begin, double end, switch_times const& times, double t) {
    auto const pieces = diagnosis_detail::switch_pieces(begin, end, times);
    auto at = pieces.begin();
    while (at + 1 != pieces.end() && !(t < at->to)) ++at;
    return {at->may_be_off, at->may_be_on};
}

SIVID_DECL sampled_signal switched_within(double begin, double end, switch_times const& times) {
    std::vector<double> at, values, errors;
    for (auto const& p : diagnosis_detail::switch_pieces(begin, end, times)) {
        bool const open = p.may_be_off && p.may_be_on;
        double const value = open ? 0.5 : p.may_be_on ? 1 : 0, error = open ? 0.5 : 0;
        if (!values.empty() && values.back() == value) continue;
        at.push_back(p.from);
        values.push_back(value);
        errors.push_back(error);
    }
    return {std::move(at), std::move(values), interpolation::hold, std::move(errors)};
}

SIVID_DECL double open_time(double begin, double end, switch_times const& times) {
    double sum = 0;
    for (auto const& p : diagnosis_detail::switch_pieces(begin, end, times))
        if (p.may_be_off && p.may_be_on) sum += p.to - p.from;
    return sum;
}

} // namespace sivid

#endif
