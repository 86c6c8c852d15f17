// SPDX-License-Identifier: MIT
#ifndef SIVID_TEXT_DETAIL_TRIED_GRAPH_HPP
#define SIVID_TEXT_DETAIL_TRIED_GRAPH_HPP

#include <sivid/model/graph/graph_range.hpp>
#include <sivid/model/model.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace sivid::text_detail {

/// What has a domain: the argument of a root or a logarithm, or a divisor.
struct partial_operation {
    operation op;
    node_id of;
    std::size_t position;
    bool solves = false; ///< it stands in the solution of the equations
};

/// The first whose argument is outside of the domain for all values of the leaves.
[[nodiscard]] inline partial_operation const*
never_defined(graph const& g, std::vector<partial_operation> const& all, leaf_ranges const& at) {
    if (all.empty()) return nullptr;
    std::vector<node_id> nodes;
    for (auto const& d : all) nodes.push_back(d.of);
    graph_range ranges(g, nodes);
    ranges.evaluate(at);
    for (auto const& d : all) {
        auto const& x = ranges.value(d.of);
        if (is_empty(x) || ranges.undefined(d.of)) continue;
        bool const never = d.op == operation::sqrt  ? x.upper() < 0
                           : d.op == operation::log ? x.upper() <= 0
                                                    : x.lower() == 0 && x.upper() == 0;
        if (never) return &d;
    }
    return nullptr;
}
[[nodiscard]] inline std::string domain_words(operation op) {
    return op == operation::div
               ? "a division by 0"
               : std::string(name(op)) + " of what is " +
                     (op == operation::sqrt ? "below 0" : "not above 0") + " over the whole prior";
}

/// All values of a model's leaves: times from 0 on, states in their own ranges, any inputs.
[[nodiscard]] inline leaf_ranges all_values(model_description const& about,
                                            std::vector<interval> constants) {
    leaf_ranges at;
    at.time = interval(0, std::numeric_limits<double>::max());
    std::vector<interval> states;
    for (auto const& s : about.states) states.push_back(s.limit.range());
    at.states = box(std::move(states));
    at.constants = box(std::move(constants));
    at.inputs = box(std::vector<interval>(about.inputs.size(), interval::whole()));
    return at;
}

/// A rate or channel that differs from that of a model at some point although the constants of
/// an effect are neutral, and states that it adds are where they start; by its name.
[[nodiscard]] inline std::optional<std::string> left_trace(recorded_model const& base,
                                                           recorded_model const& joined) {
    auto const n = base.rate.size();
    auto const shown = [n](recorded_model const& model) {
        auto all = model.rate;
        all.insert(all.begin() + static_cast<std::ptrdiff_t>(n), model.observe.begin(),
                   model.observe.end());
        return all;
    };
    auto const before = shown(base), after = shown(joined);
    graph_range old(base.g, before), now(joined.g, after);
    for (std::size_t point = 1; point <= 3; ++point) {
        double share = 0;
        auto const next = [&](double low, double high) { // spread evenly
            share = std::fmod(share + 0.618034 * static_cast<double>(point), 1.0);
            return interval(low + share * (high - low));
        };
        leaf_ranges at{next(0, 10), box(joined.about.states.size()),
                       box(joined.about.constants.size()), box(joined.about.inputs.size())};
        for (std::size_t i = 0; i < at.states.size(); ++i)
            at.states[i] =
                next(joined.about.states[i].limit.lower, joined.about.states[i].limit.upper);
        for (std::size_t k = 0; k < at.constants.size(); ++k)
            at.constants[k] = joined.about.constants[k].nominal.enclosure;
        for (std::size_t k = 0; k < at.inputs.size(); ++k) at.inputs[k] = next(-3, 3);
        for (auto const& a : joined.added_states) {
            graph_range start(joined.g, {a.at_begin});
            start.evaluate(at);
            if (start.undefined(a.at_begin)) return std::nullopt;
            at.states[a.state] = start.value(a.at_begin);
        }
        old.evaluate(at);
        now.evaluate(at);
        // A state without a rate there, as that of a lag of no time, is anywhere at once.
        for (auto k = before.size(); k < after.size(); ++k)
            if (now.undefined(after[k])) return std::nullopt;
        for (std::size_t i = 0; i < before.size(); ++i) {
            if (old.undefined(before[i]) || now.undefined(after[i]) ||
                !disjoint(old.value(before[i]), now.value(after[i])))
                continue;
            return i < n ? base.about.states[i].name + "'" : base.about.channels[i - n].name;
        }
    }
    return std::nullopt;
}

} // namespace sivid::text_detail

#endif
