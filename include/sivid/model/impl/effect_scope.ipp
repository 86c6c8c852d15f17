// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_IMPL_EFFECT_SCOPE_IPP
#define SIVID_MODEL_IMPL_EFFECT_SCOPE_IPP

#include <sivid/model/effect.hpp>

#include <sivid/compiled.hpp>

#include <cstddef>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace sivid {

namespace detail {
/// Nothing is early, and no play is narrower than none.
inline void require_size(effect const& e, std::size_t k) {
    auto const& p = e.parameters.at(k);
    if (p.prior().lower() < 0)
        throw std::invalid_argument("effect '" + e.name + "': the prior of " + p.name +
                                    " goes below 0; give one that begins at 0");
}
} // namespace detail

SIVID_DECL expression const& effect_scope::parameter(std::size_t k) const {
    return constants_.at(first_parameter_ + k);
}

SIVID_DECL expression const& effect_scope::state(std::string const& name) const {
    return states_[index_of(model_->about.states, name, "state")];
}

SIVID_DECL expression& effect_scope::constant(std::string const& name) {
    return constants_[index_of(model_->about.constants, name, "constant")];
}

SIVID_DECL expression& effect_scope::input(std::string const& name) {
    auto const i = index_of(model_->about.inputs, name, "input");
    note(i);
    return inputs_[i];
}

SIVID_DECL void effect_scope::note(std::size_t input) const {
    if (effect_ != nullptr) named_by_.emplace(input, effect_->name);
}

SIVID_DECL expression const& effect_scope::named(std::string const& name) const {
    if (name == "t") return time_;
    auto const find = [&name](auto const& list, std::vector<expression> const& values) {
        for (std::size_t i = 0; i < list.size(); ++i)
            if (list[i].name == name) return &values[i];
        return static_cast<expression const*>(nullptr);
    };
    auto const& about = model_->about;
    if (auto const* x = find(about.states, states_)) return *x;
    if (auto const* u = find(about.inputs, inputs_)) {
        note(static_cast<std::size_t>(u - inputs_.data()));
        return *u;
    }
    if (auto const* c = find(about.constants, constants_)) return *c;
    std::string known = "t";
    auto const tell = [&known](auto const& list) {
        for (auto const& x : list) known += ", " + std::string(x.name);
    };
    tell(about.states);
    tell(about.inputs);
    tell(about.constants);
    throw std::invalid_argument("effect: the model has no '" + name + "'; known: " + known);
}

SIVID_DECL expression& effect_scope::rate(std::string const& state) {
    return rates_[index_of(model_->about.states, state, "state")];
}

SIVID_DECL expression& effect_scope::channel(std::string const& name) {
    return channels_[index_of(model_->about.channels, name, "channel")];
}

SIVID_DECL void effect_scope::begin(effect const& e, std::size_t first_parameter) {
    effect_ = &e;
    first_parameter_ = first_parameter;
}

SIVID_DECL std::optional<std::size_t> effect_scope::switch_of_effect() const {
    if (effect_ == nullptr || effect_->only_in.empty()) return std::nullopt;
    return index_of(model_->about.inputs, effect_->name, "input");
}

SIVID_DECL void effect_scope::keep_where(expression const& on, effect_scope const& before) {
    auto& g = model_->g;
    auto const keep = [&](expression& now, expression const& old) {
        if (now.in(g) != old.in(g)) now = on * now + (1 - on) * old;
    };
    auto const keep_all = [&](std::vector<expression>& now, std::vector<expression> const& old) {
        for (std::size_t i = 0; i < old.size(); ++i) keep(now[i], old[i]);
    };
    keep(time_, before.time_);
    keep_all(constants_, before.constants_);
    keep_all(inputs_, before.inputs_);
    for (std::size_t i = 0; i < before.rates_.size(); ++i)
        if (owners_[i] != effect_) keep(rates_[i], before.rates_[i]); // its own ones go on
    keep_all(channels_, before.channels_);
}

SIVID_DECL std::vector<std::size_t> effect_scope::with_copies(std::size_t input) const {
    std::vector<std::size_t> all{input};
    for (auto const& c : model_->input_copies)
        if (c.of == input) all.push_back(c.copy);
    return all;
}

