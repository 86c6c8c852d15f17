// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_IMPL_BOUND_MODEL_IPP
#define SIVID_MODEL_IMPL_BOUND_MODEL_IPP

#include <sivid/model/bound_model.hpp>
#include <sivid/model/structure/detail/resting_states.hpp>

#include <algorithm>

namespace sivid {

namespace model_detail {

/// The value that an input has at all times; none where it changes, or is not known.
inline std::optional<double> only_value(signal const& s) {
    auto const* const sampled = std::get_if<sampled_signal>(&s);
    if (sampled == nullptr || !sampled->exact()) return std::nullopt;
    auto const& v = sampled->values();
    auto const [low, high] = std::minmax_element(v.begin(), v.end());
    if (*low != *high) return std::nullopt;
    return *low;
}

/// Copies rates and outputs at once: what they share stays one node.
template <class Leaf>
void copy_outputs(bound_model& m, graph& to, graph const& from, std::vector<node_id> outputs,
                  std::vector<node_id> const& observe, Leaf const& leaf) {
    auto const rates = static_cast<std::ptrdiff_t>(outputs.size());
    outputs.insert(outputs.end(), observe.begin(), observe.end());
    auto const images = copy_into(to, from, outputs, leaf);
    m.rate.assign(images.begin(), images.begin() + rates);
    m.observe.assign(images.begin() + rates, images.end());
}

/// Makes the states that rest numbers.
inline void fold_resting_states(bound_model& m, std::size_t inputs, region_of_runs const& runs) {
    // Inputs that change may be anything, as far as is looked here.
    std::vector<interval> const any(inputs, interval_traits<interval>::entire());
    auto const rests = resting_states(m.g, m.rate, {{}, runs.starts, runs.parameters, box(any)});
    if (std::find(rests.begin(), rests.end(), true) == rests.end()) return;
    auto const leaf = [&](node const& n, graph& to) {
        auto const i = static_cast<std::size_t>(n.index);
        if (n.op != operation::state || !rests[i]) return to.leaf(n.op, i);
        return to.constant(runs.starts[i].lower());
    };
    graph folded;
    copy_outputs(m, folded, m.g, m.rate, m.observe, leaf);
    for (std::size_t i = 0; i < rests.size(); ++i) {
        if (rests[i]) m.rate[i] = folded.constant(0.0);
    }
    m.g = std::move(folded);
}

/// @throws std::invalid_argument
inline void require_bindable(recorded_model const& model, std::vector<signal> const& inputs) {
    auto const& about = model.about;
    if (inputs.size() != about.inputs.size()) {
        throw std::invalid_argument("model '" + about.name + "' has " +
                                    std::to_string(about.inputs.size()) + " inputs, but " +
                                    std::to_string(inputs.size()) + " signals were given");
    }
    if (model.has_memory()) {
        throw std::invalid_argument(
            "model '" + about.name +
            "' has delays, plays or rate limits; fix them and change the signals first");
    }
}

/// The values of all constants, as far as they are no unknowns.
inline std::vector<literal> values_of_constants(model_description const& about,
                                                parameter_choice const& choice) {
    std::vector<literal> values;
    for (auto const& c : about.constants) values.push_back(c.nominal);
    for (auto const& [name, value] : choice.fixed) {
        if (is_empty(value)) throw std::invalid_argument("constant '" + name + "' has no value");
        values[index_of(about.constants, name, "constant")] = literal{value, mid(value)};
    }
    return values;
}

/// By states, parameters and uncertain inputs.
inline void add_derivatives(bound_model& m) {
    auto const leaves = [&m](operation op, std::size_t count) {
        std::vector<node_id> result;
        for (std::size_t i = 0; i < count; ++i) result.push_back(m.g.leaf(op, i));
        return result;
    };
    auto const x = leaves(operation::state, m.state_count());
    auto const p = leaves(operation::constant, m.parameter_count());
    m.rate_dx = differentiate(m.g, m.rate, x);
    m.rate_dp = differentiate(m.g, m.rate, p);
    m.observe_dx = differentiate(m.g, m.observe, x);
    m.observe_dp = differentiate(m.g, m.observe, p);
    std::vector<node_id> u;
    for (auto const i : m.uncertain) u.push_back(m.g.leaf(operation::input, i));
    if (!u.empty()) m.rate_du = differentiate(m.g, m.rate, u);
}

} // namespace model_detail

SIVID_DECL bound_model bind(recorded_model const& model, parameter_choice const& choice,
                            std::vector<signal> const& inputs,
                            std::optional<region_of_runs> const& runs) {
    auto const& about = model.about;
    model_detail::require_bindable(model, inputs);
    bound_model result;
    result.about = about;
    std::vector<int> position(about.constants.size(), -1);
    for (auto const& name : choice.unknown) {
        auto const k = index_of(about.constants, name, "constant");
        if (position[k] >= 0) throw std::invalid_argument("parameter '" + name + "' stands twice");
        position[k] = static_cast<int>(result.parameters.size());
        result.parameters.push_back(k);
    }
    auto const values = model_detail::values_of_constants(about, choice);
    std::vector<std::optional<double>> only(inputs.size());
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        if (runs) only[i] = model_detail::only_value(inputs[i]);
        if (!only[i] && std::holds_alternative<sampled_signal>(inputs[i]))
            result.sampled.push_back(i);
        if (is_uncertain(inputs[i])) result.uncertain.push_back(i);
    }

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
            if (only[k]) return to.constant(*only[k]);
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
    model_detail::copy_outputs(result, g, model.g, model.rate, model.observe, leaf);
    if (model.stated && !runs) {
        auto& stated = result.stated.emplace();
        for (auto const& row : model.stated->mass)
            stated.mass.push_back(copy_into(g, model.g, row, leaf));
        stated.force = copy_into(g, model.g, model.stated->force, leaf);
    }
    if (runs) model_detail::fold_resting_states(result, inputs.size(), *runs);
    model_detail::add_derivatives(result);
    return result;
}

} // namespace sivid

#endif
