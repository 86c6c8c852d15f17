// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_GRAPH_DIFFERENTIATE_HPP
#define SIVID_MODEL_GRAPH_DIFFERENTIATE_HPP

#include <sivid/model/graph/graph.hpp>
#include <sivid/model/graph/rewrite.hpp>

#include <cstddef>
#include <vector>

namespace sivid {

namespace model_detail {

/// Derivative of node `i` by `wrt`, given the derivatives of its operands.
inline node_id derivative_rule(graph& g, node_id i, node_id da, node_id db) {
    auto const n = g[i]; // a copy: building may move the nodes
    auto const one = g.constant(1.0);
    auto const half = g.constant(0.5);
    // A vanishing derivative times whatever the function itself is computed from: where that is not
    // defined, the function says so.
    auto const times = [&g](node_id x, node_id d) { return g.is(d, 0) ? d : g.mul(x, d); };
    switch (n.op) {
    case operation::neg:
        return g.neg(da);
    case operation::add:
        return g.add(da, db);
    case operation::sub:
        return g.sub(da, db);
    case operation::mul:
        return g.add(times(n.b, da), times(n.a, db));
    case operation::div:
        return g.div(g.sub(da, times(i, db)), n.b);
    case operation::sqr:
        return g.mul(g.mul(g.constant(2.0), n.a), da);
    case operation::pown: {
        auto const factor = g.constant(static_cast<double>(n.index));
        return g.mul(g.mul(factor, g.pown(n.a, n.index - 1)), da);
    }
    case operation::sqrt:
        return g.div(g.mul(half, da), i);
    case operation::exp:
        return g.mul(i, da);
    case operation::log:
        return g.div(da, n.a);
    case operation::sin:
        return g.mul(n.companion, da);
    case operation::cos:
        return g.neg(g.mul(n.companion, da));
    case operation::tan:
    case operation::tanh:
        return g.mul(n.companion, da);
    case operation::atan:
        return g.div(da, n.companion);
    case operation::abs:
        return g.mul(g.unary(operation::sign, n.a), da);
    case operation::min:
    case operation::max: {
        // min' = da + (db - da) (1 + s)/2 with s = sign(a - b); Clarke's set where a = b.
        auto const s = g.unary(operation::sign, g.sub(n.a, n.b));
        auto const weight = g.mul(half, n.op == operation::min ? g.add(one, s) : g.sub(one, s));
        return g.add(da, g.mul(weight, g.sub(db, da)));
    }
    default:
        return g.constant(0.0); // sign: constant away from its jump, which has_kink reports
    }
}

} // namespace model_detail

/// Symbolic partial derivatives: entry [k][j] is the node of \f$ \partial out_k / \partial wrt_j
/// \f$. New nodes are added to `g`; equal subexpressions are shared with the function itself. Where
/// an operation has a kink the derivative is Clarke's generalised one, as a set.
/// @param wrt  leaves of `g`
/// @cost  O(size * wrt.size())
[[nodiscard]] inline std::vector<std::vector<node_id>>
differentiate(graph& g, std::vector<node_id> const& outputs, std::vector<node_id> const& wrt) {
    auto const size = g.size();
    auto const needed = operands_of(g, outputs);
    std::vector<std::vector<node_id>> result(outputs.size());
    auto const zero = g.constant(0.0);
    for (auto const variable : wrt) {
        std::vector<node_id> d(size, zero);
        for (std::size_t k = 0; k < size; ++k) {
            auto const i = static_cast<node_id>(k);
            if (!needed[k]) continue;
            if (i == variable) {
                d[k] = g.constant(1.0);
                continue;
            }
            auto const n = g[i];
            if (is_leaf(n.op)) continue;
            auto const da = d[n.a];
            auto const db = is_binary(n.op) ? d[n.b] : zero;
            if (da == zero && db == zero) continue;
            d[k] = model_detail::derivative_rule(g, i, da, db);
        }
        for (std::size_t o = 0; o < outputs.size(); ++o) result[o].push_back(d[outputs[o]]);
    }
    return result;
}

} // namespace sivid

#endif
