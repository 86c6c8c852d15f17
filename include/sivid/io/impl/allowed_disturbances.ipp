// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_IMPL_ALLOWED_DISTURBANCES_IPP
#define SIVID_IO_IMPL_ALLOWED_DISTURBANCES_IPP

#include <sivid/io/allowed_disturbances.hpp>

#include <sivid/model/disturbance.hpp>
#include <sivid/model/graph/rewrite.hpp>
#include <sivid/model/unit.hpp>

#include <cstddef>
#include <stdexcept>

namespace sivid {

namespace io_detail {

/// With scales that are the bounds, rounded up.
[[nodiscard]] inline disturbance_set set_of(allowed_disturbances const& allowed,
                                            recorded_model const& model) {
    auto const upward = [](allowed_disturbances::bounds const& all) {
        std::vector<std::pair<std::string, double>> result;
        for (auto const& [name, most] : all) {
            auto const bound = enclose(most);
            if (!bound)
                throw std::invalid_argument("disturbance: the bound of '" + name +
                                            "' is beyond all numbers");
            result.emplace_back(name, bound->upper());
        }
        return result;
    };
    return disturbance_on(model, upward(allowed.equations), upward(allowed.channels));
}

/// Channels that show the rate of a disturbed equation, as the model wrote it before.
[[nodiscard]] inline std::vector<std::string> showing_rate(recorded_model const& model,
                                                           std::size_t equation) {
    auto const& nodes = model.g.nodes();
    auto const& sum = nodes[model.rate[equation]];
    std::vector<std::string> result;
    if (sum.op != operation::add) return result;
    for (std::size_t y = 0; y < model.observe.size(); ++y) {
        auto const seen = reachable(model.g, {model.observe[y]});
        bool shown = false;
        for (auto const k : {sum.a, sum.b})
            shown = shown || (!is_leaf(nodes[k].op) && k < seen.size() && seen[k]);
        if (shown) result.push_back(model.about.channels[y].name);
    }
    return result;
}

} // namespace io_detail

SIVID_DECL identification_problem with_disturbance(identification_problem problem,
                                                   allowed_disturbances const& allowed) {
    auto const set = io_detail::set_of(allowed, problem.model);
    return with_disturbance(std::move(problem), set, 1);
}

SIVID_DECL std::string in_words(allowed_disturbances const& allowed, recorded_model const& model) {
    auto const& about = model.about;
    auto const set = io_detail::set_of(allowed, model);
    std::string text;
    auto const add = [&](std::string const& name, exact_decimal const& most,
                         std::string const& of) {
        text += (text.empty() ? "" : ", ") + name + " up to " + most.text() + " " + of;
    };
    for (std::size_t k = 0; k < set.equations.size(); ++k) {
        auto const& state = about.states[set.equations[k].index];
        add(state.equation_name(), allowed.equations[k].second,
            rate_unit(state.unit, about.time_unit));
    }
    for (std::size_t k = 0; k < set.channels.size(); ++k) {
        auto const& channel = about.channels[set.channels[k].index];
        add("readings of " + channel.name, allowed.channels[k].second, channel.unit);
    }
    return text;
}

SIVID_DECL std::vector<std::string> assumptions_of(allowed_disturbances const& allowed,
                                                   recorded_model const& model) {
    if (allowed.empty()) return {};
    std::vector<std::string> result{
        "unknown disturbances, any function of time: " + in_words(allowed, model) +
        "; what is excluded or proved holds for all of them, witness and inside boxes are without"};
    for (auto const& q : io_detail::set_of(allowed, model).equations)
        for (auto const& channel : io_detail::showing_rate(model, q.index))
            result.push_back("the channel " + channel + " shows the rate of " +
                             model.about.states[q.index].name + " without its disturbance");
    return result;
}

} // namespace sivid

#endif
