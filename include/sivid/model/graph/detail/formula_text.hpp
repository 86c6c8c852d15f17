// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_GRAPH_DETAIL_FORMULA_TEXT_HPP
#define SIVID_MODEL_GRAPH_DETAIL_FORMULA_TEXT_HPP

#include <sivid/model/graph/graph.hpp>
#include <sivid/number/text/nearest_text.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace sivid {

/// What the leaves of a graph are called.
struct leaf_names {
    std::vector<std::string> constants, states{}, inputs{};
    std::map<node_id, std::string> nodes{}; ///< what else has a name, and is not written out
};

/// Whether the formula of a node, in which shared ones are repeated, has so many parts at most.
[[nodiscard]] inline bool is_short(graph const& g, node_id i, leaf_names const& names,
                                   double most) {
    std::vector<double> sizes;
    for (std::size_t k = 0; k <= i; ++k) {
        auto const& n = g.nodes()[k];
        double size = 1;
        if (!is_leaf(n.op) && !names.nodes.contains(static_cast<node_id>(k)))
            size += sizes[n.a] + (is_binary(n.op) ? sizes[n.b] : 0);
        sizes.push_back(std::min(size, 2 * most));
    }
    return sizes[i] <= most;
}

/// How tightly the outermost operation binds: 1 sums, 2 products, 3 signs, 4 powers, 5 atoms.
[[nodiscard]] inline int binding_of(graph const& g, node_id k, leaf_names const& names) {
    if (names.nodes.contains(k)) return 5;
    switch (g[k].op) {
    case operation::add:
    case operation::sub:
        return 1;
    case operation::mul:
    case operation::div:
        return 2;
    case operation::neg:
        return 3;
    case operation::sqr:
    case operation::pown:
        return 4;
    case operation::literal:
        return g.value(g[k]).nearest < 0 ? 3 : 5;
    default:
        return 5;
    }
}

/// A node as a formula: "3.141592653589793 * D^2 / 4". Literals are the decimals of their nearest
/// doubles; leaves without a name are "?".
/// @cost  that of the text, which may be long where subexpressions are shared
[[nodiscard]] inline std::string formula_text(graph const& g, node_id i, leaf_names const& names) {
    if (auto const known = names.nodes.find(i); known != names.nodes.end()) return known->second;
    auto const& n = g[i];
    auto const named = [&n](std::vector<std::string> const& known) {
        auto const k = static_cast<std::size_t>(n.index);
        return k < known.size() ? known[k] : std::string{"?"};
    };
    auto const within = [&](node_id k, int rank) {
        auto text = formula_text(g, k, names);
        return binding_of(g, k, names) < rank ? "(" + text + ")" : text;
    };
    switch (n.op) {
    case operation::literal:
        return nearest_text(g.value(n).nearest);
    case operation::constant:
        return named(names.constants);
    case operation::time:
        return "t";
    case operation::state:
        return named(names.states);
    case operation::input:
        return named(names.inputs);
    case operation::neg:
        return "-" + within(n.a, 3);
    case operation::add:
        return within(n.a, 1) + " + " + within(n.b, 1);
    case operation::sub:
        return within(n.a, 1) + " - " + within(n.b, 2);
    case operation::mul: // numbers first
        return g.is_literal(n.b) ? within(n.b, 2) + " * " + within(n.a, 2)
                                 : within(n.a, 2) + " * " + within(n.b, 2);
    case operation::div:
        return within(n.a, 2) + " / " + within(n.b, 3);
    case operation::sqr:
        return within(n.a, 5) + "^2";
    case operation::pown:
        return within(n.a, 5) + "^" + std::to_string(n.index);
    default:
        return std::string(name(n.op)) + "(" + formula_text(g, n.a, names) +
               (is_binary(n.op) ? ", " + formula_text(g, n.b, names) : "") + ")";
    }
}

/// `formula_text` for people to read: in place of one of more than `most` parts, the words that it
/// is too long.
/// @cost  O(size of the graph) but for the text
[[nodiscard]] inline std::string readable_formula(graph const& g, node_id i,
                                                  leaf_names const& names, double most = 80) {
    return is_short(g, i, names, most) ? formula_text(g, i, names)
                                       : "something that is too long to be shown";
}

} // namespace sivid

#endif
