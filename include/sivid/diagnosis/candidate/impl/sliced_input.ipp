// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CANDIDATE_IMPL_SLICED_INPUT_IPP
#define SIVID_DIAGNOSIS_CANDIDATE_IMPL_SLICED_INPUT_IPP

#include <sivid/diagnosis/candidate/detail/sliced_input.hpp>

#include <sivid/diagnosis/affected_problem.hpp>
#include <sivid/diagnosis/candidate/detail/hull_search.hpp>
#include <sivid/diagnosis/candidate/detail/input_slices.hpp>
#include <sivid/diagnosis/candidate/detail/late_channels.hpp>
#include <sivid/diagnosis/candidate/resolve_memory.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace sivid {

namespace diagnosis_detail {

inline bool is_recorded(identification_problem const& problem, std::size_t input) {
    return std::all_of(problem.experiments.begin(), problem.experiments.end(),
                       [&](experiment const& e) {
                           return std::holds_alternative<sampled_signal>(e.inputs[input]);
                       });
}
inline std::string full_name(effect const& e) { return e.name + "." + e.parameters[0].name; }

/// The problem over a box, with the effect `which` as a line in its only parameter: its slope is a
/// further input, by which it acts.
/// @param order  when it acts, among the effects
/// @param form   (input, experiment, range) -> input_of_parameter
template <class Form>
[[nodiscard]] identification_problem
with_line(identification_problem const& base, std::vector<effect> effects, std::size_t which,
          std::size_t input, int order, box const& all, Form const& form) {
    auto& e = effects[which];
    for (auto const& x : base.experiments) e.only_in.push_back(x.name);
    e.order = order;
    e.parameters[0].neutral = decimal{}; // where its slope is 0, it does nothing
    auto const name = base.model.about.inputs[input].name;
    e.on_inputs = [name](effect_scope& h) { h.input(name) += h.parameter(); };
    auto problem = affected(base, effects);
    auto const j = index_of_parameter(problem, full_name(e));
    auto const slope = index_of(problem.model.about.inputs, e.name, "input");
    auto prior = all;
    for (auto& x : problem.experiments) {
        input_of_parameter line = form(std::get<sampled_signal>(x.inputs[input]), x, all[j]);
        prior[j] = interval_traits<interval>::sub(all[j], interval(line.at));
        x.inputs[slope] = std::move(line.slope);
        x.inputs[input] = std::move(line.middle);
    }
    problem.prior = std::move(prior);
    start_added_states(problem);
    return problem;
}

/// The problem over a box, with a delay or a play within its range there as an error of the input.
[[nodiscard]] inline identification_problem with_errors(identification_problem const& whole,
                                                        signal_memory const& memory, std::size_t j,
                                                        box const& all) {
    auto problem = resolve_memory(whole, mid(all)).problem;
    for (std::size_t s = 0; s < problem.experiments.size(); ++s) {
        auto& e = problem.experiments[s];
        auto const& u = std::get<sampled_signal>(whole.experiments[s].inputs[memory.index]);
        e.inputs[memory.index] = memory.kind == memory_kind::play
                                     ? played(u, e.begin, e.end(), all[j]).within
                                     : delayed_within(u, e.begin, e.end(), all[j]);
    }
    std::vector<interval> sides(all.begin(), all.end());
    sides.erase(sides.begin() + static_cast<std::ptrdiff_t>(j));
    problem.prior = box(std::move(sides));
    start_added_states(problem);
    return problem;
}

/// A delay or a play.
inline std::optional<sliced_input> sliced_memory(identification_problem const& base,
                                                 std::vector<effect> const& effects,
                                                 identification_problem whole) {
    auto const memory = whole.model.input_memory[0];
    auto const& name = whole.model.about.constants[memory.constant].name;
    sliced_input result{index_of_parameter(whole, name), false, nullptr};
    if (result.side == whole.prior.size() || !is_recorded(whole, memory.index)) return std::nullopt;
    auto const all_linear = [&] {
        return std::all_of(whole.experiments.begin(), whole.experiments.end(), [&](auto const& x) {
            return std::get<sampled_signal>(x.inputs[memory.index]).kind() == interpolation::linear;
        });
    };
    for (std::size_t k = 0; k < effects.size(); ++k) {
        auto const& e = effects[k];
        bool const only = e.parameters.size() == 1 && !e.on_rates && !e.on_channels;
        if (memory.kind != memory_kind::delay || !only || full_name(e) != name || !all_linear())
            continue;
        result.is_parameter = true;
        result.over = [&base, &effects, k, memory](box const& all) {
            auto const late = [](auto const& u, experiment const& x, interval const& delays) {
                return late_by_parameter(u, x.begin, x.end(), delays);
            };
            constexpr int first = std::numeric_limits<int>::min(); // what others see is late
            return with_line(base, effects, k, memory.index, first, all, late);
        };
        return result;
    }
    result.over = [whole = std::move(whole), memory, j = result.side](box const& all) {
        return with_errors(whole, memory, j, all);
    };
    return result;
}

} // namespace diagnosis_detail

