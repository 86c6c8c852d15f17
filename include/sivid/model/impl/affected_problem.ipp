// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_IMPL_AFFECTED_PROBLEM_IPP
#define SIVID_MODEL_IMPL_AFFECTED_PROBLEM_IPP

#include <sivid/measurement/wrapped_readings.hpp>
#include <sivid/model/affected_problem.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

namespace model_detail {
/// A formula where it stays as it is, so that the model folds; a held input with knots where the
/// effect begins and ends.
inline signal switch_of(effect const& e, experiment const& x) {
    auto const& in = e.only_in;
    auto const k = static_cast<std::size_t>(std::find(in.begin(), in.end(), x.name) - in.begin());
    double on = k < in.size() ? 1 : 0;
    double const since = k < e.since.size() ? e.since[k] : effect::from_start;
    double const until = k < e.until.size() ? e.until[k] : effect::for_ever;
    bool const begins = since > x.begin, ends = until > x.begin && until < effect::for_ever;
    if (begins || ends) {
        std::vector<double> times{x.begin}, values{begins ? 0.0 : 1.0};
        if (begins) times.push_back(since), values.push_back(1);
        if (ends) times.push_back(until), values.push_back(0);
        return sampled_signal(std::move(times), std::move(values), interpolation::hold);
    }
    if (until <= x.begin) on = 0;
    return analytic_signal::from([on](auto const&) { return on; });
}
/// What T of an effect that wraps may be: those of its prior about which readings leap.
inline interval turn_of(identification_problem const& base, effect const& e) {
    auto const prior =
        e.parameters.empty() ? interval_traits<interval>::entire() : e.parameters[0].prior();
    auto const y = index_of(base.model.about.channels, e.wraps->channel, "channel");
    auto leaps = interval_traits<interval>::empty();
    for (auto const& x : base.experiments)
        leaps = hull(leaps, turn_of_leaps(x.measurements, y, e.wraps->least));
    auto const both = interval_traits<interval>::intersect(prior, leaps);
    return is_empty(both) ? prior : both;
}
/// How often a channel has wrapped in an experiment.
/// @param turn  `turn_of` the effect
inline signal wraps_in(experiment const& x, identification_problem const& base,
                       std::vector<interval> const& constants, effect const& e,
                       interval const& turn) {
    auto const& about = base.model.about;
    auto const& w = *e.wraps;
    auto const y = index_of(about.channels, w.channel, "channel");
    auto const fail = [&](std::string const& what) {
        throw std::invalid_argument("effect '" + e.name + "', experiment '" + x.name +
                                    "', channel '" + w.channel + "': " + what);
    };
    auto const held = [](double n) {
        return analytic_signal::from([n](auto const&) { return n; });
    };
    if (!e.acts_in(x.name)) return held(0);
    auto const start =
        value_at(base.model, base.model.observe[y], x.begin, x.initial, constants, x.inputs);
    auto first = wraps_before(x.measurements, y, start, turn);
    double const full = full_turn(about.channels[y].unit);
    if (!first && full > 0 && contains(turn, full))
        first = wraps_before(x.measurements, y, start, interval(full));
    if (!first)
        fail("how often it had wrapped when it is first read cannot be told from where it starts; "
             "give a narrower start, or a narrower prior of T, or follow the turns");
    try {
        auto count = wraps_of(x.measurements, y, w.least, x.begin, *first);
        if (count.values().size() > 1) return count;
    } catch (std::invalid_argument const& error) {
        fail(error.what());
    }
    return held(*first);
}
} // namespace model_detail

SIVID_DECL identification_problem affected(identification_problem const& base,
                                           std::vector<effect> const& effects) {
    base.require_all_inputs_and_states();
    identification_problem result{with(base.model, effects), base.choice, {}, base.experiments};
    auto const& inputs = result.model.about.inputs;
    std::map<std::string, interval> turns; // by effect
    for (auto const& e : effects)
        if (e.wraps) turns[e.name] = model_detail::turn_of(base, e);
    std::vector<interval> constants;
    if (!turns.empty()) constants = constant_ranges(base.model, base.choice, base.prior);
    for (auto& x : result.experiments) {
        for (auto k = base.model.about.inputs.size(); k < inputs.size(); ++k) {
            auto const& copies = result.model.input_copies;
            auto const c = std::find_if(copies.begin(), copies.end(),
                                        [k](input_copy const& one) { return one.copy == k; });
            if (c != copies.end()) {
                x.inputs.push_back(signal(x.inputs[c->of]));
                continue;
            }
            auto const of = [&](std::string const& what) {
                return std::find_if(effects.begin(), effects.end(), [&](effect const& e) {
                    return e.name + what == inputs[k].name;
                });
            };
            if (auto const own = of(""); own != effects.end()) {
                x.inputs.push_back(model_detail::switch_of(*own, x));
            } else {
                auto const& e = *of(".wraps");
                x.inputs.push_back(model_detail::wraps_in(x, base, constants, e, turns.at(e.name)));
            }
        }
    }
    std::vector<interval> prior(base.prior.begin(), base.prior.end());
    for (auto const& e : effects) {
        for (auto const& p : e.parameters) {
            result.choice.unknown.push_back(e.name + "." + p.name);
            prior.push_back(p.prior());
        }
    }
    result.prior = box(std::move(prior));
    start_added_states(result);
    return result;
}

} // namespace sivid

#endif
