// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_IMPL_EFFECT_IPP
#define SIVID_MODEL_IMPL_EFFECT_IPP

#include <sivid/model/change/copy_equations.hpp>
#include <sivid/model/effect.hpp>

#include <array>
#include <charconv>
#include <numeric>
#include <string_view>

namespace sivid {

namespace detail {
/// A time as people write it, which reads back as the same double.
inline std::string time_text(double t) {
    std::array<char, 400> text{};
    auto const end =
        std::to_chars(text.data(), text.data() + text.size(), t, std::chars_format::fixed);
    return {text.data(), end.ptr};
}

/// The end of a prior that is farther from 0.
inline literal farther_end(effect_parameter const& p) {
    auto const& end = std::abs(nearest(p.upper)) < std::abs(nearest(p.lower)) ? p.lower : p.upper;
    return literal{enclose(end), nearest(end)};
}
} // namespace detail

SIVID_DECL interval effect_parameter::prior() const {
    using traits = interval_traits<interval>;
    auto const out = traits::point(widened), in = traits::point(1 / widened);
    auto const moved = [&](decimal end, decimal other) {
        auto const x = enclose(end);
        double const at = nearest(end);
        if (at == 0 || at == nearest(neutral) || at == nearest(other)) return x;
        bool const grows = (at < 0) == (at < nearest(other));
        return traits::mul(x, grows ? out : in);
    };
    return hull(moved(lower, upper), moved(upper, lower));
}

SIVID_DECL bool finds_as_recorded(recorded_model const& base, std::vector<effect> const& effects,
                                  std::size_t which, std::string const& input) {
    std::vector<effect> before;
    for (std::size_t i = 0; i < effects.size(); ++i) {
        auto const& other = effects[i];
        if (i != which && other.on_inputs && other.order <= effects[which].order) {
            before.push_back(other);
        }
    }
    // States whose rates are the input as it stands after them, and all that may depend on it.
    effect seen;
    seen.name = "seen";
    seen.order = effects[which].order;
    seen.on_inputs = [&](effect_scope& m) {
        auto const show = [&m](std::string const& name, expression const& value) {
            (void)m.add_state("seen " + name, "1", 1, expression(0));
            m.rate("seen " + name) = value;
        };
        for (auto const& u : base.about.inputs) show(u.name, m.input(u.name));
        for (auto const& c : base.about.constants) show(c.name, m.constant(c.name));
    };
    before.push_back(seen);
    auto const changed = with(base, before);
    auto const k = index_of(base.about.inputs, input, "input");
    auto const& g = changed.g;
    auto const is_it = [&](node_id i) {
        return g[i].op == operation::input && static_cast<std::size_t>(g[i].index) == k;
    };
    auto const first = changed.rate.size() - base.about.inputs.size() - base.about.constants.size();
    if (!is_it(changed.rate[first + k])) return false;
    std::vector<node_id> others; // added states of effects, too
    for (auto i = base.rate.size(); i < changed.rate.size(); ++i)
        if (i != first + k) others.push_back(changed.rate[i]);
    for (auto const& added : changed.added_states) others.push_back(added.at_begin);
    auto const read = operands_of(g, others);
    for (std::size_t i = 0; i < read.size(); ++i)
        if (read[i] && is_it(static_cast<node_id>(i))) return false;
    return std::none_of(changed.input_memory.begin(), changed.input_memory.end(),
                        [k](auto const& m) { return m.index == k; });
}

SIVID_DECL effect widened(effect e) {
    e.name += detail::wider;
    if (!e.about.empty()) e.about += ", beyond the prior that was stated";
    for (auto& p : e.parameters) p.widened *= 4;
    return e;
}

SIVID_DECL effect only_within(effect e, std::vector<std::string> experiments,
                              std::vector<double> since, std::vector<double> until) {
    std::string names;
    for (std::size_t k = 0; k < experiments.size(); ++k) {
        names += (names.empty() ? "@" : "+") + experiments[k];
        if (k < since.size() && since[k] > effect::from_start)
            names += ">=" + detail::time_text(since[k]);
        if (k < until.size() && until[k] < effect::for_ever)
            names += "<" + detail::time_text(until[k]);
    }
    e.name += names;
    e.only_in = std::move(experiments);
    e.since = std::move(since);
    e.until = std::move(until);
    return e;
}

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
    return inputs_[index_of(model_->about.inputs, name, "input")];
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
    if (auto const* u = find(about.inputs, inputs_)) return *u;
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

SIVID_DECL void effect_scope::remember(std::string const& input, std::size_t k, memory_kind kind) {
    auto const of = index_of(model_->about.inputs, input, "input");
    auto const constant = first_parameter_ + k;
    if (!effect_->changes_within()) {
        for (auto const i : with_copies(of))
            model_->input_memory.push_back({i, constant, kind, switch_of_effect()});
        return;
    }
    // Each that the model may see has a copy behind this memory, which takes its place.
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

SIVID_DECL void effect_scope::delay_input(std::string const& name, std::size_t k) {
    remember(name, k, memory_kind::delay);
}

SIVID_DECL void effect_scope::play_input(std::string const& name, std::size_t k) {
    remember(name, k, memory_kind::play);
}

SIVID_DECL void effect_scope::limit_input_rate(std::string const& name, std::size_t k) {
    remember(name, k, memory_kind::rate_limit);
}

SIVID_DECL void effect_scope::slow_input_clock(std::string const& name, std::size_t k) {
    remember(name, k, memory_kind::drift);
}

SIVID_DECL void effect_scope::show_late(std::string const& channel, std::size_t k,
                                        memory_kind kind) {
    model_->channel_delays.push_back({index_of(model_->about.channels, channel, "channel"),
                                      first_parameter_ + k, kind, switch_of_effect()});
}

SIVID_DECL void effect_scope::delay_channel(std::string const& name, std::size_t k) {
    show_late(name, k, memory_kind::delay);
}

SIVID_DECL void effect_scope::slow_channel_clock(std::string const& name, std::size_t k) {
    show_late(name, k, memory_kind::drift);
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
                                              double limit, expression const& at_begin) {
    auto const k = model_->about.states.size();
    for (auto const& s : model_->about.states)
        if (s.name == name)
            throw std::invalid_argument("effect: the model has a state '" + name + "'");
    model_->about.states.push_back({name, unit, limit, {}});
    model_->added_states.push_back({k, at_begin.in(model_->g)});
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

SIVID_DECL recorded_model with(recorded_model const& base, std::vector<effect> effects) {
    std::stable_sort(effects.begin(), effects.end(),
                     [](effect const& a, effect const& b) { return a.order < b.order; });
    std::vector<bool> const none(effects.size(), false);
    auto unseen = none;
    auto result = effect_scope::join(base, effects, unseen);
    return unseen == none ? result : effect_scope::join(base, effects, unseen);
}

SIVID_DECL recorded_model effect_scope::join(recorded_model const& base,
                                             std::vector<effect> const& effects,
                                             std::vector<bool>& unseen) {
    recorded_model result;
    result.about = base.about;
    result.input_memory = base.input_memory;
    result.channel_delays = base.channel_delays;
    result.input_copies = base.input_copies;
    std::vector<std::size_t> first;
    auto& constants = result.about.constants;
    for (auto const& e : effects) {
        first.push_back(constants.size());
        for (auto const& p : e.parameters) {
            auto const name = e.name + "." + p.name;
            for (auto const& c : constants)
                if (c.name == name)
                    throw std::invalid_argument("effect '" + e.name + "' stands twice");
            constants.push_back({name, p.unit, literal{enclose(p.neutral), nearest(p.neutral)}});
        }
        if (!e.only_in.empty()) result.about.inputs.push_back({e.name, "1"});
        if (e.wraps) result.about.inputs.push_back({e.name + ".wraps", "1"});
    }
    effect_scope scope(result);
    // Where its switch is 0 an effect sees its neutral values. With these a state of its own may
    // have no rate (a lag of no time), so it goes on by others there, and nothing sees it; by the
    // same ones where it is seen for a time.
    for (std::size_t k = 0; k < effects.size(); ++k) {
        auto const& e = effects[k];
        if (e.only_in.empty() || (unseen[k] && e.changes_within())) continue;
        auto const& on = scope.input(e.name);
        for (std::size_t j = 0; j < e.parameters.size(); ++j) {
            auto const value =
                unseen[k] ? detail::farther_end(e.parameters[j]) : constants[first[k] + j].nominal;
            expression const off(result.g, result.g.constant(value));
            auto& seen = scope.constants_[first[k] + j];
            seen = off + on * (seen - off);
        }
    }
    auto const apply_all = [&](effect::edit effect::*stage) {
        for (std::size_t k = 0; k < effects.size(); ++k) {
            scope.begin(effects[k], first[k]);
            if (!(effects[k].*stage)) continue;
            auto const before = scope;
            (effects[k].*stage)(scope);
            auto const on = scope.switch_of_effect();
            if (on && (unseen[k] || effects[k].may_leave_traces()))
                scope.keep_where(before.inputs_[*on], before);
            bool const remembers = scope.states_.size() > before.states_.size() ||
                                   scope.inputs_.size() > before.inputs_.size();
            if (on && remembers) unseen[k] = true;
        }
    };
    apply_all(&effect::on_inputs);
    auto memory = base.input_memory;
    memory.insert(memory.end(), base.channel_delays.begin(), base.channel_delays.end());
    for (auto const& m : memory) {
        auto const own = result.g.leaf(operation::constant, m.constant);
        if (scope.constants_[m.constant].in(result.g) == own) continue;
        throw std::invalid_argument("effect: '" + constants[m.constant].name +
                                    "' is a delay or a play: it must stay as it is");
    }

    // The model itself, on the time, the inputs and the constants that the effects left.
    auto& g = result.g;
    auto const own = std::move(result.added_states); // of effects
    copy_equations(result, base, [&](node const& n, graph& to) {
        auto const k = static_cast<std::size_t>(n.index);
        if (n.op == operation::constant) return scope.constants_[k].in(to);
        if (n.op == operation::input) return scope.inputs_[k].in(to);
        if (n.op == operation::time) return scope.time_.in(to);
        return to.leaf(n.op, k);
    });
    for (std::size_t i = 0; i < base.rate.size(); ++i)
        scope.rates_[i] = expression(g, result.rate[i]);
    for (auto const y : result.observe) scope.channels_.emplace_back(g, y);
    result.added_states.insert(result.added_states.begin(), own.begin(), own.end());
    // Relations between constants stay as they are: an effect that alters D alters what the
    // equations see of D, and A = pi D^2/4 only if it says so.
    auto const itself = [](node const& n, graph& to) {
        return to.leaf(n.op, static_cast<std::size_t>(n.index));
    };
    for (auto const& d : base.derived)
        result.derived.push_back(
            {d.constant, copy_into(g, base.g, {d.value}, itself).front(), d.always});
    auto const copied = result.rate;
    apply_all(&effect::on_rates);
    apply_all(&effect::on_channels);
    result.rate.clear();
    result.observe.clear();
    for (auto const& e : scope.rates_) result.rate.push_back(e.in(g));
    if (result.rate != copied) result.stated.reset();
    for (auto const& e : scope.channels_) result.observe.push_back(e.in(g));
    for (auto const& a : result.added_states)
        if ((g.depends(a.at_begin) & (on_state | on_time)) != 0)
            throw std::invalid_argument("effect: the initial value of state '" +
                                        result.about.states[a.state].name +
                                        "' may depend on inputs and constants only");
    return result;
}

} // namespace sivid

#endif
