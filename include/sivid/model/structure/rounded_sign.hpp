// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_STRUCTURE_ROUNDED_SIGN_HPP
#define SIVID_MODEL_STRUCTURE_ROUNDED_SIGN_HPP

#include <sivid/model/bound_model.hpp>
#include <sivid/model/graph/graph_range.hpp>
#include <sivid/model/graph/rewrite.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/number/text/nearest_text.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

namespace model_detail {

/// The state that a node is.
[[nodiscard]] inline std::optional<std::size_t> state_at(graph const& g, node_id of) {
    if (g[of].op != operation::state) return std::nullopt;
    return static_cast<std::size_t>(g[of].index);
}

/// The signs of states that a model rounds off near 0, as in k w/sqrt(w^2 + s^2) and tanh(w/s): the
/// state, and s, the largest of the prior.
[[nodiscard]] inline std::map<std::size_t, double> rounded_signs(bound_model const& m,
                                                                 box const& prior) {
    auto const& g = m.g;
    std::map<std::size_t, double> found;
    constexpr double far = std::numeric_limits<double>::infinity();
    auto const all = [&](std::size_t n) { return box(std::vector(n, interval(-far, far))); };
    auto const largest = [&](node_id of) { // infinite where it is not of constants alone
        graph_range at(g, {of});
        at.evaluate({{-far, far}, all(m.state_count()), prior, all(m.about.inputs.size())});
        return mag(at.value(of));
    };
    auto const add = [&](node_id x, double below) {
        auto const state = state_at(g, x);
        if (state && below > 0 && std::isfinite(below))
            found[*state] = std::max(found[*state], below);
    };
    std::function<bool(node_id, node_id)> const has_factor = [&](node_id of, node_id x) {
        auto const& n = g[of];
        return of == x || (n.op == operation::neg && has_factor(n.a, x)) ||
               (n.op == operation::mul && (has_factor(n.a, x) || has_factor(n.b, x)));
    };
    auto const needed = operands_of(g, m.rate);
    for (std::size_t k = 0; k < g.size(); ++k) {
        auto const& n = g.nodes()[k];
        if (!needed[k]) continue;
        if (n.op == operation::div && g[n.b].op == operation::sqrt &&
            g[g[n.b].a].op == operation::add) {
            auto const& sum = g[g[n.b].a];
            for (auto const& [square, rest] : {std::pair{sum.a, sum.b}, std::pair{sum.b, sum.a}})
                if (g[square].op == operation::sqr && has_factor(n.a, g[square].a))
                    add(g[square].a, std::sqrt(largest(rest)));
        } else if (n.op == operation::tanh) { // of x/s, k x or x
            auto const& of = g[n.a];
            if (of.op == operation::div)
                add(of.a, largest(of.b));
            else if (of.op != operation::mul)
                add(n.a, 1);
            else if (state_at(g, of.a))
                add(of.a, 1 / largest(of.b));
            else
                add(of.b, 1 / largest(of.a));
        }
    }
    return found;
}

/// Readings of one channel in a row that one value explains.
struct resting_readings {
    double from = 0, to = 0;
    interval value;   ///< in all of their bounds
    double error = 0; ///< the width of the widest
};

/// The longest such rows.
[[nodiscard]] inline std::vector<resting_readings> rows_at_rest(experiment const& e,
                                                                std::size_t channel) {
    std::vector<resting_readings> rows;
    for (auto const& m : sorted(e.measurements)) {
        if (m.channel != channel) continue;
        if (rows.empty() || disjoint(rows.back().value, m.bound)) {
            rows.push_back({m.time, m.time, m.bound, width(m.bound)});
        } else {
            auto& last = rows.back();
            last = {last.from, m.time, intersect(last.value, m.bound),
                    std::max(last.error, width(m.bound))};
        }
    }
    return rows;
}

} // namespace model_detail

/// Where the data stand still and a sign that the model rounds off, w/sqrt(w^2 + s^2) in place of
/// sign(w), lets it move by about s under a load that friction would hold. One sentence a state: of
/// places that a channel shows, for stretches in which s moves ten times as far as one bound is
/// wide (turning points are shorter). None of models with delays, plays or rate limits.
[[nodiscard]] inline std::vector<std::string> creeping_words(identification_problem const& p) {
    std::vector<std::string> result;
    if (p.model.has_memory()) return result;
    auto const& about = p.model.about;
    std::vector<signal> const open(about.inputs.size(),
                                   sampled_signal({0.0}, {0.0}, interpolation::linear));
    auto const model = bind(p.model, p.choice, open);
    for (auto const& [state, below] : model_detail::rounded_signs(model, p.prior)) {
        std::size_t count = 0;
        std::string first;
        for (std::size_t c = 0; c < about.channels.size(); ++c) {
            auto const place = model_detail::state_at(model.g, model.observe[c]);
            if (!place || model_detail::state_at(model.g, model.rate[*place]) != state) continue;
            for (auto const& e : p.experiments)
                for (auto const& r : model_detail::rows_at_rest(e, c))
                    if (below * (r.to - r.from) > 10 * r.error && ++count == 1)
                        first = about.channels[c].name + " stands still, as in " + e.name +
                                " from " + nearest_text(r.from, 4) + " to " +
                                nearest_text(r.to, 4) + " " + about.time_unit;
        }
        if (count == 0) continue;
        auto const& s = about.states[state];
        auto const unit = s.unit.empty() || s.unit == "1" ? "" : " " + s.unit;
        auto const more = count == 1 ? "" : " (first of " + std::to_string(count) + ")";
        result.push_back("the sign of " + s.name + " is rounded off below " +
                         nearest_text(below, 3) + unit + ": where " + first + more +
                         ", the model may creep; sign(" + s.name + ") sticks");
    }
    return result;
}

} // namespace sivid

#endif
