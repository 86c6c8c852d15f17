// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CANDIDATE_IMPL_LATE_CHANNELS_IPP
#define SIVID_DIAGNOSIS_CANDIDATE_IMPL_LATE_CHANNELS_IPP

#include <sivid/diagnosis/candidate/detail/late_channels.hpp>

#include <sivid/diagnosis/candidate/detail/hull_search.hpp>
#include <sivid/diagnosis/candidate/detail/input_slices.hpp>
#include <sivid/measurement/detail/widened_signal.hpp>
#include <sivid/model/affected_problem.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace sivid {

namespace diagnosis_detail {

/// The same signal with a larger error between two times.
inline sampled_signal widened_between(sampled_signal const& u, double from, double until,
                                      double more) {
    std::vector<double> times = u.times();
    times.push_back(from);
    times.push_back(until);
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    measurement_detail::widened_signal result(u.kind());
    for (double const t : times) {
        auto const k = u.piece(t);
        // A held piece has its error up to the next time.
        bool const here =
            t >= from && (t < until || (t == until && u.kind() != interpolation::hold));
        result.add(t, u.value<interval>(k, interval(t)), u.error_bound(k, t) + (here ? more : 0));
    }
    return std::move(result).take();
}

/// The clock of a motion that begins late: see `with_late_channels`.
struct late_clock {
    double stands, runs; ///< until the first of these times it stands, from the second on it runs
    sampled_signal rate, slope;
    sampled_signal time, time_slope; ///< what it shows: lines between knots

    late_clock(double begin, interval const& delays) {
        double const unit = 4 * std::numeric_limits<double>::epsilon();
        // Before the shortest latency has passed, whatever the rounding: what is shown then is the
        // start.
        double const shortest = std::max(0.0, delays.lower());
        stands = std::max(begin, begin + shortest - unit * (std::abs(begin) + shortest));
        runs = std::max(begin + delays.upper(), stands);
        runs += unit * (std::abs(runs) + std::abs(begin) + delays.upper() + 1e-6);
        double const length = runs - stands;
        double const at = (runs - begin - mid(delays)) / length;
        // Rounding of the rate, and of the slope times a distance below the length.
        double const error =
            8 * unit * (1 + std::abs(at) + (std::abs(runs) + std::abs(begin)) / length);
        std::vector<double> times, rates, slopes, errors;
        auto const from = [&](double t, double r, double s, double e) {
            times.push_back(t);
            rates.push_back(r);
            slopes.push_back(s);
            errors.push_back(e);
        };
        if (stands > begin) from(begin, 0, 0, 0);
        from(stands, at, -1 / length, error);
        from(runs, 1, 0, 0);
        rate = sampled_signal(times, std::move(rates), interpolation::hold, std::move(errors));
        slope = sampled_signal(std::move(times), std::move(slopes), interpolation::hold);

        // It stands at the begin, and then shows t - tau, after one line from there to there.
        double const after = runs + std::max(1.0, length);
        double const off = error * (length + 1) + 8 * unit * (std::abs(after) + std::abs(begin));
        times = {stands, runs, after};
        std::vector<double> shown{begin, runs - mid(delays), after - mid(delays)};
        slopes = {0, -1, -1};
        if (stands > begin) {
            times.insert(times.begin(), begin);
            shown.insert(shown.begin(), begin);
            slopes.insert(slopes.begin(), 0);
        }
        errors.assign(times.size(), off);
        time = sampled_signal(times, std::move(shown), interpolation::linear, std::move(errors));
        time_slope = sampled_signal(std::move(times), std::move(slopes), interpolation::linear);
    }
};

} // namespace diagnosis_detail