namespace diagnosis_detail {
/// Channels that show the past.
inline std::optional<sliced_input> sliced_latency(identification_problem const& base,
                                                  std::vector<effect> const& effects,
                                                  identification_problem const& whole) {
    // A switch in time would have to be late, too.
    if (std::any_of(effects.begin(), effects.end(),
                    [](effect const& e) { return e.begins_later() || e.ends(); }))
        return std::nullopt;
    auto const& model = whole.model;
    auto const constant = model.channel_delays.front().constant;
    std::vector<bool> late(model.about.channels.size(), false);
    for (auto const& d : model.channel_delays) {
        if (d.constant != constant) return std::nullopt;
        late[d.index] = true;
    }
    auto const& name = model.about.constants[constant].name;
    auto const j = index_of_parameter(whole, name);
    if (j == whole.prior.size() || !(whole.prior[j].lower() >= 0)) return std::nullopt;
    auto const of_time = [&](node_id n) { return (model.g.depends(n) & on_time) != 0; };
    if (std::any_of(model.rate.begin(), model.rate.end(), of_time)) return std::nullopt;
    for (std::size_t y = 0; y < late.size(); ++y)
        if (late[y] && of_time(model.observe[y])) return std::nullopt;
    for (std::size_t i = 0; i < base.model.about.inputs.size(); ++i)
        if (!is_recorded(base, i)) return std::nullopt;
    for (std::size_t k = 0; k < effects.size(); ++k) {
        auto const& e = effects[k];
        bool const only = e.parameters.size() == 1 && !e.on_rates && !e.on_inputs;
        if (!only || full_name(e) != name) continue;
        return sliced_input{j, true, [&base, &effects, k, late, j](box const& all) {
                                return with_late_channels(base, effects, k, late, j, all);
                            }};
    }
    return std::nullopt;
}
} // namespace diagnosis_detail

SIVID_DECL std::optional<sliced_input> sliced_input_of(identification_problem const& base,
                                                       std::vector<effect> const& effects) {
    auto whole = affected(base, effects);
    if (!whole.model.channel_delays.empty()) {
        if (!whole.model.input_memory.empty()) return std::nullopt;
        return diagnosis_detail::sliced_latency(base, effects, whole);
    }
    if (whole.model.input_memory.size() > 1) return std::nullopt;
    if (whole.model.has_memory())
        return diagnosis_detail::sliced_memory(base, effects, std::move(whole));
    for (std::size_t k = 0; k < effects.size(); ++k) {
        auto const& e = effects[k];
        if (!e.threshold || !e.only_in.empty() || e.parameters.size() != 1) continue;
        auto const input = index_of(base.model.about.inputs, e.threshold->input, "input");
        auto const j = index_of_parameter(whole, diagnosis_detail::full_name(e));
        bool const acts_first = acts_on_recorded_inputs(effects, k);
        bool const exact = j < whole.prior.size() && whole.prior[j].lower() >= 0;
        if (!acts_first || !exact || !diagnosis_detail::is_recorded(base, input)) continue;
        return sliced_input{j, true, [&base, &effects, k, input](box const& all) {
                                auto const form = [&](auto const& u, experiment const& x,
                                                      interval const& range) {
                                    return threshold_by_parameter(
                                        u, x.begin, x.end(), effects[k].threshold->stands, range);
                                };
                                return diagnosis_detail::with_line(base, effects, k, input,
                                                                   effects[k].order, all, form);
                            }};
    }
    return std::nullopt;
}

} // namespace sivid

#endif
