// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_IMPL_CLOSED_LOOP_IPP
#define SIVID_MODEL_IMPL_CLOSED_LOOP_IPP

#include <sivid/model/closed_loop.hpp>
#include <sivid/model/unit.hpp>

#include <sivid/compiled.hpp>
#include <sivid/model/change/added_start.hpp>
#include <sivid/model/change/copy_equations.hpp>
#include <sivid/model/graph/differentiate.hpp>
#include <sivid/model/graph/rewrite.hpp>
#include <sivid/number/rounding.hpp>
#include <sivid/number/text/nearest_text.hpp>
#include <sivid/number/text/needed_given.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace sivid {

namespace model_detail {

/// The derivative in time of a function of states, constants and the time along the motion; its
/// inputs are errors that do not change.
inline node_id rate_of(recorded_model& m, node_id value,
                       std::map<std::size_t, double> const& errors) {
    using traits = interval_traits<interval>;
    std::vector<node_id> wrt;
    for (std::size_t i = 0; i < m.rate.size(); ++i) wrt.push_back(m.g.leaf(operation::state, i));
    wrt.push_back(m.g.leaf(operation::time, 0));
    auto const along = differentiate(m.g, {value}, wrt).front();
    // A sample's error need not be the one of the sample that acts now.
    graph const before = m.g;
    auto const slope = copy_into(m.g, before, along, [&](node const& n, graph& g) {
        auto const k = static_cast<std::size_t>(n.index);
        if (n.op != operation::input) return g.leaf(n.op, k);
        double const e = errors.at(k);
        return g.constant(literal{traits::bounds(-e, e), 0.0});
    });
    auto sum = slope.back();
    for (std::size_t i = 0; i < m.rate.size(); ++i)
        sum = m.g.add(sum, m.g.mul(slope[i], m.rate[i]));
    return sum;
}

/// Adds a channel, under another name where that one is taken.
/// @returns  its name
inline std::string add_channel(recorded_model& m, std::string name, std::string const& more,
                               std::string const& unit, node_id value) {
    auto& channels = m.about.channels;
    auto const taken = [&](auto const& c) { return c.name == name; };
    while (std::any_of(channels.begin(), channels.end(), taken)) name += more;
    channels.push_back({name, unit});
    m.observe.push_back(value);
    return name;
}

} // namespace model_detail

SIVID_DECL std::vector<signal> closed_model::inputs(std::vector<signal> const& open) const {
    std::vector<signal> result;
    for (auto const i : kept_inputs) {
        if (i >= open.size())
            throw std::invalid_argument("closed_model: one signal per input is needed" +
                                        needed_given(i + 1, open.size()));
        result.push_back(open[i]);
    }
    result.insert(result.end(), own_inputs.begin(), own_inputs.end());
    return result;
}

SIVID_DECL box closed_model::initial(box const& open, std::vector<signal> const& inputs,
                                     std::vector<interval> const& constants) const {
    using traits = interval_traits<interval>;
    auto const states = model.about.states.size();
    if (open.size() + own_states != states)
        throw std::invalid_argument("closed_model: the start needs one side per state" +
                                    needed_given(states - own_states, open.size()));
    box result(states);
    for (std::size_t i = 0; i < states; ++i)
        result[i] = i < open.size() ? open[i] : traits::point(0.0);
    for (auto const& a : starts) result[a.state] = traits::entire(); // not known yet
    for (auto const& a : starts) result[a.state] = start_of(model, a, constants, inputs, 0, result);
    return result;
}

SIVID_DECL closed_loop::closed_loop(recorded_model open)
    : open_(std::move(open)),
      states_(open_.about.states.size()),
      inputs_(open_.about.inputs.size()) {
    open_.stated.reset(); // a law adds states
}

SIVID_DECL closed_loop::~closed_loop() = default;

SIVID_DECL expression closed_loop::time() { return leaf(operation::time, 0); }

