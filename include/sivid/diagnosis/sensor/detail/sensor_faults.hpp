// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_SENSOR_DETAIL_SENSOR_FAULTS_HPP
#define SIVID_DIAGNOSIS_SENSOR_DETAIL_SENSOR_FAULTS_HPP

#include <sivid/model/change/detail/with_equations.hpp>
#include <sivid/model/graph/rewrite.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/model/sampling.hpp>
#include <sivid/model/unit.hpp>
#include <sivid/number/text/nearest_text.hpp>
#include <sivid/paving/relation/detail/relation_windows.hpp>
#include <sivid/paving/relation/state_samples.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// What a faulty sensor may do: the true x is
///   \f$ x(t) = (1 + s)\, y(t + \tau) + b + d\, t + \sum_m c_m y_m(t) \f$
/// of what it shows, y, and what the sensors of other states show, with unknown s, b, d, c in
/// ranges about 0 and an unknown delay \f$ \tau \f$. Cross-talk c: of channels in the same unit (an
/// instrument that is mounted askew) and of those whose unit is that by a length (a lever arm).
struct sensor_fault_ranges {
    double scale = 0.1;   ///< |s|
    double offset = 0.1;  ///< |b| and |d t|, each as a share of what its bounded readings span
    double mixing = 0.12; ///< |c| within one unit: 0.12 rad askew
    double arm = 0.03;    ///< what a lever arm adds, as a share of what its readings span
    /// Most delay, in the model's unit of time; none: two gaps between samples, or a fiftieth of a
    /// long record.
    std::optional<double> latency{};
    std::size_t most_slices = 40; ///< pieces that the delay is cut into
};

/// A sensor with the ranges of its faults, in the channel's unit.
struct faulty_channel {
    std::size_t state = 0, channel = 0;
    interval scale{0.0}, offset{0.0}, drift{0.0};
    std::vector<std::pair<std::size_t, interval>> mixing; ///< (state, share)
    double latency = 0;

    /// How many unknown numbers there are beside the delay, and the range of one of them.
    [[nodiscard]] std::size_t size() const { return 3 + mixing.size(); }
    [[nodiscard]] interval& range(std::size_t k) {
        return k == 0 ? scale : k == 1 ? offset : k == 2 ? drift : mixing[k - 3].second;
    }
};

namespace diagnosis_detail {

/// A unit in which an angle is a number.
inline unit without_angle(std::string const& text) {
    auto result = unit(text);
    for (int n = 1; n <= 4; ++n) { // rad stands in it to a small power, if at all
        auto const above = result.times(unit("rad"), -1);
        if (above.text().size() < result.text().size()) result = above;
        auto const below = result.times(unit("rad"), 1);
        if (below.text().size() < result.text().size()) result = below;
    }
    return result;
}
/// Whether it is one of a length alone.
inline bool is_length(unit const& u) {
    auto const text = u.text();
    auto const known = {"m", "um", "mm", "cm", "km"};
    return std::find(known.begin(), known.end(), text) != known.end();
}
/// What the bounded readings of a channel span.
inline interval readings_of(identification_problem const& problem, std::size_t channel) {
    auto result = interval_traits<interval>::empty();
    for (auto const& e : problem.experiments)
        for (auto const& m : e.measurements)
            if (m.channel == channel && is_bounded(m.bound)) result = hull(result, m.bound);
    return result;
}

} // namespace diagnosis_detail

/// The ranges of one sensor's faults.
/// @param channels  that show the states
[[nodiscard]] inline faulty_channel
faults_of(identification_problem const& problem,
          std::vector<std::optional<std::size_t>> const& channels, std::size_t state,
          sensor_fault_ranges const& ranges) {
    auto const& about = problem.model.about;
    auto const within = [](double most) { return interval(-most, most); };
    double const latency =
        ranges.latency ? *ranges.latency : sampling_of(problem.experiments).span(2, 0.02);
    faulty_channel result{state, *channels[state], within(ranges.scale), {}, {}, {}, latency};
    auto const span = [&](std::size_t channel) {
        auto const all = diagnosis_detail::readings_of(problem, channel);
        return is_empty(all) ? 0 : width(all);
    };
    double longest = 0, latest = 0;
    for (auto const& e : problem.experiments) {
        for (auto const& m : e.measurements) {
            if (m.channel != result.channel || !is_bounded(m.bound)) continue;
            longest = std::max(longest, m.time - e.begin);
            latest = std::max(latest, std::abs(e.begin));
        }
    }
    double const most = ranges.offset * span(result.channel);
    double const drift = longest > 0 ? most / longest : 0;
    result.drift = within(drift);
    result.offset = within(most + drift * latest); // the drift counts from the begin
    auto const own = diagnosis_detail::without_angle(about.channels[result.channel].unit);
    for (std::size_t m = 0; m < channels.size(); ++m) {
        if (!channels[m] || m == state) continue;
        auto const other = diagnosis_detail::without_angle(about.channels[*channels[m]].unit);
        if (about.channels[*channels[m]].unit == about.channels[result.channel].unit) {
            result.mixing.emplace_back(m, within(ranges.mixing));
        } else if (diagnosis_detail::is_length(own.times(other, -1)) && span(*channels[m]) > 0) {
            double const arm = ranges.arm * span(result.channel) / span(*channels[m]);
            result.mixing.emplace_back(m, within(arm));
        }
    }
    return result;
}

