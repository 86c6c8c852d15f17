// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_GRAPH_PLAIN_PROGRAM_HPP
#define SIVID_MODEL_GRAPH_PLAIN_PROGRAM_HPP

#include <sivid/model/graph/graph.hpp>
#include <sivid/model/graph/program.hpp>
#include <sivid/model/graph/rewrite.hpp>

#include <cstddef>
#include <vector>

namespace sivid {

/// Where a plain program finds its arguments: t, then the states, the inputs, the constants.
struct program_shape {
    std::size_t states = 0, inputs = 0, constants = 0;

    [[nodiscard]] std::size_t state() const { return 1; }
    [[nodiscard]] std::size_t input() const { return 1 + states; }
    [[nodiscard]] std::size_t constant() const { return 1 + states + inputs; }
    [[nodiscard]] std::size_t size() const { return 1 + states + inputs + constants; }
    /// Of a leaf.
    [[nodiscard]] std::size_t argument(operation op, std::size_t index) const {
        return op == operation::state      ? state() + index
               : op == operation::input    ? input() + index
               : op == operation::constant ? constant() + index
                                           : 0;
    }
};

/// Some outputs of a graph as a straight-line program in plain doubles: fast, and not a proof.
///   The memory belongs to the caller: `memory()` once, then write constants and `prepare`, then
///   write t, states and inputs and `run` as often as wanted; read `memory[output(k)]`.
/// @cost  about a nanosecond an operation
class plain_program {
public:
    plain_program() = default;
    plain_program(graph const& g, std::vector<node_id> const& outputs, program_shape shape)
        : shape_(shape) {
        auto const needed = operands_of(g, outputs);
        std::vector<program::slot> slots(g.size(), 0);
        std::vector<bool> fixed(g.size(), false), varying(g.size(), false);
        std::size_t size = shape.size();
        for (std::size_t k = 0; k < g.size(); ++k) {
            if (!needed[k]) continue;
            auto const i = static_cast<node_id>(k);
            auto const& n = g[i];
            bool const is_argument = is_leaf(n.op) && n.op != operation::literal;
            slots[k] = static_cast<program::slot>(
                is_argument ? shape.argument(n.op, static_cast<std::size_t>(n.index)) : size++);
            if (is_argument) continue;
            bool const varies = (g.depends(i) & ~(on_constant | on_nothing)) != 0;
            (varies ? varying : fixed)[k] = true;
        }
        auto const place = [&](std::size_t k) { return slots[k]; };
        fixed_ = program(g, fixed, place, size);
        varying_ = program(g, varying, place, size);
        for (auto const i : outputs) outputs_.push_back(slots[i]);
    }

    [[nodiscard]] program_shape const& shape() const { return shape_; }
    [[nodiscard]] std::vector<double> memory() const { return fixed_.memory<arithmetic>(); }
    [[nodiscard]] std::size_t output_count() const { return outputs_.size(); }
    /// Slot of an output.
    [[nodiscard]] std::size_t output(std::size_t k) const { return outputs_[k]; }
    /// After the constants have been written.
    void prepare(std::vector<double>& memory) const { fixed_.run<arithmetic>(memory); }
    /// After t, states and inputs have been written.
    void run(std::vector<double>& memory) const { varying_.run<arithmetic>(memory); }

private:
    using arithmetic = approximate_arithmetic;

    program_shape shape_;
    program fixed_, varying_;
    std::vector<std::size_t> outputs_;
};

} // namespace sivid

#endif
