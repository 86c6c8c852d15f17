// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RUN_IMPL_RUN_REACH_IPP
#define SIVID_PAVING_RUN_IMPL_RUN_REACH_IPP

#include <sivid/paving/run/run_reach.hpp>

#include <sivid/compiled.hpp>
#include <sivid/enclosure/flow.hpp>
#include <sivid/measurement/record.hpp>
#include <sivid/model/structure/states_seen.hpp>
#include <sivid/paving/response/local_response.hpp>
#include <sivid/paving/run/experiment_run.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

namespace sivid {

namespace paving_detail {

/// @given  samples in the order of time
[[nodiscard]] inline std::vector<double> instants_of(record const& samples) {
    std::vector<double> times;
    for (auto const& m : samples) {
        if (times.empty() || m.time > times.back()) times.push_back(m.time);
    }
    return times;
}

/// The measurements of some of the instants, spread over all of them.
[[nodiscard]] inline record thinned(record const& samples, std::size_t instants) {
    auto const times = instants_of(samples);
    if (times.size() <= instants) return samples;
    std::vector<double> kept;
    for (std::size_t k = 1; k <= instants; ++k) {
        kept.push_back(times[k * times.size() / instants - 1]);
    }
    record result;
    std::copy_if(
        samples.begin(), samples.end(), std::back_inserter(result),
        [&](measurement const& m) { return std::binary_search(kept.begin(), kept.end(), m.time); });
    return result;
}

/// What spreads an output, the most first.
[[nodiscard]] inline std::vector<run_reach::cause> causes_of(identification_problem const& problem,
                                                             response const& r,
                                                             local_response const& local,
                                                             std::size_t output) {
    std::vector<run_reach::cause> result;
    double all = local.rest[output];
    auto const add = [&](bool start, auto const& sides, auto const& name_of) {
        for (std::size_t i = 0; i < sides.size(); ++i) {
            if (!(sides[i].radius > 0)) continue;
            double const moved = std::abs(local.slope[sides[i].variable * r.outputs() + output]);
            all += moved;
            result.push_back({start, i, name_of(i), moved});
        }
    };
    add(true, r.unknowns.initial,
        [&](std::size_t i) { return problem.model.about.states[i].name; });
    add(false, r.unknowns.parameters, [&](std::size_t j) { return problem.choice.unknown[j]; });
    for (auto& c : result) c.share = all > 0 ? c.share / all : 0;
    std::erase_if(result, [](auto const& c) { return !(c.share >= 0.1); });
    std::sort(result.begin(), result.end(),
              [](auto const& a, auto const& b) { return a.share > b.share; });
    return result;
}

/// With all states seen after the measurements of each instant, as channels behind the own ones.
[[nodiscard]] inline record with_states(record const& samples, std::size_t channels,
                                        std::size_t states) {
    record result;
    for (std::size_t k = 0; k < samples.size(); ++k) {
        result.push_back(samples[k]);
        bool const last = k + 1 == samples.size() || samples[k].time < samples[k + 1].time;
        if (!last || samples[k].channel >= channels) continue;
        for (std::size_t i = 0; i < states; ++i) {
            result.push_back({samples[k].time, channels + i, interval_traits<interval>::entire()});
        }
    }
    return result;
}

/// Names the state that is widest against its limit.
/// @returns its number
template <class F>
std::size_t name_widest(std::vector<model_description::state> const& states, F const& width_of,
                        run_reach& result) {
    auto const against_limit = [&](std::size_t i) { return width_of(i) / states[i].limit; };
    std::size_t widest = 0;
    for (std::size_t i = 1; i < states.size(); ++i) {
        if (!(against_limit(i) <= against_limit(widest))) widest = i;
    }
    result.state = states[widest].name;
    result.unit = states[widest].unit;
    result.width = width_of(widest);
    return widest;
}

/// Compares what an output does with its error bound, half the range that it may have.
inline void add_output(run_reach& result, response const& r, local_response const& local,
                       std::size_t y, double bound) {
    double moved = 0;
    for (std::size_t v = 0; v < r.table->variables; ++v)
        moved += std::abs(local.slope[v * r.outputs() + y]);
    double const spread = (moved + local.rest[y]) / bound;
    bool const known = bound > 0 && std::isfinite(r.radius[y]) && std::isfinite(spread);
    if (!known) {
        result.spread = std::numeric_limits<double>::infinity();
        return;
    }
    result.spread = std::max(result.spread, spread);
    result.moved = std::max(result.moved, moved / bound);
    result.lost = std::max(result.lost, r.radius[y] / bound);
}

inline run_reach reach_of_run(identification_problem const& problem, std::size_t e,
                              recorded_model const& seen, box const& parameters,
                              run_options const& options) {
    constexpr std::size_t instants = 50;
    auto const& whole = problem.experiments[e];
    auto const& about = problem.model.about;
    auto const states = whole.initial.size();
    auto const channels = about.channels.size();
    auto const all = sorted(whole.measurements);
    auto const looked_at = thinned(all, instants);
    run_reach result;
    result.scenario = whole.name;
    result.time_unit = about.time_unit;
    result.begin = result.until = whole.begin;
    result.end = looked_at.back().time;
    result.instants = instants_of(looked_at).size();
    result.measured = instants_of(all).size();
    auto const samples = with_states(looked_at, channels, states);
    experiment run{whole.name, whole.inputs, whole.begin, whole.initial, samples, samples.size()};
    flow const f(seen, problem.choice, whole.inputs, region_of_runs{whole.initial, parameters});
    auto const r = (*make_run(f, run, samples, parameters, options))(whole.initial, parameters);
    result.interrupted = options.cancelled();
    auto const local = expand(*r, parameters);
    auto const ranges = output_ranges(*r, local);
    name_widest(
        about.states, [&](std::size_t i) { return width(whole.initial[i]); }, result);
    std::size_t at = 0; // the last outputs where all states were reached
    for (std::size_t y = 0; y < r->outputs(); ++y) {
        if (samples[y].channel + 1 == channels + states && is_bounded(ranges[y])) at = y + 1;
    }
    if (at == 0) return result;
    for (std::size_t y = 0; y < at; ++y) {
        if (samples[y].channel >= channels) continue;
        add_output(result, *r, local, y, 0.5 * width(samples[y].bound));
    }
    result.until = samples[at - 1].time;
    auto const first = at - states; // of the states there
    auto const state = name_widest(
        about.states, [&](std::size_t i) { return width(ranges[first + i]); }, result);
    result.causes = causes_of(problem, *r, local, first + state);
    return result;
}

} // namespace paving_detail

SIVID_DECL std::vector<run_reach> reach_of_runs(identification_problem const& problem,
                                                box const& parameters, run_options const& run) {
    problem.require_valid();
    std::vector<run_reach> result;
    if (problem.model.has_memory()) return result;
    auto const seen = with_states_seen(problem.model);
    for (std::size_t e = 0; e < problem.experiments.size(); ++e) {
        auto const& known = problem.experiments[e];
        if (known.measurements.empty() || known.constraint) continue;
        if (run.cancelled()) break;
        result.push_back(paving_detail::reach_of_run(problem, e, seen, parameters, run));
    }
    return result;
}

} // namespace sivid

#endif
