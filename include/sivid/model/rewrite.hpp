// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_REWRITE_HPP
#define SIVID_MODEL_REWRITE_HPP

#include <sivid/model/graph.hpp>

#include <cstddef>
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

/// Marks the nodes from which the outputs are computed: their operands, without the companions
/// that only series need.
[[nodiscard]] inline std::vector<bool> operands_of(graph const& g,
                                                   std::vector<node_id> const& outputs) {
    std::vector<bool> needed(g.size(), false);
    for (auto const i : outputs) needed[i] = true;
    for (std::size_t k = g.size(); k-- > 0;) {
        auto const& n = g.nodes()[k];
        if (!needed[k] || is_leaf(n.op)) continue;
        needed[n.a] = true;
        if (is_binary(n.op)) needed[n.b] = true;
    }
    return needed;
}

/// Copies what `outputs` need from `from` into `to`, in which the rules of `graph` apply anew.
/// @param leaf  called for each needed leaf but literals with (node, to); the node that replaces it
/// @returns the images of `outputs`
/// @cost  O(size of `from`)
template <class Leaf>
[[nodiscard]] std::vector<node_id> copy_into(graph& to, graph const& from,
                                             std::vector<node_id> const& outputs, Leaf&& leaf) {
    // Companions are made again by the operation that needs them.
    auto const needed = operands_of(from, outputs);
    std::vector<node_id> image(from.size(), 0);
    for (std::size_t k = 0; k < from.size(); ++k) {
        if (!needed[k]) continue;
        auto const& n = from.nodes()[k];
        if (n.op == operation::literal) {
            image[k] = to.constant(from.value(n));
        } else if (is_leaf(n.op)) {
            image[k] = leaf(n, to);
        } else if (n.op == operation::pown) {
            image[k] = to.pown(image[n.a], n.index);
        } else if (is_binary(n.op)) {
            image[k] = to.binary(n.op, image[n.a], image[n.b]);
        } else {
            image[k] = to.unary(n.op, image[n.a]);
        }
    }
    std::vector<node_id> result;
    result.reserve(outputs.size());
    for (auto const i : outputs) result.push_back(image[i]);
    return result;
}

} // namespace sivid

#endif