/// A problem about what a faulty sensor shows, re-timed for delays around one value: its model
/// takes that for the state and corrects it by unknown constants. Experiments of which no reading
/// is left after their begin are not in it: it may have none.
struct suspect_problem {
    identification_problem problem;
    suspected_sensor sensor;
};

namespace diagnosis_detail {

/// Makes the problem's model take what the sensor shows for the state: it corrects it by unknown
/// constants, which join the prior.
inline void correct_state(identification_problem& problem, identification_problem const& source,
                          faulty_channel const& f) {
    auto& model = problem.model;
    std::vector<interval> sides(source.prior.begin(), source.prior.end());
    graph g;
    auto const unknown = [&](std::string const& name, interval const& range) {
        model.about.constants.push_back({name, "1", literal{interval(0.0), 0.0}});
        problem.choice.unknown.push_back(name);
        sides.push_back(range);
        return g.leaf(operation::constant, model.about.constants.size() - 1);
    };
    auto const shown = g.leaf(operation::state, f.state);
    auto state = g.add(shown, g.mul(unknown("sensor scale", f.scale), shown));
    state = g.add(state, unknown("sensor offset", f.offset));
    state = g.add(state, g.mul(unknown("sensor drift", f.drift), g.leaf(operation::time, 0)));
    for (auto const& [m, range] : f.mixing) {
        auto const share = unknown("sensor share " + model.about.states[m].name, range);
        state = g.add(state, g.mul(share, g.leaf(operation::state, m)));
    }
    // In other channels, too: one that shows the same state is right.
    auto const corrected = [&](node const& n, graph& to) {
        auto const k = static_cast<std::size_t>(n.index);
        return n.op == operation::state && k == f.state ? state : to.leaf(n.op, k);
    };
    auto const rates = copy_into(g, model.g, model.rate, corrected);
    auto outputs = copy_into(g, model.g, model.observe, corrected);
    outputs[f.channel] = shown;
    model = with_equations(std::move(model), std::move(g), rates, outputs);
    problem.prior = box(sides.size());
    for (std::size_t j = 0; j < sides.size(); ++j) problem.prior[j] = sides[j];
}

/// What a faulty sensor shows of a state at the begin, and how its rate then varies:
///   x' = (1 + s) y' + d + sum c y_m'.
/// @param laws  of all states in this experiment; that of the sensor's own becomes that of y
inline void start_at_shown(experiment& e, faulty_channel const& f,
                           std::vector<rate_variation> const& laws, rate_variation& law) {
    using traits = interval_traits<interval>;
    double variation = law.variation;
    auto off = traits::add(f.offset, traits::mul(f.drift, traits::point(e.begin)));
    for (auto const& [m, share] : f.mixing) {
        auto const& other = laws[m];
        double const periods = std::ceil(law.period / other.period * (1 - 1e-9));
        variation += mag(share) * other.variation * std::max(1.0, periods);
        off = traits::add(off, traits::mul(share, e.initial[m]));
    }
    law.variation = std::min(variation / (1 + f.scale.lower()) * (1 + 1e-9), 1e100);
    bool undefined = false;
    e.initial[f.state] = traits::div(traits::sub(e.initial[f.state], off),
                                     traits::add(traits::point(1.0), f.scale), undefined);
}

/// The greatest rate of what samples show within some time of t: in each gap, of which the first
/// and the last one go on beyond the samples, it is off the secant by no more than it varies by
/// there.
inline double steepest_about(state_samples const& samples, rate_variation const& law, double t,
                             double near) {
    auto const& times = samples.times;
    double rate = times.size() > 1 ? 0 : HUGE_VAL;
    for (std::size_t k = 0; k + 1 < times.size(); ++k) {
        double const from = k == 0 ? std::min(times[k], t - near) : times[k];
        double const to = k + 2 == times.size() ? std::max(times[k + 1], t + near) : times[k + 1];
        if (to < t - near || from > t + near) continue;
        double const gap = times[k + 1] - times[k];
        rate = std::max(rate, mag((samples.bounds[k + 1] - samples.bounds[k]) / gap) +
                                  channel_tube::in_gaps(law, {from, to}).front());
    }
    return rate;
}

/// Moves the readings of a late channel to when they tell. What is shown at t belongs to t - delay,
/// which is rounded, and may be half away from that.
inline void move_readings(experiment& e, std::size_t channel, rate_variation const& law,
                          double delay, double half) {
    using traits = interval_traits<interval>;
    std::erase_if(e.measurements, [&](measurement const& m) { // of before the begin: tell nothing
        return m.channel == channel && m.time - delay < e.begin + half;
    });
    e.outliers = std::min(e.outliers, e.measurements.size());
    auto const samples = state_samples::sensed(e, channel).bounded();
    for (auto& m : e.measurements) {
        if (m.channel != channel) continue;
        double const moved = m.time - delay;
        auto const late = traits::sub(traits::point(m.time), traits::point(moved));
        double const near = half + mag(traits::sub(late, traits::point(delay)));
        double const more =
            near > 0 ? near * steepest_about(samples, law, m.time, near) * (1 + 1e-9) : 0;
        m.bound = traits::add(m.bound, traits::bounds(-more, more));
        m.time = moved;
    }
}

} // namespace diagnosis_detail

