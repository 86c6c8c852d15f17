// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_GRAPH_GRAPH_RANGE_HPP
#define SIVID_MODEL_GRAPH_GRAPH_RANGE_HPP

#include <sivid/model/graph/arithmetic.hpp>
#include <sivid/model/graph/graph.hpp>
#include <sivid/model/graph/program.hpp>
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
    graph_range(graph const& g, std::vector<node_id> const& outputs)
        : program_(g, outputs), values_(program_.memory<arithmetic>()), undefined_(g.size(), 0) {}

    void evaluate(leaf_ranges const& at) {
        program_.read(values_, [&at](operation op, std::size_t k) -> interval const& {
            return op == operation::time       ? at.time
                   : op == operation::state    ? at.states[k]
                   : op == operation::constant ? at.constants[k]
                                               : at.inputs[k];
        });
        program_.run<arithmetic>(values_, [this](program::step const& s, bool undefined) {
            undefined_[s.target] = undefined || undefined_[s.a] != 0 || undefined_[s.b] != 0;
        });
    }

    [[nodiscard]] interval const& value(node_id i) const { return values_[i]; }
    /// Whether the node, or anything it is made of, may be undefined somewhere in the box.
    [[nodiscard]] bool undefined(node_id i) const { return undefined_[i] != 0; }

private:
    using arithmetic = proven_arithmetic<interval>;

    program program_;
    std::vector<interval> values_;
    std::vector<char> undefined_;
};

} // namespace sivid

#endif
