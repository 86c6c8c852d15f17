// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_BOUND_MODEL_HPP
#define SIVID_MODEL_BOUND_MODEL_HPP

#include <sivid/compiled.hpp>
#include <sivid/measurement/signal.hpp>
#include <sivid/model/differentiate.hpp>
#include <sivid/model/model.hpp>
#include <sivid/model/parameter_choice.hpp>
#include <sivid/model/rewrite.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace sivid {

/// An input given by a formula in time, recorded once.
struct analytic_signal {
    graph g;
    node_id value = 0;

    /// From a functor on a scalar: `analytic_signal::from([](auto const& t) { return sin(t); })`.
    template <class F>
    [[nodiscard]] static analytic_signal from(F const& f) {
        analytic_signal s;
        expression const t(s.g, s.g.leaf(operation::time, 0));
        s.value = expression(f(t)).in(s.g);
        return s;
    }
};

/// An input of a scenario: recorded samples or a formula.
using signal = std::variant<sampled_signal, analytic_signal>;

/// Whether a signal is known up to an error bound only; formulas are exact.
[[nodiscard]] inline bool is_uncertain(signal const& s) {
    auto const* sampled = std::get_if<sampled_signal>(&s);
    return sampled != nullptr && !sampled->exact();
}
[[nodiscard]] inline bool any_uncertain(std::vector<signal> const& inputs) {
    return std::any_of(inputs.begin(), inputs.end(), is_uncertain);
}
/// The inputs as recorded, which are among those that their error bounds allow.
[[nodiscard]] inline std::vector<signal> nominal(std::vector<signal> inputs) {
    for (auto& s : inputs) {
        if (is_uncertain(s)) s = std::get<sampled_signal>(s).nominal();
    }
    return inputs;
}

/// A model with its constants bound and its analytic inputs inserted: the graph that is simulated
/// and enclosed. `operation::constant` leaves are now the unknown parameters p.
struct bound_model {
    model_description about;
    std::vector<std::size_t> parameters; ///< index of each unknown among the model's constants
    std::vector<std::size_t> sampled;    ///< inputs that are sampled, by index in the model
    std::vector<std::size_t> uncertain;  ///< those of them that have error bounds
    graph g;
    std::vector<node_id> rate;
    std::vector<node_id> observe;
    std::vector<std::vector<node_id>> rate_dx, rate_dp;       ///< \f$ \partial f/\partial x, p \f$
    std::vector<std::vector<node_id>> observe_dx, observe_dp; ///< \f$ \partial g/\partial x, p \f$
    std::vector<std::vector<node_id>> rate_du; ///< \f$ \partial f/\partial u \f$, uncertain inputs

    [[nodiscard]] std::size_t state_count() const { return rate.size(); }
    [[nodiscard]] std::size_t parameter_count() const { return parameters.size(); }
    [[nodiscard]] std::size_t channel_count() const { return observe.size(); }
};

/// Binds constants and inputs, folds what became constant, and differentiates. Derived constants
/// that follow their formulas (`followed`) become functions of the others.
/// @param inputs  one signal per input of the model
/// @given  the model has no delays (checked): they have to be resolved first
/// @throws std::invalid_argument on unknown names, a wrong number of inputs, or an empty value
[[nodiscard]] SIVID_ENTRY bound_model bind(recorded_model const& model,
                                           parameter_choice const& choice,
                                           std::vector<signal> const& inputs);

#if !defined(SIVID_COMPILED) || defined(SIVID_COMPILE_BIND)
SIVID_ENTRY bound_model bind(recorded_model const& model, parameter_choice const& choice,
                             std::vector<signal> const& inputs) {
    auto const& about = model.about;
    if (inputs.size() != about.inputs.size()) {
        throw std::invalid_argument("model '" + about.name + "' has " +
                                    std::to_string(about.inputs.size()) + " inputs, but " +
                                    std::to_string(inputs.size()) + " signals were given");
    }
    if (model.has_delays()) {
        throw std::invalid_argument("model '" + about.name +
                                    "' has delays; fix them and shift the signals first");
    }
    bound_model result;
    result.about = about;
    std::vector<int> position(about.constants.size(), -1);
    for (auto const& name : choice.unknown) {
        auto const k = index_of(about.constants, name, "constant");
        if (position[k] >= 0) throw std::invalid_argument("parameter '" + name + "' stands twice");
        position[k] = static_cast<int>(result.parameters.size());
        result.parameters.push_back(k);
    }
    std::vector<literal> values;
    for (auto const& c : about.constants) values.push_back(c.nominal);
    for (auto const& [name, value] : choice.fixed) {
        if (is_empty(value)) throw std::invalid_argument("constant '" + name + "' has no value");
        values[index_of(about.constants, name, "constant")] = literal{value, mid(value)};
    }
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        if (std::holds_alternative<sampled_signal>(inputs[i])) result.sampled.push_back(i);
        if (is_uncertain(inputs[i])) result.uncertain.push_back(i);
    }

    std::vector<node_id> outputs = model.rate;
    outputs.insert(outputs.end(), model.observe.begin(), model.observe.end());
    auto& g = result.g;
    std::map<std::size_t, node_id> derived; // by constant
    auto const leaf = [&](node const& n, graph& to) -> node_id {
        auto const k = static_cast<std::size_t>(n.index);
        if (n.op == operation::constant) {
            if (auto const d = derived.find(k); d != derived.end()) return d->second;
            if (position[k] < 0) return to.constant(values[k]);
            return to.leaf(operation::constant, static_cast<std::size_t>(position[k]));
        }
        if (n.op == operation::input) {
            if (auto const* formula = std::get_if<analytic_signal>(&inputs[k])) {
                auto const time = [](node const&, graph& h) { return h.leaf(operation::time, 0); };
                return copy_into(to, formula->g, {formula->value}, time).front();
            }
        }
        return to.leaf(n.op, k);
    };
    for (auto const& d : followed(model, choice)) {
        derived[d.constant] = copy_into(g, model.g, {d.value}, leaf).front();
    }
    auto const images = copy_into(g, model.g, outputs, leaf);
    auto const split = images.begin() + static_cast<std::ptrdiff_t>(model.rate.size());
    result.rate.assign(images.begin(), split);
    result.observe.assign(split, images.end());

    std::vector<node_id> x;
    std::vector<node_id> p;
    for (std::size_t i = 0; i < result.state_count(); ++i) x.push_back(g.leaf(operation::state, i));
    for (std::size_t j = 0; j < result.parameter_count(); ++j) {
        p.push_back(g.leaf(operation::constant, j));
    }
    result.rate_dx = differentiate(g, result.rate, x);
    result.rate_dp = differentiate(g, result.rate, p);
    result.observe_dx = differentiate(g, result.observe, x);
    result.observe_dp = differentiate(g, result.observe, p);
    std::vector<node_id> u;
    for (auto const i : result.uncertain) u.push_back(g.leaf(operation::input, i));
    if (!u.empty()) result.rate_du = differentiate(g, result.rate, u);
    return result;
}
#endif

} // namespace sivid

#endif
