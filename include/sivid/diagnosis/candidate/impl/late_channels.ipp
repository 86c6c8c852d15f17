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

/// The inputs of a motion under a late clock: the recorded ones, which are late, and those that it
/// has besides. A slope is what the parameter, the distance from the middle delay, is times.
struct late_inputs {
    std::string sensor, clock, clock_slope;
    std::string shown, shown_slope;    ///< what the clock shows: only where the rates are `timed`
    std::vector<std::size_t> recorded; ///< the others are switches
    std::vector<std::string> names;    ///< of the recorded ones
    bool timed = false;                ///< whether the rates depend on the time

    late_inputs(identification_problem const& base, std::string const& of)
        : sensor(of),
          clock(of + "_clock"),
          clock_slope(of + "_clock_slope"),
          shown(of + "_time"),
          shown_slope(of + "_time_slope") {
        auto const& model = base.model;
        for (std::size_t i = 0; i < model.about.inputs.size(); ++i) {
            auto const is = [i](experiment const& x) {
                return std::holds_alternative<sampled_signal>(x.inputs[i]);
            };
            if (std::none_of(base.experiments.begin(), base.experiments.end(), is)) continue;
            if (counts_readings(model.about.inputs[i].name)) continue; // at their own times
            recorded.push_back(i);
            names.push_back(model.about.inputs[i].name);
        }
        timed = std::any_of(model.rate.begin(), model.rate.end(),
                            [&](node_id n) { return (model.g.depends(n) & on_time) != 0; });
    }
    [[nodiscard]] std::string slope_of(std::string const& input) const {
        return sensor + "_slope_" + input;
    }
    /// Those that the base has not.
    [[nodiscard]] std::vector<std::string> added() const {
        std::vector<std::string> all{clock, clock_slope};
        for (auto const& u : names) all.push_back(slope_of(u));
        if (timed) all.insert(all.end(), {shown, shown_slope});
        return all;
    }
};

/// The sensor as a clock that begins late, and effects that change nothing, for the sake of their
/// inputs.
inline std::vector<effect> clock_effects(identification_problem const& base, effect const& sensor,
                                         late_inputs const& own) {
    std::vector<effect> all{sensor};
    auto& e = all[0];
    e.only_in.clear(); // that is told by which parts there are
    e.on_channels = nullptr;
    e.on_inputs = [own](effect_scope& h) {
        for (auto const& u : own.names) h.input(u) += h.input(own.slope_of(u)) * h.parameter();
        if (own.timed) h.time() = h.input(own.shown) + h.input(own.shown_slope) * h.parameter();
    };
    e.on_rates = [states = base.model.about.states, own](effect_scope& h) {
        auto const rate = h.input(own.clock) + h.input(own.clock_slope) * h.parameter();
        for (auto const& s : states) h.rate(s.name) = rate * h.rate(s.name);
    };
    std::vector<std::string> everywhere;
    for (auto const& x : base.experiments) everywhere.push_back(x.name);
    for (auto const& name : own.added()) {
        auto& helper = all.emplace_back();
        helper.name = name;
        helper.only_in = everywhere;
    }
    return all;
}

inline analytic_signal constant_signal(double c) {
    return analytic_signal::from([c](auto const&) { return c; });
}

/// The inputs of an experiment whose clock is right.
inline std::vector<signal> inputs_in_time(experiment const& x, model_description const& about,
                                          late_inputs const& own) {
    auto inputs = x.inputs;
    auto const input = [&](std::string const& name) -> signal& {
        return inputs[index_of(about.inputs, name, "input")];
    };
    for (auto const& name : own.added()) input(name) = constant_signal(name == own.clock ? 1 : 0);
    if (own.timed) input(own.shown) = analytic_signal::from([](auto const& t) { return t; });
    return inputs;
}

/// The inputs of the same motion begun later, under late inputs.
inline std::vector<signal> inputs_behind(experiment const& x, model_description const& about,
                                         late_inputs const& own, late_clock const& clock,
                                         interval const& delays) {
    auto inputs = x.inputs;
    auto const input = [&](std::string const& name) -> signal& {
        return inputs[index_of(about.inputs, name, "input")];
    };
    input(own.clock) = clock.rate;
    input(own.clock_slope) = clock.slope;
    if (own.timed) {
        input(own.shown) = clock.time;
        input(own.shown_slope) = clock.time_slope;
    }
    for (std::size_t i = 0; i < own.names.size(); ++i) {
        auto const& u = std::get<sampled_signal>(x.inputs[own.recorded[i]]);
        auto& slope = input(own.slope_of(own.names[i]));
        sampled_signal middle;
        if (u.kind() == interpolation::linear) {
            auto line = late_by_parameter(u, x.begin, x.end(), delays);
            middle = std::move(line.middle);
            slope = std::move(line.slope);
        } else {
            middle = delayed_within(u, x.begin, x.end(), delays);
            slope = constant_signal(0);
        }
        // While the clock is slow, the input is one of the first ones.
        auto const first =
            seen_between(u, x.begin, x.begin, x.begin + 2 * (clock.runs - clock.stands));
        inputs[own.recorded[i]] = widened_between(middle, clock.stands, clock.runs,
                                                  width(first.values) + 2 * first.error);
    }
    return inputs;
}

} // namespace diagnosis_detail

SIVID_DECL identification_problem with_late_channels(identification_problem const& base,
                                                     effect const& sensor,
                                                     std::vector<bool> const& late,
                                                     interval const& delays,
                                                     std::vector<switch_times> const& when) {
    using namespace diagnosis_detail;
    late_inputs const own(base, sensor.name);
    auto problem = affected(base, clock_effects(base, sensor, own));
    auto const& about = problem.model.about;
    std::vector<experiment> parts;
    for (std::size_t s = 0; s < problem.experiments.size(); ++s) {
        auto const& x = problem.experiments[s];
        bool const acts = sensor.acts_in(x.name);
        auto const at = [&](double t) {
            return when.empty() ? switch_values{!acts, acts}
                                : switch_at(x.begin, x.end(), when[s], t);
        };
        auto in_time = x, behind = x;
        in_time.inputs = inputs_in_time(x, about, own);
        std::erase_if(in_time.measurements,
                      [&](auto const& m) { return late[m.channel] && at(m.time).on; });
        late_clock const clock(x.begin, delays);
        behind.name += "_late";
        behind.inputs = inputs_behind(x, about, own, clock, delays);
        std::erase_if(behind.measurements, [&](auto const& m) {
            return !late[m.channel] || at(m.time).off ||
                   (m.time > clock.stands && m.time < clock.runs);
        });
        for (auto* part : {&in_time, &behind}) {
            part->outliers = std::min(part->outliers, part->measurements.size());
            if (!part->measurements.empty()) parts.push_back(std::move(*part));
        }
    }
    problem.experiments = std::move(parts);
    auto const parameter = sensor.name + "." + sensor.parameters[0].name;
    auto& side = problem.prior[index_of_parameter(problem, parameter)];
    side = interval_traits<interval>::sub(delays, interval(mid(delays)));
    return problem;
}

} // namespace sivid

#endif
