// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CANDIDATE_IMPL_INPUT_SLICES_IPP
#define SIVID_DIAGNOSIS_CANDIDATE_IMPL_INPUT_SLICES_IPP

#include <sivid/diagnosis/candidate/detail/input_slices.hpp>

#include <sivid/measurement/detail/widened_signal.hpp>
#include <sivid/number/interval_traits.hpp>

#include <algorithm>
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

SIVID_DECL sampled_signal delayed_within(sampled_signal const& u, double begin, double end,
                                         interval const& delays, interval const& drifts) {
    if (!(drifts.upper() < 1)) { // the clock may stand: anything that was
        auto const all = diagnosis_detail::seen_between(u, begin, begin, end);
        measurement_detail::widened_signal any(interpolation::hold);
        any.add(begin, all.values, all.error);
        return std::move(any).take();
    }
    bool const holds = u.kind() == interpolation::hold;
    dead_time const middle{mid(delays), mid(drifts)};
    double farthest = std::max(std::abs(begin), std::abs(end));
    for (double const t : u.times()) farthest = std::max(farthest, std::abs(t));
    // Sums of times are rounded: knots lie safely beyond what is within reach.
    double const unit = 4 * std::numeric_limits<double>::epsilon();
    double const pace = 1 - drifts.upper(); // of the slowest clock
    double const rounding =
        unit * (farthest + delays.upper()) * (drifts.upper() > 0 ? 8 / (pace * pace) : 1);
    auto const radius = [](interval const& x) {
        return std::max(x.upper() - mid(x), mid(x) - x.lower());
    };
    // How far what is seen at t may be from where it is in the middle.
    auto const reach = [&](double t) {
        double const since = std::max(0.0, t - begin);
        return (radius(delays) + radius(drifts) * since) * (1 + unit) + rounding;
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
        return diagnosis_detail::seen_between(u, begin, source(from) - reach(from),
                                              source(until) + reach(until));
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
            (reach(std::min(next, end)) + 2 * rounding) * after.steepest * (1 + unit) + after.error;
        double const t = std::max(begin, source(grid[k]));
        result.add(grid[k], u.value<interval>(u.piece(t), interval(t)), std::max(before, error));
        before = error;
    }
    return std::move(result).take();
}

SIVID_DECL input_of_parameter late_by_parameter(sampled_signal const& u, double begin, double end,
                                                interval const& delays) {
    using traits = interval_traits<interval>;
    input_of_parameter late;
    double const middle = late.at = mid(delays);
    double farthest = std::max(std::abs(begin), std::abs(end));
    for (double const t : u.times()) farthest = std::max(farthest, std::abs(t));
    double const unit = 4 * std::numeric_limits<double>::epsilon();
    double const rounding = unit * (farthest + delays.upper()); // of a sum of times
    double const reach =
        std::max(delays.upper() - middle, middle - delays.lower()) * (1 + unit) + rounding;

    // Where the slope changes, and by how much: from 0 at the begin, where u(begin) is left.
    struct knot {
        double time;
        interval change;
    };
    auto slope = u.slope<interval>(u.piece(begin));
    std::vector<knot> knots{{begin, slope}};
    std::vector<double> times{begin}, slopes{0.0};
    double steepest = mag(slope), vague = rad(slope);
    auto const turn = [&](double at, interval const& to) {
        double const t = std::max(begin, at + middle);
        if (!(t > times.back())) { // as close as rounding: the later one holds
            slopes.back() = -mid(to);
            return;
        }
        times.push_back(t);
        slopes.push_back(-mid(to));
    };
    turn(begin, slope);
    for (std::size_t k = 1; k + 1 < u.times().size(); ++k) {
        if (!(u.times()[k] > begin)) continue;
        auto const next = u.slope<interval>(k);
        if (u.exact() && mag(next) == 0 && mag(slope) == 0) continue; // it stands still
        knots.push_back({u.times()[k], traits::sub(next, slope)});
        turn(u.times()[k], next);
        slope = next;
        steepest = std::max(steepest, mag(slope));
        vague = std::max(vague, rad(slope));
    }
    late.slope = sampled_signal(std::move(times), std::move(slopes), interpolation::hold);

    std::vector<double> grid_times;
    for (auto const& k : knots)
        for (double const side : {-reach, 0.0, reach}) grid_times.push_back(k.time + middle + side);
    auto const grid = measurement_detail::grid_of(std::move(grid_times), begin, end);
    // The lines between these times turn there but for the rounding of the times themselves.
    double const slack =
        8 * (static_cast<double>(knots.size()) + 2) * steepest * rounding + 4 * reach * vague;
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
            error +=
                diagnosis_detail::seen_between(u, begin, from - middle - reach, to - middle + reach)
                    .error;
        }
        result.add(grid[n], value, error * (1 + unit * static_cast<double>(knots.size() + 4)));
    }
    late.middle = std::move(result).take();
    return late;
}

