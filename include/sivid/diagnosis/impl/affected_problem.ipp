// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_IMPL_AFFECTED_PROBLEM_IPP
#define SIVID_DIAGNOSIS_IMPL_AFFECTED_PROBLEM_IPP

#include <sivid/diagnosis/affected_problem.hpp>
#include <sivid/measurement/wrapped_readings.hpp>

#include <optional>

namespace sivid {

namespace diagnosis_detail {
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
/// How often a channel has wrapped in an experiment.
inline signal wraps_in(experiment const& x, recorded_model const& model,
                       effect::wrapped_channel const& w) {
    auto const y = index_of(model.about.channels, w.channel, "channel");
    auto const& shown = model.g[model.observe[y]];
    double const turn = full_turn(model.about.channels[y].unit);
    std::optional<double> start; // of a state that the channel shows as it is
    auto const i = static_cast<std::size_t>(shown.index);
    bool const own = shown.op == operation::state && i < x.initial.size();
    if (own && width(x.initial[i]) < (turn > 0 ? turn : 2 * w.least)) start = mid(x.initial[i]);
    auto count = wraps_of(x.measurements, y, w.least, x.begin, start, turn);
    if (count.values().size() > 1) return count;
    return analytic_signal::from([n = count.values()[0]](auto const&) { return n; });
}
} // namespace diagnosis_detail

SIVID_DECL identification_problem affected(identification_problem const& base,
                                           std::vector<effect> const& effects) {
    identification_problem result{with(base.model, effects), base.choice, {}, base.experiments};
    auto const& inputs = result.model.about.inputs;
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
            auto const own = of("");
            x.inputs.push_back(own == effects.end()
                                   ? diagnosis_detail::wraps_in(x, base.model, *of(".wraps")->wraps)
                                   : diagnosis_detail::switch_of(*own, x));
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