SIVID_DECL expression closed_loop::state(std::string_view name) {
    return leaf(operation::state, index_of(open_.about.states, std::string(name), "state"));
}

SIVID_DECL expression closed_loop::constant(std::string_view name) {
    return leaf(operation::constant,
                index_of(open_.about.constants, std::string(name), "constant"));
}

SIVID_DECL expression closed_loop::input(std::string_view name) {
    return leaf(operation::input, index_of(open_.about.inputs, std::string(name), "input"));
}

SIVID_DECL void closed_loop::sensor(std::string_view channel, double bound) {
    auto const c = index_of(open_.about.channels, std::string(channel), "channel");
    if (!(bound >= 0) || !std::isfinite(bound))
        throw std::invalid_argument("the error bound of the sensor '" + std::string(channel) +
                                    "' must be 0 or more and finite");
    if (shown_.count(c) != 0)
        throw std::invalid_argument("the sensor '" + std::string(channel) +
                                    "' was read before its error bound was said");
    bounds_[c] = bound;
}

SIVID_DECL expression closed_loop::measured(std::string_view channel) {
    auto const c = index_of(open_.about.channels, std::string(channel), "channel");
    auto const known = shown_.find(c);
    if (known != shown_.end()) return known->second;
    expression value(open_.g, open_.observe[c]);
    auto const bound = bounds_.find(c);
    if (bound != bounds_.end() && bound->second > 0)
        value = value + add_input(std::string(channel) + ".error", open_.about.channels[c].unit,
                                  sampled_signal({0}, {0}, interpolation::hold, {bound->second}));
    shown_.emplace(c, value);
    return value;
}

SIVID_DECL bool closed_loop::reads(std::string_view channel) const {
    return shown_.count(index_of(open_.about.channels, std::string(channel), "channel")) != 0;
}

SIVID_DECL expression closed_loop::gain(std::string const& name, std::string const& unit,
                                        decimal nominal) {
    auto const taken = [&](auto const& items) {
        return std::any_of(items.begin(), items.end(),
                           [&](auto const& i) { return i.name == name; });
    };
    auto const& about = open_.about;
    if (taken(about.constants) || taken(about.states) || taken(about.inputs) ||
        taken(about.channels) || name == "t")
        throw std::invalid_argument("the gain '" + name +
                                    "' has a name that the model uses; choose another one");
    open_.about.constants.push_back({name, unit, literal{enclose(nominal), nearest(nominal)}});
    return leaf(operation::constant, open_.about.constants.size() - 1);
}

SIVID_DECL expression closed_loop::integral(expression const& x, std::string const& name,
                                            std::string const& unit, double limit) {
    for (auto const& s : open_.about.states) {
        if (s.name == name)
            throw std::invalid_argument("control law: the model has a state '" + name + "'");
    }
    if (!(limit > 0) || !std::isfinite(limit))
        throw std::invalid_argument("control law: the integral '" + name +
                                    "' needs a finite range above 0");
    open_.rate.push_back(x.in(open_.g));
    open_.about.states.push_back({name, unit, limit, {}});
    return leaf(operation::state, open_.about.states.size() - 1);
}

SIVID_DECL expression closed_loop::during(double from, double to) {
    if (!(from >= 0) || !(from < to) || !std::isfinite(to))
        throw std::invalid_argument("control law: during needs 0 <= from < to, not from " +
                                    nearest_text(from) + " to " + nearest_text(to));
    std::vector<double> times, values;
    if (from > 0) {
        times.push_back(0);
        values.push_back(0);
    }
    times.insert(times.end(), {from, to});
    values.insert(values.end(), {1, 0});
    return add_input("switch " + std::to_string(own_inputs_.size() + 1), "1",
                     sampled_signal(std::move(times), std::move(values), interpolation::hold));
}

