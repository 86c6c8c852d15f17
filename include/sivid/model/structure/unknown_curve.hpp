// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_STRUCTURE_UNKNOWN_CURVE_HPP
#define SIVID_MODEL_STRUCTURE_UNKNOWN_CURVE_HPP

#include <sivid/model/bound_model.hpp>
#include <sivid/model/graph/graph.hpp>
#include <sivid/model/graph/operation.hpp>
#include <sivid/model/graph/recorded_map.hpp>
#include <sivid/model/graph/rewrite.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// A part of the equations that is a function of one moving quantity and of unknown constants, and
/// no polynomial in these: the force of a tyre over its slip, a friction over a speed.
struct unknown_curve {
    node_id value = 0;                   ///< g(z, p)
    node_id argument = 0;                ///< z, of states, inputs and time, without p
    std::vector<std::size_t> parameters; ///< those of p that g depends on, rising
};

namespace model_detail {

/// How the nodes of a bound graph depend on what moves and on what is unknown.
class curve_finder {
public:
    explicit curve_finder(bound_model const& model)
        : g_(model.g), outputs_(model.rate), about_(model.g.size()) {
        outputs_.insert(outputs_.end(), model.observe.begin(), model.observe.end());
        needed_ = operands_of(g_, outputs_);
        for (std::size_t k = 0; k < g_.size(); ++k) {
            if (needed_[k]) about_[k] = look_at(static_cast<node_id>(k), model.parameter_count());
        }
    }

    [[nodiscard]] std::vector<unknown_curve> operator()() const {
        std::vector<bool> ends(g_.size(), false); // has a parent that is no curve, or is an output
        for (auto const i : outputs_) ends[i] = true;
        for (std::size_t k = 0; k < g_.size(); ++k) {
            auto const& n = g_.nodes()[k];
            if (!needed_[k] || is_leaf(n.op) || is_curve(static_cast<node_id>(k))) continue;
            ends[n.a] = true;
            if (is_binary(n.op)) ends[n.b] = true;
        }
        std::vector<node_id> found;
        for (std::size_t k = 0; k < g_.size(); ++k) {
            auto const i = static_cast<node_id>(k);
            if (needed_[k] && ends[k] && is_curve(i)) found.push_back(i);
        }
        // Numbers stay outside, and constants where others share the rest: the force of a tyre is
        // one in F/m and in a F/I.
        for (auto& i : found) {
            for (auto next = curve_factor(i);
                 next && about_[*next].parameters == about_[i].parameters; next = curve_factor(i)) {
                i = *next;
            }
        }
        leave_one_of_each(found);
        auto const all = found;
        for (auto& i : found) {
            auto const others_lack = [&](node_id rest) { // what is left out with this one
                return std::any_of(all.begin(), all.end(), [&](node_id other) {
                    auto const& theirs = about_[other].parameters;
                    return meet(theirs, about_[rest].parameters) &&
                           !holds_difference(theirs, about_[i].parameters, about_[rest].parameters);
                });
            };
            for (auto next = curve_factor(i); next && others_lack(*next); next = curve_factor(i)) {
                i = *next;
            }
        }
        leave_one_of_each(found);
        std::vector<unknown_curve> result;
        for (auto const i : found) {
            unknown_curve c{i, about_[i].argument, {}};
            for (std::size_t j = 0; j < about_[i].parameters.size(); ++j) {
                if (about_[i].parameters[j]) c.parameters.push_back(j);
            }
            result.push_back(std::move(c));
        }
        return result;
    }

private:
    struct dependence {
        bool moves = false;
        std::vector<bool> parameters; ///< empty: none
        std::size_t arguments = 0;    ///< moving quantities without parameters; 2: or more
        node_id argument = 0;         ///< the first of them
        bool bent = false;            ///< no polynomial in the parameters
        bool smooth = true;
    };

