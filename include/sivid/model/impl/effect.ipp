// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_IMPL_EFFECT_IPP
#define SIVID_MODEL_IMPL_EFFECT_IPP

#include <sivid/model/change/copy_equations.hpp>
#include <sivid/model/effect.hpp>
#include <sivid/model/unit.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

namespace detail {
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

SIVID_DECL std::string effect_parameter::unit_in(model_description const& about) const {
    if (time_power == 0) return unit;
    return sivid::unit(unit).times(sivid::unit(about.time_unit), time_power).text();
}

SIVID_DECL effect model_detail::seen_effect(model_description const& about,
                                            std::vector<effect> const& beside, int order) {
    effect seen;
    seen.order = order;
    seen.name = model_detail::unused_name("seen", [&](std::string const& name) {
        auto const has = [&name](auto const& item) { return item.name == name; };
        return std::any_of(beside.begin(), beside.end(), has) ||
               std::any_of(about.inputs.begin(), about.inputs.end(), has);
    });
    seen.on_inputs = [about, name = seen.name](effect_scope& m) {
        auto const show = [&](std::string const& what, expression const& value) {
            (void)m.add_state(name + " " + what, "1", 1, expression(0));
            m.rate(name + " " + what) = value;
        };
        for (auto const& u : about.inputs) show("input " + u.name, m.input(u.name));
        for (auto const& c : about.constants) show("constant " + c.name, m.constant(c.name));
        show("time", m.time());
    };
    return seen;
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
    before.push_back(model_detail::seen_effect(base.about, before, effects[which].order));
    auto const changed = with(base, before);
    auto const k = index_of(base.about.inputs, input, "input");
    auto const& g = changed.g;
    auto const is_it = [&](node_id i) {
        return g[i].op == operation::input && static_cast<std::size_t>(g[i].index) == k;
    };
    auto const first = // of what is seen: inputs, constants, the time
        changed.rate.size() - base.about.inputs.size() - base.about.constants.size() - 1;
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

SIVID_DECL recorded_model with(recorded_model const& base, std::vector<effect> effects) {
    require_distinct(base.about, effects);
    std::stable_sort(effects.begin(), effects.end(),
                     [](effect const& a, effect const& b) { return a.order < b.order; });
    std::vector<bool> const none(effects.size(), false);
    auto unseen = none;
    auto result = effect_scope::join(base, effects, unseen);
    return unseen == none ? result : effect_scope::join(base, effects, unseen);
}

namespace detail {
/// The constants and inputs that effects bring with them.
/// @returns the first constant of each effect
inline std::vector<std::size_t> add_names(recorded_model& to, std::vector<effect> const& effects) {
    std::vector<std::size_t> first;
    auto& constants = to.about.constants;
    for (auto const& e : effects) {
        first.push_back(constants.size());
        for (auto const& p : e.parameters) {
            constants.push_back({e.name + "." + p.name, p.unit_in(to.about),
                                 literal{enclose(p.neutral), nearest(p.neutral)}});
        }
        if (!e.only_in.empty()) to.about.inputs.push_back({e.name, "1"});
        if (e.wraps) to.about.inputs.push_back({e.name + ".wraps", "1"});
    }
    return first;
}
} // namespace detail

/// Where its switch is 0 an effect sees its neutral values. With these a state of its own may have
/// no rate (a lag of no time), so it goes on by others there, and nothing sees it; by the same ones
/// where it is seen for a time.
SIVID_DECL void effect_scope::switch_parameters(std::vector<effect> const& effects,
                                                std::vector<std::size_t> const& first,
                                                std::vector<bool> const& unseen) {
    for (std::size_t k = 0; k < effects.size(); ++k) {
        auto const& e = effects[k];
        if (e.only_in.empty() || (unseen[k] && e.changes_within())) continue;
        auto const& on = input(e.name);
        for (std::size_t j = 0; j < e.parameters.size(); ++j) {
            auto const value = unseen[k] ? detail::farther_end(e.parameters[j])
                                         : model_->about.constants[first[k] + j].nominal;
            expression const off(model_->g, model_->g.constant(value));
            auto& seen = constants_[first[k] + j];
            seen = off + on * (seen - off);
        }
    }
}

SIVID_DECL void effect_scope::apply(effect const& e, effect::edit const& edit,
                                    std::size_t first_parameter,
                                    std::vector<bool>::reference unseen) {
    begin(e, first_parameter);
    if (!edit) return;
    auto const before = *this;
    edit(*this);
    auto const on = switch_of_effect();
    if (on && (unseen || e.may_leave_traces())) keep_where(before.inputs_[*on], before);
    bool const remembers =
        states_.size() > before.states_.size() || inputs_.size() > before.inputs_.size();
    if (on && remembers) unseen = true;
}

/// The model itself, on the time, the inputs and the constants that the effects left.
SIVID_DECL void effect_scope::copy_model(recorded_model const& base) {
    auto& to = *model_;
    auto const own = std::move(to.added_states); // of effects
    copy_equations(to, base, [&](node const& n, graph& g) {
        auto const k = static_cast<std::size_t>(n.index);
        if (n.op == operation::constant) return constants_[k].in(g);
        if (n.op == operation::input) return inputs_[k].in(g);
        if (n.op == operation::time) return time_.in(g);
        return same_leaf{}(n, g);
    });
    for (std::size_t i = 0; i < base.rate.size(); ++i) rates_[i] = expression(to.g, to.rate[i]);
    for (auto const y : to.observe) channels_.emplace_back(to.g, y);
    to.added_states.insert(to.added_states.begin(), own.begin(), own.end());
    // Relations between constants stay as they are: an effect that alters D alters what the
    // equations see of D, and A = pi D^2/4 only if it says so.
    for (auto const& d : base.derived)
        to.derived.push_back(
            {d.constant, copy_into(to.g, base.g, {d.value}, same_leaf{}).front(), d.always});
}

/// @param stated  the constants, before any effect changed what is seen of them
/// @throws std::invalid_argument  see `with`
SIVID_DECL void effect_scope::require_memories(std::vector<expression> const& stated) const {
    auto& model = *model_;
    for (auto const* all : {&model.input_memory, &model.channel_delays})
        for (auto const& m : *all)
            if (constants_[m.constant].in(model.g) != stated[m.constant].in(model.g))
                throw std::invalid_argument("effect: '" + model.about.constants[m.constant].name +
                                            "' is a delay or a play: it must stay as it is");
}

/// @throws std::invalid_argument  see `with`
SIVID_DECL void effect_scope::require_starts_and_copies(recorded_model const& base) const {
    auto const& model = *model_;
    for (auto const& a : model.added_states)
        if ((model.g.depends(a.at_begin) & (on_state | on_time)) != 0)
            throw std::invalid_argument("effect: the initial value of state '" +
                                        model.about.states[a.state].name +
                                        "' may depend on inputs and constants only");
    for (auto const& c : base.input_copies) {
        auto const by = named_by_.find(c.of);
        if (by == named_by_.end() || named_by_.count(c.copy) != 0) continue;
        throw std::invalid_argument("effect '" + by->second + "': the model goes over from '" +
                                    base.about.inputs[c.of].name + "' to '" +
                                    base.about.inputs[c.copy].name +
                                    "', which the effect leaves as it is; join both effects at "
                                    "once");
    }
}

SIVID_DECL recorded_model effect_scope::join(recorded_model const& base,
                                             std::vector<effect> const& effects,
                                             std::vector<bool>& unseen) {
    recorded_model result;
    result.about = base.about;
    result.input_memory = base.input_memory;
    result.channel_delays = base.channel_delays;
    result.input_copies = base.input_copies;
    auto const first = detail::add_names(result, effects);
    effect_scope scope(result);
    scope.switch_parameters(effects, first, unseen);
    auto const apply_all = [&](effect::edit effect::*stage) {
        for (std::size_t k = 0; k < effects.size(); ++k)
            scope.apply(effects[k], effects[k].*stage, first[k], unseen[k]);
    };
    auto const stated = scope.constants_;
    apply_all(&effect::on_inputs);
    scope.copy_model(base);
    auto const copied = result.rate;
    apply_all(&effect::on_rates);
    apply_all(&effect::on_channels);
    auto& g = result.g;
    result.rate.clear();
    result.observe.clear();
    for (auto const& e : scope.rates_) result.rate.push_back(e.in(g));
    if (result.rate != copied) result.stated.reset();
    for (auto const& e : scope.channels_) result.observe.push_back(e.in(g));
    scope.require_memories(stated);
    start_behind_others(result);
    scope.require_starts_and_copies(base);
    model_detail::require_own_names(result.about);
    return result;
}

} // namespace sivid

#endif