SIVID_DECL expression closed_loop::add_input(std::string name, std::string unit, signal u) {
    open_.about.inputs.push_back({std::move(name), std::move(unit)});
    own_inputs_.push_back(std::move(u));
    return leaf(operation::input, open_.about.inputs.size() - 1);
}

SIVID_DECL void closed_loop::sampled(double period, double delay) {
    if (!(period > 0) || !std::isfinite(period) || !(delay >= 0) || !std::isfinite(delay))
        throw std::invalid_argument("control law: it needs a sampling period above 0 and a delay "
                                    "of 0 or more, both finite");
    age_ = detail::next_up(period + delay);
}

SIVID_DECL void closed_loop::slew(std::string_view input, double limit) {
    auto const i = index_of(open_.about.inputs, std::string(input), "input");
    if (!(limit > 0) || !std::isfinite(limit))
        throw std::invalid_argument("control law: the limit of the slew of '" + std::string(input) +
                                    "' must be above 0 and finite");
    slews_[i] = limit;
}

SIVID_DECL bool closed_loop::needs_hold(std::size_t input, node_id command) const {
    if (age_ == 0) return false;
    auto const fail = [](std::string const& what, std::string const& remedy) {
        throw std::invalid_argument("control law: it is sampled and " + what + "; " + remedy);
    };
    auto const& g = open_.g;
    auto const seen = operands_of(g, {command});
    bool changes = false;
    for (std::size_t k = 0; k < seen.size(); ++k) {
        auto const& n = g.nodes()[k];
        auto const index = static_cast<std::size_t>(n.index);
        if (!seen[k]) continue;
        changes = changes || n.op == operation::state || n.op == operation::time;
        if (n.op == operation::sign)
            fail("jumps where a sign changes", "use tanh instead, or clamp");
        if (n.op == operation::state && index >= states_)
            fail("has an integral, which would be a sum", "leave one of them out");
        if (n.op != operation::input) continue;
        if (index < inputs_)
            fail("depends on the input '" + open_.about.inputs[index].name +
                     "', whose rate of change is not known",
                 "command it as well, or leave it out");
        if (!is_uncertain(own_inputs_[index - inputs_]))
            fail("switches in time", "leave during(...) out of what is sampled");
    }
    if (changes && slews_.count(input) == 0)
        fail("how fast it changes '" + open_.about.inputs[input].name + "' is not limited",
             "give a limit of its slew");
    return changes;
}

SIVID_DECL std::string closed_model::with_slews(std::string const& requirement) const {
    auto text = requirement;
    for (auto const& s : slews) {
        text +=
            " provided always(abs(measured(" + s.channel + ")) < " + nearest_text(s.limit) + ")";
    }
    return text;
}

SIVID_DECL void closed_loop::command(std::string_view input, expression const& value) {
    auto const i = index_of(open_.about.inputs, std::string(input), "input");
    if (i >= inputs_)
        throw std::invalid_argument("control law: '" + std::string(input) +
                                    "' is no input of the model");
    if (!commands_.emplace(i, value.in(open_.g)).second)
        throw std::invalid_argument("control law: '" + std::string(input) + "' is commanded twice");
}

/// The inputs that are not commanded go over to the closed model.
/// @returns the place there of each
SIVID_DECL std::vector<std::size_t> closed_loop::keep_inputs(closed_model& result) const {
    auto const& from = open_.about.inputs;
    auto& to = result.model.about.inputs;
    to.clear();
    std::vector<std::size_t> place(from.size());
    for (std::size_t i = 0; i < place.size(); ++i) {
        if (commands_.count(i) != 0) continue;
        place[i] = to.size();
        to.push_back(from[i]);
        if (i < inputs_) result.kept_inputs.push_back(i);
    }
    return place;
}

