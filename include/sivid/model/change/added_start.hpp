// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_CHANGE_ADDED_START_HPP
#define SIVID_MODEL_CHANGE_ADDED_START_HPP

#include <sivid/model/bound_model.hpp>
#include <sivid/model/graph/graph_range.hpp>
#include <sivid/model/graph/rewrite.hpp>
#include <sivid/model/model.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

namespace sivid {

/// Encloses an input at one time, its error included.
/// @throws std::domain_error  where it is not defined
[[nodiscard]] inline interval input_at(signal const& s, double t) {
    if (auto const* sampled = std::get_if<sampled_signal>(&s)) {
        using traits = interval_traits<interval>;
        auto const piece = sampled->piece(t);
        double const e = sampled->error_bound(piece, t);
        return traits::add(sampled->value<interval>(piece, interval(t)), traits::bounds(-e, e));
    }
    auto const& formula = std::get<analytic_signal>(s);
    graph_range range(formula.g, {formula.value});
    range.evaluate({interval(t), {}, {}, {}});
    if (range.undefined(formula.value))
        throw std::domain_error("an input is not defined at the begin of its experiment");
    return range.value(formula.value);
}

/// Encloses a node of a model at one time, over ranges of what it depends on.
/// @param inputs  those of the model
/// @returns  the whole line where it may be undefined
/// @throws std::domain_error  where an input is not defined
[[nodiscard]] inline interval value_at(recorded_model const& model, node_id node, double time,
                                       box const& states, std::vector<interval> const& constants,
                                       std::vector<signal> const& inputs) {
    leaf_ranges at{interval(time), states, box(constants), box(inputs.size())};
    for (auto const i : leaves_of(model.g, {node}, operation::input))
        at.inputs[i] = input_at(inputs[i], time);
    graph_range range(model.g, {node});
    range.evaluate(at);
    return range.undefined(node) ? interval_traits<interval>::entire() : range.value(node);
}

/// Encloses the value at which a state that was added to a model begins, over ranges of what it
/// depends on.
/// @param inputs  those of the model
/// @throws std::domain_error  where the value is not defined, or not bounded
[[nodiscard]] inline interval start_of(recorded_model const& model, added_state const& added,
                                       std::vector<interval> const& constants,
                                       std::vector<signal> const& inputs, double begin,
                                       box const& states = {}) {
    auto const value = value_at(model, added.at_begin, begin, states, constants, inputs);
    if (!std::isfinite(mag(value)))
        throw std::domain_error("the initial value of state '" +
                                model.about.states[added.state].name + "' is not defined");
    return value;
}

/// Where the states of a model start that effects have added to those of `start`: as they say, for
/// the parameters in these ranges, or anywhere in their own.
/// @param inputs  those of the model
/// @throws std::domain_error where such a value is not defined
[[nodiscard]] inline box start_with_added(recorded_model const& model,
                                          std::vector<interval> const& constants,
                                          std::vector<signal> const& inputs, double begin,
                                          box const& start) {
    std::vector<interval> sides(start.begin(), start.end());
    auto const& states = model.about.states;
    for (auto k = sides.size(); k < states.size(); ++k) sides.push_back(states[k].limit.range());
    for (auto const& a : model.added_states)
        sides[a.state] = start_of(model, a, constants, inputs, begin);
    return box(std::move(sides));
}

/// Sets the initial ranges of the states that effects added, for the parameters in the prior.
/// @throws std::domain_error where such a value is not defined
inline void start_added_states(identification_problem& problem) {
    auto const constants = constant_ranges(problem.model, problem.choice, problem.prior);
    for (auto& e : problem.experiments)
        e.initial = start_with_added(problem.model, constants, e.inputs, e.begin, e.initial);
}

/// Whether a state that effects added starts at a value that the parameters decide, or inputs
/// within their errors: of its initial range then only one value belongs to a parameter.
[[nodiscard]] inline bool starts_follow_parameters(identification_problem const& problem) {
    return std::any_of(
        problem.experiments.begin(), problem.experiments.end(), [&](experiment const& e) {
            return std::any_of(problem.model.added_states.begin(), problem.model.added_states.end(),
                               [&](added_state const& a) { return width(e.initial[a.state]) > 0; });
        });
}

/// A start of an experiment at a point of the parameters, where states that follow them begin as
/// they say, with the inputs as recorded; nothing where that is not within the initial box.
/// @param start  of the other states
[[nodiscard]] inline std::optional<box> start_that_follows(identification_problem const& problem,
                                                           std::size_t experiment,
                                                           box const& parameters, box start) {
    auto const& e = problem.experiments[experiment];
    std::vector<interval> constants;
    std::vector<signal> inputs;
    for (auto const& a : problem.model.added_states) {
        if (!(width(e.initial[a.state]) > 0)) continue;
        if (constants.empty()) {
            constants = constant_ranges(problem.model, problem.choice, parameters);
            inputs = nominal(e.inputs);
        }
        start[a.state] =
            intersect(start_of(problem.model, a, constants, inputs, e.begin), e.initial[a.state]);
    }
    return is_empty(start) ? std::nullopt : std::optional(std::move(start));
}

} // namespace sivid

#endif