SIVID_DECL input_of_parameter limited_by_parameter(sampled_signal const& u, double begin,
                                                   double end, interval const& limits) {
    auto y = rate_limited_line(u, begin, end, limits);
    return {std::move(y.about), std::move(y.by_limit), mid(limits)};
}

SIVID_DECL input_of_parameter threshold_by_parameter(sampled_signal const& u, double begin,
                                                     double end, bool stands,
                                                     interval const& thresholds) {
    using traits = interval_traits<interval>;
    bool const holds = u.kind() == interpolation::hold;
    input_of_parameter result;
    double const middle = result.at = mid(thresholds);
    double const unit = 4 * std::numeric_limits<double>::epsilon();
    double const half =
        std::max(thresholds.upper() - middle, middle - thresholds.lower()) * (1 + unit);
    double farthest = std::max(std::abs(begin), std::abs(end));
    for (double const t : u.times()) farthest = std::max(farthest, std::abs(t));

    // The knots, and where the input's size passes the ends of the interval, its middle, and 0.
    std::vector<double> times = u.times();
    double largest = 0, steepest = 0;
    auto const at = [&](double t) { return u.approximate(t); };
    for (std::size_t k = 0; k < u.times().size(); ++k) {
        largest = std::max(largest, std::abs(u.values()[k]));
        double const s = mid(u.slope<interval>(u.piece(u.times()[k])));
        steepest = std::max(steepest, std::abs(s));
        if (holds || s == 0) continue;
        for (double const level : {middle - half, middle, middle + half, 0.0})
            for (double const sign : {1.0, -1.0})
                times.push_back(u.times()[k] + (sign * level - u.values()[k]) / s);
    }
    auto const before = u.piece(begin); // straight lines go on to the left, too
    if (!holds) {
        double const s = mid(u.slope<interval>(before));
        for (double const level : {middle - half, middle, middle + half, 0.0})
            for (double const sign : {1.0, -1.0})
                if (s != 0) times.push_back(begin + (sign * level - at(begin)) / s);
    }
    std::erase_if(times, [&](double t) { return !(t >= begin && t <= end); });
    auto const grid = measurement_detail::grid_of(std::move(times), begin, end);
    largest = std::max({largest, std::abs(at(begin)), std::abs(at(end))});
    // The times at which levels are passed are rounded, which moves the input by so much at most.
    double const slack = 16 * unit * (largest + middle + half + steepest * farthest);

    measurement_detail::widened_signal values(u.kind());
    std::vector<double> slope_times, slopes;
    for (std::size_t n = 0; n < grid.size(); ++n) {
        auto const piece = u.piece(grid[n]);
        auto const recorded = u.value<interval>(piece, interval(grid[n]));
        auto const size = traits::abs(recorded);
        // On which side the input is, on the way to the next time.
        bool const last = n + 1 == grid.size();
        double const soon = holds || last ? grid[n] : grid[n] + 0.5 * (grid[n + 1] - grid[n]);
        double const typical = mid(u.value<interval>(piece, interval(soon)));
        double const sign = typical < 0 ? -1 : 1;
        bool const beyond = std::abs(typical) >= middle;
        auto const signed_size = [&](interval const& x) { return traits::mul(interval(sign), x); };
        auto value =
            stands ? signed_size(traits::min(size, interval(middle)))
                   : signed_size(traits::max(traits::sub(size, interval(middle)), interval(0.0)));
        auto const left = traits::max(
            traits::sub(interval(half), traits::abs(traits::sub(size, interval(middle)))),
            interval(0.0));
        auto const bent = traits::mul(interval(stands ? -0.5 : 0.5), left);
        value = traits::add(value, signed_size(bent));
        double const from = n == 0 ? grid[n] : grid[n - 1], to = last ? grid[n] : grid[n + 1];
        double const own = std::max({u.error_bound(u.piece(from), from),
                                     u.error_bound(piece, grid[n]), u.error_bound(piece, to)});
        values.add(grid[n], value, mag(bent) + own + slack);
        double const slope = beyond ? (stands ? sign : -sign) : 0;
        if (!slopes.empty() && slopes.back() == slope) continue;
        slope_times.push_back(grid[n]);
        slopes.push_back(slope);
    }
    result.middle = std::move(values).take();
    result.slope = sampled_signal(std::move(slope_times), std::move(slopes), interpolation::hold);
    return result;
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
