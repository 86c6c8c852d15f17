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
    auto outputs = m.rate;
    outputs.insert(outputs.end(), m.observe.begin(), m.observe.end());
    graph folded;
    auto const images = copy_into(folded, m.g, outputs, leaf);
    auto const split = images.begin() + static_cast<std::ptrdiff_t>(m.rate.size());
    m.rate.assign(images.begin(), split);
    m.observe.assign(split, images.end());
    for (std::size_t i = 0; i < rests.size(); ++i) {
        if (rests[i]) m.rate[i] = folded.constant(0.0);
    }
    m.g = std::move(folded);
}

} // namespace model_detail

SIVID_DECL bound_model bind(recorded_model const& model, parameter_choice const& choice,
                            std::vector<signal> const& inputs,
                            std::optional<region_of_runs> const& runs) {
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
    std::vector<std::optional<double>> only(inputs.size());
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        if (runs) only[i] = model_detail::only_value(inputs[i]);
        if (!only[i] && std::holds_alternative<sampled_signal>(inputs[i]))
            result.sampled.push_back(i);
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
    auto const images = copy_into(g, model.g, outputs, leaf);
    auto const split = images.begin() + static_cast<std::ptrdiff_t>(model.rate.size());
    result.rate.assign(images.begin(), split);
    result.observe.assign(split, images.end());
    if (model.stated && !runs) {
        auto& stated = result.stated.emplace();
        for (auto const& row : model.stated->mass)
            stated.mass.push_back(copy_into(g, model.g, row, leaf));
        stated.force = copy_into(g, model.g, model.stated->force, leaf);
    }
    if (runs) model_detail::fold_resting_states(result, inputs.size(), *runs);

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

} // namespace sivid

#endif
