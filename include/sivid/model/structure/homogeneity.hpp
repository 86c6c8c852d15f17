// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_STRUCTURE_HOMOGENEITY_HPP
#define SIVID_MODEL_STRUCTURE_HOMOGENEITY_HPP

#include <sivid/model/bound_model.hpp>
#include <sivid/model/graph/rewrite.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sivid {

/// Whether all rates and outputs stay as they are when each parameter p_j is multiplied by
/// \f$ \lambda^{w_j} \f$, for every \f$ \lambda \ne 0 \f$.
///   Dimensional analysis: a product has the sum of its factors' degrees, a sum needs equal ones,
///   and what is no product, power or sum needs an argument of degree 0.
/// @param weights  w, one per unknown parameter
/// @guarantee  true is a theorem about the equations; false says nothing (terms may cancel)
/// @cost  one pass over the graph
[[nodiscard]] inline bool is_scale_invariant(bound_model const& model,
                                             std::vector<int> const& weights) {
    auto const& g = model.g;
    auto outputs = model.rate;
    outputs.insert(outputs.end(), model.observe.begin(), model.observe.end());
    auto const needed = operands_of(g, outputs);
    std::vector<std::int64_t> degree(g.size(), 0);
    constexpr std::int64_t most = std::int64_t{1} << 31; // of what is known, so nothing overflows
    for (std::size_t k = 0; k < g.size(); ++k) {
        if (!needed[k]) continue;
        auto const& n = g.nodes()[k];
        if (n.op == operation::constant) degree[k] = weights[static_cast<std::size_t>(n.index)];
        if (is_leaf(n.op)) continue;
        auto const a = degree[n.a];
        auto const b = is_binary(n.op) ? degree[n.b] : 0;
        switch (n.op) {
        case operation::neg:
            degree[k] = a;
            break;
        case operation::add:
        case operation::sub:
            if (a != b) return false;
            degree[k] = a;
            break;
        case operation::mul:
            degree[k] = a + b;
            break;
        case operation::div:
            degree[k] = a - b;
            break;
        case operation::sqr:
            degree[k] = 2 * a;
            break;
        case operation::pown:
            degree[k] = n.index * a;
            break;
        default:
            if (a != 0 || b != 0) return false;
        }
        if (degree[k] > most || degree[k] < -most) return false;
    }
    return std::all_of(outputs.begin(), outputs.end(), [&](node_id i) { return degree[i] == 0; });
}

} // namespace sivid

#endif
