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
            constants.push_back({e.name + "." + p.name, p.unit_in(base.about),
                                 literal{enclose(p.neutral), nearest(p.neutral)}});
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
    auto const stated = scope.constants_;
    apply_all(&effect::on_inputs);

    // The model itself, on the time, the inputs and the constants that the effects left.
    auto& g = result.g;
    auto const own = std::move(result.added_states); // of effects
    copy_equations(result, base, [&](node const& n, graph& to) {
        auto const k = static_cast<std::size_t>(n.index);
        if (n.op == operation::constant) return scope.constants_[k].in(to);
        if (n.op == operation::input) return scope.inputs_[k].in(to);
        if (n.op == operation::time) return scope.time_.in(to);
        return same_leaf{}(n, to);
    });
    for (std::size_t i = 0; i < base.rate.size(); ++i)
        scope.rates_[i] = expression(g, result.rate[i]);
    for (auto const y : result.observe) scope.channels_.emplace_back(g, y);
    result.added_states.insert(result.added_states.begin(), own.begin(), own.end());
    // Relations between constants stay as they are: an effect that alters D alters what the
    // equations see of D, and A = pi D^2/4 only if it says so.
    for (auto const& d : base.derived)
        result.derived.push_back(
            {d.constant, copy_into(g, base.g, {d.value}, same_leaf{}).front(), d.always});
    auto const copied = result.rate;
    apply_all(&effect::on_rates);
    apply_all(&effect::on_channels);
    result.rate.clear();
    result.observe.clear();
    for (auto const& e : scope.rates_) result.rate.push_back(e.in(g));
    if (result.rate != copied) result.stated.reset();
    for (auto const& e : scope.channels_) result.observe.push_back(e.in(g));
    for (auto const* all : {&result.input_memory, &result.channel_delays})
        for (auto const& m : *all)
            if (scope.constants_[m.constant].in(g) != stated[m.constant].in(g))
                throw std::invalid_argument("effect: '" + constants[m.constant].name +
                                            "' is a delay or a play: it must stay as it is");
    start_behind_others(result);
    for (auto const& a : result.added_states)
        if ((g.depends(a.at_begin) & (on_state | on_time)) != 0)
            throw std::invalid_argument("effect: the initial value of state '" +
                                        result.about.states[a.state].name +
                                        "' may depend on inputs and constants only");
    for (auto const& c : base.input_copies) {
        auto const by = scope.named_by_.find(c.of);
        if (by == scope.named_by_.end() || scope.named_by_.count(c.copy) != 0) continue;
        throw std::invalid_argument("effect '" + by->second + "': the model goes over from '" +
                                    base.about.inputs[c.of].name + "' to '" +
                                    base.about.inputs[c.copy].name +
                                    "', which the effect leaves as it is; join both effects at "
                                    "once");
    }
    model_detail::require_own_names(result.about);
    return result;
}

} // namespace sivid

#endif
