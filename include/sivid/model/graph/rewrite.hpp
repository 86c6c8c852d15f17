// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_GRAPH_REWRITE_HPP
#define SIVID_MODEL_GRAPH_REWRITE_HPP

#include <sivid/model/graph/graph.hpp>

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

namespace sivid {

/// Marks the nodes that the outputs need, companions included.
[[nodiscard]] inline std::vector<bool> reachable(graph const& g,
                                                 std::vector<node_id> const& outputs) {
    std::vector<bool> needed(g.size(), false);
    std::vector<node_id> open(outputs.begin(), outputs.end());
    while (!open.empty()) {
        auto const i = open.back();
        open.pop_back();
        if (needed[i]) continue;
        needed[i] = true;
        auto const& n = g[i];
        if (is_leaf(n.op)) continue;
        open.push_back(n.a);
        if (is_binary(n.op)) open.push_back(n.b);
        if (n.companion != 0) open.push_back(n.companion);
    }
    return needed;
}

/// Nodes in whose place others stand, each with the node of whose image its stand-in is made.
/// @given  that node stands before it
using stand_ins = std::map<node_id, std::optional<node_id>>;

/// Marks the nodes from which the outputs are computed: their operands, without the companions
/// that only series need; of a node in whose place another stands, what that is made of.
[[nodiscard]] inline std::vector<bool>
operands_of(graph const& g, std::vector<node_id> const& outputs, stand_ins const& instead = {}) {
    std::vector<bool> needed(g.size(), false);
    for (auto const i : outputs) needed[i] = true;
    for (std::size_t k = g.size(); k-- > 0;) {
        auto const& n = g.nodes()[k];
        if (!needed[k]) continue;
        if (auto const other = instead.find(static_cast<node_id>(k)); other != instead.end()) {
            if (other->second) needed[*other->second] = true;
            continue;
        }
        if (is_leaf(n.op)) continue;
        needed[n.a] = true;
        if (is_binary(n.op)) needed[n.b] = true;
    }
    return needed;
}

/// The numbers of the leaves of one kind from which the outputs are computed, each once.
/// @param kind  `constant`, `state` or `input`
/// @cost  O(size of `g`)
[[nodiscard]] inline std::vector<std::size_t> leaves_of(graph const& g,
                                                        std::vector<node_id> const& outputs,
                                                        operation kind,
                                                        stand_ins const& instead = {}) {
    auto const needed = operands_of(g, outputs, instead);
    std::vector<std::size_t> result;
    for (std::size_t k = 0; k < g.size(); ++k) {
        auto const& n = g.nodes()[k];
        if (needed[k] && n.op == kind) result.push_back(static_cast<std::size_t>(n.index));
    }
    return result;
}

/// A leaf as it is.
struct same_leaf {
    [[nodiscard]] node_id operator()(node const& n, graph& to) const {
        return to.leaf(n.op, static_cast<std::size_t>(n.index));
    }
};

/// An operation as it is, on other operands.
struct same_operation {
    [[nodiscard]] node_id operator()(node const& n, node_id a, node_id b, graph& to) const {
        if (n.op == operation::pown) return to.pown(a, n.index);
        return is_binary(n.op) ? to.binary(n.op, a, b) : to.unary(n.op, a);
    }
};

/// Copies what `outputs` need from `from` into `to`, in which the rules of `graph` apply anew.
/// @param leaf  called for each needed leaf but literals with (node, to); the node that replaces it
/// @param make  called for each needed operation with (node, its operands in `to`, to); the node
///              that replaces it
/// @param instead  nodes in whose place others stand
/// @param stand    called for each of these with (node_id in `from`, what it is made of in `to`,
/// to)
/// @returns the images of `outputs`
/// @cost  O(size of `from`)
template <class Leaf, class Make, class Stand>
[[nodiscard]] std::vector<node_id> copy_into(graph& to, graph const& from,
                                             std::vector<node_id> const& outputs, Leaf&& leaf,
                                             Make&& make, stand_ins const& instead, Stand&& stand) {
    // Companions are made again by the operation that needs them.
    auto const needed = operands_of(from, outputs, instead);
    std::vector<node_id> image(from.size(), 0);
    for (std::size_t k = 0; k < from.size(); ++k) {
        if (!needed[k]) continue;
        auto const& n = from.nodes()[k];
        if (auto const i = static_cast<node_id>(k); instead.contains(i)) {
            auto const& of = instead.at(i);
            image[k] = stand(i, of ? image[*of] : node_id{}, to);
        } else if (n.op == operation::literal) {
            image[k] = to.constant(from.value(n));
        } else if (is_leaf(n.op)) {
            image[k] = leaf(n, to);
        } else {
            image[k] = make(n, image[n.a], is_binary(n.op) ? image[n.b] : node_id{}, to);
        }
    }
    std::vector<node_id> result;
    result.reserve(outputs.size());
    for (auto const i : outputs) result.push_back(image[i]);
    return result;
}
/// The same of all nodes.
template <class Leaf, class Make = same_operation>
[[nodiscard]] std::vector<node_id> copy_into(graph& to, graph const& from,
                                             std::vector<node_id> const& outputs, Leaf&& leaf,
                                             Make&& make = {}) {
    auto const none = [](node_id, node_id, graph&) { return node_id{}; };
    return copy_into(to, from, outputs, leaf, make, {}, none);
}

} // namespace sivid

#endif