SIVID_DECL identification_problem with_late_channels(identification_problem const& base,
                                                     effect const& sensor,
                                                     std::vector<bool> const& late,
                                                     interval const& delays,
                                                     std::vector<switch_times> const& when) {
    auto const constant = [](double c) {
        return analytic_signal::from([c](auto const&) { return c; });
    };
    std::vector<effect> with_clock{sensor};
    auto& e = with_clock[0];
    e.only_in.clear(); // that is told by which parts there are
    auto const parameter = e.name + "." + e.parameters[0].name;
    auto const clock = e.name + "_clock", clock_slope = e.name + "_clock_slope";
    auto const slope_of = [name = e.name](std::string const& input) {
        return name + "_slope_" + input;
    };
    std::vector<std::size_t> recorded; // the others are switches
    std::vector<std::string> inputs, everywhere;
    for (std::size_t i = 0; i < base.model.about.inputs.size(); ++i) {
        auto const is = [i](experiment const& x) {
            return std::holds_alternative<sampled_signal>(x.inputs[i]);
        };
        if (std::none_of(base.experiments.begin(), base.experiments.end(), is)) continue;
        if (counts_readings(base.model.about.inputs[i].name)) continue; // at their own times
        recorded.push_back(i);
        inputs.push_back(base.model.about.inputs[i].name);
    }
    for (auto const& x : base.experiments) everywhere.push_back(x.name);
    e.on_channels = nullptr;
    bool const timed = std::any_of(base.model.rate.begin(), base.model.rate.end(), [&](node_id n) {
        return (base.model.g.depends(n) & on_time) != 0;
    });
    auto const shown = e.name + "_time", shown_slope = e.name + "_time_slope";
    e.on_inputs = [inputs, slope_of, timed, shown, shown_slope](effect_scope& h) {
        for (auto const& u : inputs) h.input(u) += h.input(slope_of(u)) * h.parameter();
        if (timed) h.time() = h.input(shown) + h.input(shown_slope) * h.parameter();
    };
    e.on_rates = [states = base.model.about.states, clock, clock_slope](effect_scope& h) {
        auto const rate = h.input(clock) + h.input(clock_slope) * h.parameter();
        for (auto const& s : states) h.rate(s.name) = rate * h.rate(s.name);
    };
    // Effects that change nothing, for the sake of their inputs.
    std::vector<std::string> own{clock, clock_slope};
    for (auto const& u : inputs) own.push_back(slope_of(u));
    if (timed) own.insert(own.end(), {shown, shown_slope});
    for (auto const& name : own) {
        auto& helper = with_clock.emplace_back();
        helper.name = name;
        helper.only_in = everywhere;
    }
    auto problem = affected(base, with_clock);
    auto const place = [&](std::string const& name) {
        return index_of(problem.model.about.inputs, name, "input");
    };
    std::vector<experiment> parts;
    for (std::size_t s = 0; s < problem.experiments.size(); ++s) {
        auto const& x = problem.experiments[s];
        auto in_time = x, behind = x;
        bool const acts = sensor.acts_in(x.name);
        auto const at = [&](double t) {
            return when.empty() ? switch_values{!acts, acts}
                                : switch_at(x.begin, x.end(), when[s], t);
        };
        std::erase_if(in_time.measurements,
                      [&](auto const& m) { return late[m.channel] && at(m.time).on; });
        for (auto const& name : own) in_time.inputs[place(name)] = constant(name == clock ? 1 : 0);
        if (timed) {
            in_time.inputs[place(shown)] = analytic_signal::from([](auto const& t) { return t; });
        }
        diagnosis_detail::late_clock const time(x.begin, delays);
        std::erase_if(behind.measurements, [&](auto const& m) {
            return !late[m.channel] || at(m.time).off ||
                   (m.time > time.stands && m.time < time.runs);
        });
        behind.name += "_late";
        behind.inputs[place(clock)] = time.rate;
        behind.inputs[place(clock_slope)] = time.slope;
        if (timed) {
            behind.inputs[place(shown)] = time.time;
            behind.inputs[place(shown_slope)] = time.time_slope;
        }
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            auto const& u = std::get<sampled_signal>(x.inputs[recorded[i]]);
            auto& slope = behind.inputs[place(slope_of(inputs[i]))];
            sampled_signal middle;
            if (u.kind() == interpolation::linear) {
                auto line = late_by_parameter(u, x.begin, x.end(), delays);
                middle = std::move(line.middle);
                slope = std::move(line.slope);
            } else {
                middle = delayed_within(u, x.begin, x.end(), delays);
                slope = constant(0);
            }
            // While the clock is slow, the input is one of the first ones.
            auto const first = diagnosis_detail::seen_between(
                u, x.begin, x.begin, x.begin + 2 * (time.runs - time.stands));
            behind.inputs[recorded[i]] = diagnosis_detail::widened_between(
                middle, time.stands, time.runs, width(first.values) + 2 * first.error);
        }
        for (auto* part : {&in_time, &behind}) {
            part->outliers = std::min(part->outliers, part->measurements.size());
            if (!part->measurements.empty()) parts.push_back(std::move(*part));
        }
    }
    problem.experiments = std::move(parts);
    auto& side = problem.prior[index_of_parameter(problem, parameter)];
    side = interval_traits<interval>::sub(delays, interval(mid(delays)));
    return problem;
}

} // namespace sivid

#endif