/// What is held between samples may be off by its slew times the age of a sample: an input of the
/// closed model.
SIVID_DECL node_id closed_loop::held(std::size_t input, node_id law, closed_model& result) const {
    auto& to = result.model;
    auto const& own = open_.about.inputs[input];
    // A little more than the limit times the age: what is proved is proved in decimals.
    double const error = slews_.at(input) * age_ * (1 + 1e-12);
    auto const image = to.g.add(law, to.g.leaf(operation::input, to.about.inputs.size()));
    to.about.inputs.push_back({own.name + ".hold", own.unit});
    result.own_inputs.push_back(sampled_signal({0}, {0}, interpolation::hold, {error}));
    return image;
}

/// How fast the laws that are held change becomes channels.
SIVID_DECL void closed_loop::show_slews(std::map<std::size_t, node_id> const& laws,
                                        std::vector<std::size_t> const& place,
                                        closed_model& result) const {
    auto& to = result.model;
    std::map<std::size_t, double> errors; // of sensors, by input of the closed model
    for (std::size_t k = 0; k < own_inputs_.size(); ++k) {
        auto const* u = std::get_if<sampled_signal>(&own_inputs_[k]);
        if (u != nullptr && !u->exact())
            errors[place[inputs_ + k]] = u->error_bound(u->piece(0), 0);
    }
    for (auto const& [input, law] : laws) {
        auto const& own = open_.about.inputs[input];
        auto const rate = model_detail::rate_of(to, law, errors);
        result.slews.push_back(
            {model_detail::add_channel(to, own.name + ".slew", ".slew",
                                       rate_unit(own.unit, to.about.time_unit), rate),
             slews_.at(input)});
    }
}

SIVID_DECL closed_model closed_loop::finish() const {
    if (commands_.empty()) throw std::invalid_argument("control law: it commands no input");
    if (open_.has_memory())
        throw std::invalid_argument(
            "control law: the model has a delay, a play or a rate limit of unknown size, "
            "which cannot be enclosed; leave the effect out");
    auto const& from = open_;
    closed_model result;
    auto& to = result.model;
    to.about = from.about;
    result.own_inputs = own_inputs_;
    result.own_states = from.about.states.size() - states_;
    auto const place = keep_inputs(result);
    std::vector<node_id> commands;
    for (auto const& [input, value] : commands_) commands.push_back(value);
    auto const kept = [&](node const& n, graph& g) {
        auto const k = static_cast<std::size_t>(n.index);
        if (n.op != operation::input) return g.leaf(n.op, k);
        if (commands_.count(k) != 0)
            throw std::invalid_argument("control law: it depends on what it commands itself, '" +
                                        from.about.inputs[k].name +
                                        "': an algebraic loop; command it by states, or by what "
                                        "sensors show that do not see it at once");
        return g.leaf(n.op, place[k]);
    };
    auto const laws = copy_into(to.g, from.g, commands, kept);
    std::map<std::size_t, node_id> image_of, held_laws;
    for (auto const& [input, value] : commands_) {
        auto image = laws[image_of.size()];
        if (needs_hold(input, value)) {
            held_laws.emplace(input, image);
            image = held(input, image, result);
        }
        image_of.emplace(input, image);
    }
    copy_equations(to, from, [&](node const& n, graph& g) {
        auto const k = static_cast<std::size_t>(n.index);
        if (n.op != operation::input) return g.leaf(n.op, k);
        auto const own = image_of.find(k);
        return own == image_of.end() ? g.leaf(n.op, place[k]) : own->second;
    });
    result.starts = std::move(to.added_states); // they may depend on states now
    to.added_states.clear();
    for (auto const& d : from.derived) { // of constants alone
        to.derived.push_back(
            {d.constant, copy_into(to.g, from.g, {d.value}, kept).front(), d.always});
    }
    for (auto const& [input, image] : image_of) {
        auto const& own = from.about.inputs[input];
        (void)model_detail::add_channel(to, own.name, ".command", own.unit, image);
    }
    show_slews(held_laws, place, result);
    return result;
}

} // namespace sivid

#endif
