// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_CHANGE_ADDED_START_HPP
#define SIVID_MODEL_CHANGE_ADDED_START_HPP

#include <sivid/model/bound_model.hpp>
#include <sivid/model/graph/graph_range.hpp>
#include <sivid/model/graph/rewrite.hpp>
#include <sivid/model/model.hpp>
#include <sivid/space/box.hpp>

#include <cmath>
#include <cstddef>
#include <stdexcept>
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
    auto const seen = operands_of(model.g, {node});
    for (std::size_t k = 0; k < seen.size(); ++k) {
        auto const& n = model.g.nodes()[k];
        auto const i = static_cast<std::size_t>(n.index);
        if (seen[k] && n.op == operation::input) at.inputs[i] = input_at(inputs[i], time);
    }
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

} // namespace sivid

#endif
