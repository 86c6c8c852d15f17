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
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

namespace model_detail {

/// The signs of states that a model rounds off near 0, as in w/sqrt(w^2 + s^2) and tanh(w/s): the
/// state, and s. An arctangent is more often an angle.
class rounded_signs {
public:
    /// @param prior  of the model's unknown constants
    rounded_signs(bound_model const& m, box const& prior)
        : m_{m},
          g_{m.g},
          ranges_{entire(), box(std::vector(m.state_count(), entire())), prior,
                  box(std::vector(m.about.inputs.size(), entire()))} {}

    [[nodiscard]] std::map<std::size_t, double> find() const {
        std::map<std::size_t, double> found;
        auto const needed = operands_of(g_, m_.rate);
        for (std::size_t k = 0; k < g_.size(); ++k) {
            if (!needed[k]) continue;
            auto const& n = g_.nodes()[k];
            auto const one = n.op == operation::div    ? of_quotient(n)
                             : n.op == operation::tanh ? of_argument(n.a)
                                                       : std::nullopt;
            if (one) found[one->first] = std::max(found[one->first], one->second);
        }
        return found;
    }

private:
    using sign = std::optional<std::pair<std::size_t, double>>;

    static interval entire() {
        constexpr double far = std::numeric_limits<double>::infinity();
        return {-far, far};
    }

    [[nodiscard]] static sign made(node const& state, double below) {
        if (state.op != operation::state || !(below > 0) || !std::isfinite(below)) return {};
        return std::pair{static_cast<std::size_t>(state.index), below};
    }
    /// k x / sqrt(x^2 + s^2)
    [[nodiscard]] sign of_quotient(node const& n) const {
        auto const& root = g_[n.b];
        if (root.op != operation::sqrt || g_[root.a].op != operation::add) return {};
        auto const sum = g_[root.a];
        for (auto const& [square, rest] : {std::pair{sum.a, sum.b}, std::pair{sum.b, sum.a}})
            if (g_[square].op == operation::sqr && has_factor(n.a, g_[square].a))
                return made(g_[g_[square].a], std::sqrt(largest(rest)));
        return {};
    }
    [[nodiscard]] bool has_factor(node_id of, node_id x) const {
        auto const& n = g_[of];
        return of == x || (n.op == operation::neg && has_factor(n.a, x)) ||
               (n.op == operation::mul && (has_factor(n.a, x) || has_factor(n.b, x)));
    }
    /// x/s, k x or x
    [[nodiscard]] sign of_argument(node_id of) const {
        auto const& n = g_[of];
        if (n.op == operation::div) return made(g_[n.a], largest(n.b));
        if (n.op != operation::mul) return made(n, 1);
        bool const left = g_[n.a].op == operation::state;
        return made(g_[left ? n.a : n.b], 1 / largest(left ? n.b : n.a));
    }
    /// The largest magnitude of what is made of constants alone; else NaN.
    [[nodiscard]] double largest(node_id of) const {
        graph_range at(g_, {of});
        at.evaluate(ranges_);
        return mag(at.value(of));
    }

    bound_model const& m_;
    graph const& g_;
    leaf_ranges ranges_;
};

/// Readings of one channel in a row that one value explains.
struct resting_readings {
    double from = 0, to = 0;
    interval value;   ///< in all of their bounds
    double error = 0; ///< the width of the widest
};

/// The longest such rows, at least two readings each.
[[nodiscard]] inline std::vector<resting_readings> rows_at_rest(experiment const& e,
                                                                std::size_t channel) {
    std::vector<resting_readings> rows;
    std::size_t readings = 0;
    for (auto const& m : sorted(e.measurements)) {
        if (m.channel != channel) continue;
        if (readings > 0 && !disjoint(rows.back().value, m.bound)) {
            rows.back().to = m.time;
            rows.back().value = intersect(rows.back().value, m.bound);
            rows.back().error = std::max(rows.back().error, width(m.bound));
            ++readings;
            continue;
        }
        if (readings == 1) rows.pop_back();
        rows.push_back({m.time, m.time, m.bound, width(m.bound)});
        readings = 1;
    }
    if (readings == 1) rows.pop_back();
    return rows;
}

/// What a channel shows of a state: it itself, the place whose rate it is, or something else.
enum class shown_speed { itself, place, no };
[[nodiscard]] inline shown_speed shows(bound_model const& m, std::size_t channel,
                                       std::size_t state) {
    auto const is = [&](node_id of) {
        return m.g[of].op == operation::state && static_cast<std::size_t>(m.g[of].index) == state;
    };
    auto const& seen = m.g[m.observe[channel]];
    if (is(m.observe[channel])) return shown_speed::itself;
    bool const place =
        seen.op == operation::state && is(m.rate[static_cast<std::size_t>(seen.index)]);
    return place ? shown_speed::place : shown_speed::no;
}

} // namespace model_detail

/// Where the data stand still and a sign that the model rounds off, w/sqrt(w^2 + s^2) in place of
/// sign(w), lets it move by about s under a load that friction would hold. One sentence a state; of
/// a place that a channel shows, stretches count in which s moves ten times as far as one bound is
/// wide (turning points are shorter), of a speed those whose readings exclude s. None of models
/// with delays, plays or rate limits.
[[nodiscard]] inline std::vector<std::string> creeping_words(identification_problem const& p) {
    using model_detail::shown_speed;
    std::vector<std::string> result;
    if (p.model.has_memory()) return result;
    auto const& about = p.model.about;
    std::vector<signal> const open(about.inputs.size(),
                                   sampled_signal({0.0}, {0.0}, interpolation::linear));
    auto const model = bind(p.model, p.choice, open);
    for (auto const& [state, below] : model_detail::rounded_signs(model, p.prior).find()) {
        std::size_t count = 0;
        std::string first;
        for (std::size_t c = 0; c < about.channels.size(); ++c) {
            auto const what = model_detail::shows(model, c, state);
            if (what == shown_speed::no) continue;
            for (auto const& e : p.experiments) {
                for (auto const& r : model_detail::rows_at_rest(e, c)) {
                    bool const creeps = what == shown_speed::place
                                            ? below * (r.to - r.from) > 10 * r.error
                                            : contains(r.value, 0.0) && below > mag(r.value);
                    if (!creeps || ++count > 1) continue;
                    first = about.channels[c].name + " stands still, as in " + e.name + " from " +
                            nearest_text(r.from, 4) + " to " + nearest_text(r.to, 4) + " " +
                            about.time_unit;
                }
            }
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
