// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_IMPL_DISTURBANCE_IPP
#define SIVID_MODEL_IMPL_DISTURBANCE_IPP

#include <sivid/model/disturbance.hpp>

#include <sivid/model/graph/rewrite.hpp>
#include <sivid/model/unit.hpp>
#include <sivid/number/interval_traits.hpp>
#include <sivid/number/text/joined.hpp>
#include <sivid/number/text/nearest_name.hpp>
#include <sivid/number/text/nearest_text.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace sivid {

namespace model_detail {

[[noreturn]] inline void refuse_disturbance(std::string const& what) {
    throw std::invalid_argument("disturbance: " + what);
}

/// States that act on some channel, by way of others, too.
[[nodiscard]] inline std::vector<bool> states_that_show(recorded_model const& model) {
    std::vector<bool> shown(model.rate.size(), false);
    auto const mark = [&](std::vector<node_id> const& functions) {
        bool more = false;
        auto const needed = reachable(model.g, functions);
        for (std::size_t k = 0; k < needed.size(); ++k) {
            auto const& n = model.g.nodes()[k];
            if (!needed[k] || n.op != operation::state) continue;
            auto&& known = shown[static_cast<std::size_t>(n.index)];
            more = more || !known;
            known = true;
        }
        return more;
    };
    for (bool more = mark(model.observe); more;) {
        std::vector<node_id> rates;
        for (std::size_t i = 0; i < shown.size(); ++i)
            if (shown[i]) rates.push_back(model.rate[i]);
        more = mark(rates);
    }
    return shown;
}

inline void require_members(std::vector<disturbed_quantity> const& all, std::size_t known,
                            std::string const& what) {
    std::set<std::size_t> seen;
    for (auto const& q : all) {
        if (q.index >= known)
            refuse_disturbance("unknown " + what + ": number " + std::to_string(q.index) + " of " +
                               std::to_string(known) + ", counted from 0");
        if (!(q.scale > 0) || !std::isfinite(q.scale))
            refuse_disturbance("the scale of a disturbed " + what + " is " + nearest_text(q.scale) +
                               "; give a number above 0: what a size of 1 means there");
        if (!seen.insert(q.index).second)
            refuse_disturbance("a " + what + " is named twice; name each once");
    }
}

template <class Name>
[[nodiscard]] std::vector<disturbed_quantity>
quantities_named(std::vector<std::pair<std::string, double>> const& wanted, std::size_t count,
                 std::string const& what, Name const& is_name,
                 std::vector<std::string> const& names) {
    std::vector<disturbed_quantity> result;
    for (auto const& [name, scale] : wanted) {
        std::size_t at = 0;
        while (at < count && !is_name(at, name)) ++at;
        if (at == count) {
            auto const near = nearest_name(name, names);
            refuse_disturbance("there is no " + what + " '" + name + "'" +
                               (near.empty() ? "" : "; did you mean '" + near + "'?") +
                               "; known: " + joined(names, ", "));
        }
        result.push_back({at, scale});
    }
    return result;
}

} // namespace model_detail

SIVID_DECL disturbance_set disturbance_on(
    recorded_model const& model, std::vector<std::pair<std::string, double>> const& equations,
    std::vector<std::pair<std::string, double>> const& channels) {
    auto const& about = model.about;
    std::vector<std::string> states, outputs;
    for (auto const& s : about.states) states.push_back(s.equation_name());
    for (auto const& c : about.channels) outputs.push_back(c.name);
    disturbance_set result;
    result.equations = model_detail::quantities_named(
        equations, states.size(), "equation",
        [&](std::size_t i, std::string const& name) {
            return states[i] == name || about.states[i].name == name;
        },
        states);
    result.channels = model_detail::quantities_named(
        channels, outputs.size(), "channel",
        [&](std::size_t i, std::string const& name) { return outputs[i] == name; }, outputs);
    require_valid(result, model);
    return result;
}

SIVID_DECL void require_valid(disturbance_set const& set, recorded_model const& model) {
    using model_detail::refuse_disturbance;
    if (set.equations.empty() && set.channels.empty())
        refuse_disturbance("no equation and no channel is disturbed; name one with its scale");
    if (model.has_memory())
        refuse_disturbance("the model has delays, plays or rate limits, which are not covered; "
                           "leave the effects out that bring them");
    model_detail::require_members(set.equations, model.rate.size(), "equation");
    model_detail::require_members(set.channels, model.observe.size(), "channel");
    auto const shown = model_detail::states_that_show(model);
    for (auto const& q : set.equations)
        if (!shown[q.index])
            refuse_disturbance("no channel depends on '" + model.about.states[q.index].name +
                               "', so that nothing can be said of a disturbance of its equation; "
                               "disturb one that is seen");
}

SIVID_DECL std::vector<std::size_t> driven_equations(recorded_model const& model) {
    auto const shown = model_detail::states_that_show(model);
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < model.rate.size(); ++i)
        if (shown[i] && (model.g.depends(model.rate[i]) & (on_constant | on_input)) != 0)
            result.push_back(i);
    return result;
}

SIVID_DECL identification_problem with_disturbance(identification_problem problem,
                                                   disturbance_set const& set, double size) {
    using traits = interval_traits<interval>;
    problem.require_valid();
    require_valid(set, problem.model);
    if (!(size >= 0) || !std::isfinite(size))
        model_detail::refuse_disturbance("a size must be a number of at least 0");
    auto& model = problem.model;
    auto const bound = [size](disturbed_quantity const& q) {
        double const most = traits::mul(traits::point(size), traits::point(q.scale)).upper();
        if (!std::isfinite(most))
            model_detail::refuse_disturbance("size times scale is beyond all numbers");
        return most;
    };
    for (auto const& q : set.equations) {
        auto const& state = model.about.states[q.index];
        auto const name = model_detail::unused_name(
            "disturbance of " + state.equation_name(), [&](std::string const& n) {
                return std::any_of(model.about.inputs.begin(), model.about.inputs.end(),
                                   [&n](auto const& i) { return i.name == n; });
            });
        auto const leaf = model.g.leaf(operation::input, model.about.inputs.size());
        model.rate[q.index] = model.g.binary(operation::add, model.rate[q.index], leaf);
        model.about.inputs.push_back({name, rate_unit(state.unit, model.about.time_unit)});
        for (auto& e : problem.experiments)
            e.inputs.push_back(sampled_signal({e.begin}, {0.0}, interpolation::hold, {bound(q)}));
    }
    if (!set.equations.empty()) model.stated.reset();
    for (auto const& q : set.channels) {
        double const more = bound(q);
        for (auto& e : problem.experiments)
            for (auto& m : e.measurements)
                if (m.channel == q.index)
                    m.bound = traits::add(m.bound, traits::bounds(-more, more));
    }
    return problem;
}

} // namespace sivid

#endif