    static void leave_one_of_each(std::vector<node_id>& list) {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
    }
    [[nodiscard]] static bool meet(std::vector<bool> const& a, std::vector<bool> const& b) {
        for (std::size_t j = 0; j < std::min(a.size(), b.size()); ++j) {
            if (a[j] && b[j]) return true;
        }
        return false;
    }
    /// Whether a set has all of `whole` that is not in `part`.
    [[nodiscard]] static bool holds_difference(std::vector<bool> const& set,
                                               std::vector<bool> const& whole,
                                               std::vector<bool> const& part) {
        for (std::size_t j = 0; j < whole.size(); ++j) {
            if (whole[j] && !part[j] && !set[j]) return false;
        }
        return true;
    }
    [[nodiscard]] dependence look_at(node_id i, std::size_t parameters) const {
        auto const& n = g_[i];
        dependence d;
        if (n.op == operation::literal) return d;
        if (n.op == operation::constant) {
            d.parameters.assign(parameters, false);
            d.parameters[static_cast<std::size_t>(n.index)] = true;
            return d;
        }
        if (is_leaf(n.op)) {
            d.moves = true;
            return d;
        }
        std::vector<node_id> operands{n.a};
        if (is_binary(n.op)) operands.push_back(n.b);
        for (auto const k : operands) {
            auto const& a = about_[k];
            d.moves = d.moves || a.moves;
            if (d.parameters.empty()) d.parameters.resize(a.parameters.size());
            for (std::size_t j = 0; j < a.parameters.size(); ++j) {
                if (a.parameters[j]) d.parameters[j] = true;
            }
        }
        if (!d.moves || d.parameters.empty()) return d;
        d.smooth = !has_kink(n.op);
        for (auto const k : operands) {
            auto const& a = about_[k];
            if (!a.moves) continue;
            bool const mixed = !a.parameters.empty();
            if (mixed) {
                d.smooth = d.smooth && a.smooth;
                d.bent = d.bent || a.bent;
            }
            auto const count = mixed ? a.arguments : 1;
            auto const first = mixed ? a.argument : k;
            if (d.arguments == 0) {
                d.arguments = count;
                d.argument = first;
            } else if (count > 1 || first != d.argument) {
                d.arguments = 2;
            }
        }
        switch (n.op) {
        case operation::neg:
        case operation::add:
        case operation::sub:
        case operation::mul:
        case operation::sqr:
        case operation::pown:
            break;
        case operation::div:
            d.bent = d.bent || !about_[n.b].parameters.empty();
            break;
        default:
            d.bent = true;
        }
        return d;
    }
    [[nodiscard]] bool is_curve(node_id i) const {
        auto const& d = about_[i];
        return d.moves && !d.parameters.empty() && d.arguments == 1 && d.bent && d.smooth;
    }
    /// Of a product or quotient of a curve and constants: the curve.
    [[nodiscard]] std::optional<node_id> curve_factor(node_id i) const {
        auto const& n = g_[i];
        if (n.op == operation::neg) return is_curve(n.a) ? std::optional(n.a) : std::nullopt;
        if (n.op != operation::mul && n.op != operation::div) return std::nullopt;
        if (is_curve(n.a) && !about_[n.b].moves) return n.a;
        if (n.op == operation::mul && is_curve(n.b) && !about_[n.a].moves) return n.b;
        return std::nullopt;
    }

    graph const& g_;
    std::vector<node_id> outputs_;
    std::vector<bool> needed_;
    std::vector<dependence> about_;
};

} // namespace model_detail

/// The largest such parts of the equations and outputs, without kinks.
/// @given  inputs of `model` are leaves
/// @cost   O(nodes times parameters)
[[nodiscard]] inline std::vector<unknown_curve> find_curves(bound_model const& model) {
    return model_detail::curve_finder(model)();
}

/// A curve as a function of its argument and, behind it, its parameters.
[[nodiscard]] inline recorded_map map_of(graph const& from, unknown_curve const& curve) {
    graph g;
    auto const& own = curve.parameters;
    auto const parameter = [&own](node const& n, graph& to) {
        auto const at = std::lower_bound(own.begin(), own.end(), static_cast<std::size_t>(n.index));
        return to.leaf(operation::constant, 1 + static_cast<std::size_t>(at - own.begin()));
    };
    auto const z = [](node_id, node_id, graph& to) { return to.leaf(operation::constant, 0); };
    auto values = copy_into(g, from, {curve.value}, parameter, same_operation{},
                            {{curve.argument, std::nullopt}}, z);
    return {1 + own.size(), std::move(g), std::move(values)};
}

} // namespace sivid

#endif