SIVID_DECL void effect_scope::remember(std::string const& input, memory_kind kind, std::size_t k) {
    detail::require_size(*effect_, k);
    auto const of = index_of(model_->about.inputs, input, "input");
    auto const constant = first_parameter_ + k;
    if (!effect_->changes_within()) {
        for (auto const i : with_copies(of))
            model_->input_memory.push_back({i, constant, kind, switch_of_effect()});
        return;
    }
    // Each that the model may see has a copy behind this memory, which takes its place.
    note(of);
    auto& inputs = model_->about.inputs;
    std::vector<std::size_t> seen_as(inputs.size());
    std::iota(seen_as.begin(), seen_as.end(), std::size_t{0});
    for (auto const i : with_copies(of)) {
        auto const copy = seen_as[i] = inputs.size();
        inputs.push_back({effect_->name + "." + inputs[i].name, inputs[i].unit});
        model_->input_copies.push_back({copy, of});
        inputs_.push_back(leaf(operation::input, copy));
        for (auto const& m : std::vector(model_->input_memory))
            if (m.index == i) model_->input_memory.push_back({copy, m.constant, m.kind, m.only_if});
        model_->input_memory.push_back({copy, constant, kind, {}});
    }
    auto& seen = inputs_[of];
    auto const before = model_->g;
    auto const image =
        copy_into(model_->g, before, {seen.in(model_->g)}, [&](auto const& n, graph& g) {
            auto const index = static_cast<std::size_t>(n.index);
            return g.leaf(n.op, n.op == operation::input ? seen_as.at(index) : index);
        });
    seen = expression(model_->g, image.front());
}

SIVID_DECL void effect_scope::show_late(std::string const& channel, memory_kind kind,
                                        std::size_t k) {
    if (!is_dead_time(kind))
        throw std::invalid_argument("effect '" + effect_->name + "': the channel '" + channel +
                                    "' can be late, and have no play and no rate limit");
    detail::require_size(*effect_, k);
    model_->channel_delays.push_back({index_of(model_->about.channels, channel, "channel"),
                                      first_parameter_ + k, kind, switch_of_effect()});
}

SIVID_DECL void effect_scope::lag_channel(std::string const& name, std::size_t k) {
    auto const y = index_of(model_->about.channels, name, "channel");
    auto const shown = channels_[y].in(model_->g);
    if (model_->g[shown].op != operation::state) {
        throw std::invalid_argument("effect '" + effect_->name + "': the channel '" + name +
                                    "' shows no state as it is, and cannot lag");
    }
    auto const i = static_cast<std::size_t>(model_->g[shown].index);
    auto const own = model_->about.states[i];
    auto const behind = effect_->name + "." + name;
    auto const w = add_state(behind, own.unit, 2 * own.limit, expression(0));
    rate(behind) = rates_[i] - w / parameter(k);
    channels_[y] -= w;
}

SIVID_DECL expression effect_scope::add_state(std::string const& name, std::string const& unit,
                                              state_range limit,
                                              std::optional<expression> const& at_begin) {
    auto const k = model_->about.states.size();
    for (auto const& s : model_->about.states)
        if (s.name == name)
            throw std::invalid_argument("effect: the model has a state '" + name + "'");
    model_->about.states.push_back({name, unit, limit, {}});
    if (at_begin) model_->added_states.push_back({k, at_begin->in(model_->g)});
    states_.emplace_back(model_->g, model_->g.leaf(operation::state, k));
    rates_.emplace_back(0.0);
    owners_.push_back(effect_);
    return states_.back();
}

SIVID_DECL effect_scope::effect_scope(recorded_model& model)
    : model_(&model), time_(leaf(operation::time, 0)) {
    auto const leaves = [this](operation op, std::size_t count, std::vector<expression>& to) {
        for (std::size_t i = 0; i < count; ++i) to.push_back(leaf(op, i));
    };
    leaves(operation::state, model.about.states.size(), states_);
    leaves(operation::constant, model.about.constants.size(), constants_);
    leaves(operation::input, model.about.inputs.size(), inputs_);
    rates_.resize(states_.size());
    owners_.resize(states_.size(), nullptr);
}

} // namespace sivid

#endif