/// @param laws         declared variations of the states' rates, per experiment
/// @param delay, half  the delays delay - half to delay + half
[[nodiscard]] inline suspect_problem
suspect_of(identification_problem const& source, faulty_channel const& f,
           std::map<std::string, std::vector<rate_variation>> const& laws, double delay,
           double half) {
    suspect_problem result{source, {f.state, f.scale, f.drift, f.mixing, laws}};
    auto& problem = result.problem;
    diagnosis_detail::correct_state(problem, source, f);
    for (auto& e : problem.experiments) {
        auto const found = laws.find(e.name);
        if (found == laws.end()) continue; // it is not used
        auto& law = result.sensor.laws[e.name][f.state];
        diagnosis_detail::start_at_shown(e, f, found->second, law);
        diagnosis_detail::move_readings(e, f.channel, law, delay, half);
    }
    std::erase_if(problem.experiments, [](experiment const& e) { return e.measurements.empty(); });
    return result;
}

/// Delays that stand for [0, latency], and half of what each one stands for.
[[nodiscard]] inline std::pair<std::vector<double>, double>
delay_slices(identification_problem const& problem, faulty_channel const& f,
             std::size_t most_slices) {
    if (!(f.latency > 0)) return {{0.0}, 0.0};
    // As long as the channel takes to move by its error where it is fast. Where it rests, any.
    std::vector<double> lengths;
    for (auto const& e : problem.experiments) {
        auto const s = state_samples::sensed(e, f.channel).bounded();
        for (std::size_t k = 0; k + 1 < s.times.size(); ++k) {
            double const rate =
                mag((s.bounds[k + 1] - s.bounds[k])) / (s.times[k + 1] - s.times[k]);
            if (rate > 0) lengths.push_back(rad(s.bounds[k]) / rate);
        }
    }
    double length = f.latency;
    if (!lengths.empty()) {
        auto const middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 4);
        std::nth_element(lengths.begin(), middle, lengths.end());
        length = std::min(length, 2 * *middle);
    }
    auto const count = static_cast<std::size_t>(
        std::clamp(std::ceil(f.latency / length), std::min(10.0, static_cast<double>(most_slices)),
                   static_cast<double>(most_slices)));
    double const half = f.latency / static_cast<double>(count) / 2;
    std::vector<double> delays;
    for (std::size_t k = 0; k < count; ++k) delays.push_back(half * static_cast<double>(2 * k + 1));
    return {delays, half * (1 + 1e-9)};
}

/// What sensors may do where a place is proved, in words.
[[nodiscard]] inline std::string fault_assumption(identification_problem const& problem,
                                                  std::vector<faulty_channel> const& all) {
    auto const& about = problem.model.about;
    std::string text = "at most one sensor errs beyond its bounds, by no more than";
    for (std::size_t k = 0; k < all.size(); ++k) {
        auto const& f = all[k];
        auto const& c = about.channels[f.channel];
        auto const most = [](interval const& x) { return nearest_text(mag(x), 3); };
        text += std::string{k == 0 ? " " : " / "} + c.name + ": scale " + most(f.scale) +
                ", offset " + most(f.offset) + " " + c.unit + ", drift " + most(f.drift) + " " +
                rate_unit(c.unit, about.time_unit);
        for (auto const& [m, share] : f.mixing) {
            text += ", share of " + about.states[m].name + " " + most(share);
        }
        text += ", delay " + nearest_text(f.latency, 3) + " " + about.time_unit;
    }
    return text;
}

} // namespace sivid

#endif
