// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_GRAPH_RANGE_HPP
#define SIVID_DIAGNOSIS_GRAPH_RANGE_HPP

#include <sivid/model/arithmetic.hpp>
#include <sivid/model/graph.hpp>
#include <sivid/model/rewrite.hpp>
#include <sivid/space/box.hpp>

#include <cstddef>
#include <vector>

namespace sivid {

/// Where the leaves of a graph lie: time, states, unknown constants, inputs.
struct leaf_ranges {
    interval time{0.0};
    box states, constants, inputs;
};

/// Ranges of nodes of a graph over a box of leaves, by natural interval evaluation.
/// @guarantee  `value` contains the node's value for every choice of leaves in the box for which it
///             is defined
/// @cost  one interval operation for each needed node
class graph_range {
public:
    /// @given  `g` outlives this object
    graph_range(graph const& g, std::vector<node_id> const& outputs)
        : graph_(&g), values_(g.size()), undefined_(g.size(), 0) {
        auto const needed = operands_of(g, outputs);
        for (std::size_t k = 0; k < g.size(); ++k) {
            if (needed[k]) order_.push_back(static_cast<node_id>(k));
        }
    }

    void evaluate(leaf_ranges const& at) {
        for (auto const i : order_) {
            auto const& n = (*graph_)[i];
            bool undefined = false;
            if (is_leaf(n.op)) {
                values_[i] = leaf(n, at);
            } else {
                auto const b = is_binary(n.op) ? n.b : n.a;
                values_[i] = apply<proven_arithmetic<interval>>(n.op, values_[n.a], values_[b],
                                                                n.index, undefined);
                undefined = undefined || undefined_[n.a] != 0 || undefined_[b] != 0;
            }
            undefined_[i] = undefined ? 1 : 0;
        }
    }

    [[nodiscard]] interval const& value(node_id i) const { return values_[i]; }
    /// Whether the node, or anything it is made of, may be undefined somewhere in the box.
    [[nodiscard]] bool undefined(node_id i) const { return undefined_[i] != 0; }

private:
    [[nodiscard]] interval leaf(node const& n, leaf_ranges const& at) const {
        auto const k = static_cast<std::size_t>(n.index);
        switch (n.op) {
        case operation::time:
            return at.time;
        case operation::state:
            return at.states[k];
        case operation::constant:
            return at.constants[k];
        case operation::input:
            return at.inputs[k];
        default:
            return graph_->value(n).enclosure;
        }
    }

    graph const* graph_;
    std::vector<node_id> order_;
    std::vector<interval> values_;
    std::vector<char> undefined_;
};

} // namespace sivid

#endif
