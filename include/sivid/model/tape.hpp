// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_TAPE_HPP
#define SIVID_MODEL_TAPE_HPP

#include <sivid/model/graph.hpp>
#include <sivid/model/rewrite.hpp>

#include <cstddef>
#include <vector>

namespace sivid {

/// One instruction: a node with its operands as slots.
struct instruction {
    operation op = operation::literal;
    std::size_t target = 0, a = 0, b = 0, companion = 0;
    int index = 0;
    bool a_varies = false; ///< the operand changes with time, state or input
    bool b_varies = false;
};

/// The part of a graph that some outputs need, as three straight-line programs: literals, what
/// depends on the parameters alone, and what varies along a trajectory.
class tape {
public:
    tape() = default;
    tape(graph const& g, std::vector<node_id> const& outputs) {
        auto const needed = reachable(g, outputs);
        std::vector<std::size_t> slot(g.size(), 0);
        for (std::size_t k = 0; k < g.size(); ++k) {
            if (needed[k]) slot[k] = slots_++;
        }
        auto const varies = [&g](node_id i) { return (g.depends(i) & ~on_constant) != 0; };
        for (std::size_t k = 0; k < g.size(); ++k) {
            if (!needed[k]) continue;
            auto const i = static_cast<node_id>(k);
            auto const& n = g[i];
            instruction c;
            c.op = n.op;
            c.target = slot[k];
            c.index = n.index;
            if (!is_leaf(n.op)) {
                c.a = slot[n.a];
                c.b = slot[n.b];
                c.companion = slot[n.companion];
                c.a_varies = varies(n.a);
                c.b_varies = varies(n.b);
            }
            if (n.op == operation::literal) {
                literals_.push_back(g.value(n));
                literal_slots_.push_back(c.target);
            } else if (varies(i)) {
                varying_.push_back(c);
            } else {
                constant_.push_back(c);
            }
            if (has_kink(n.op)) has_kinks_ = true;
        }
        for (auto const i : outputs) {
            outputs_.push_back(slot[i]);
            output_varies_.push_back(varies(i));
        }
    }

    [[nodiscard]] std::size_t slots() const { return slots_; }
    [[nodiscard]] std::vector<literal> const& literals() const { return literals_; }
    [[nodiscard]] std::vector<std::size_t> const& literal_slots() const { return literal_slots_; }
    [[nodiscard]] std::vector<instruction> const& constant() const { return constant_; }
    [[nodiscard]] std::vector<instruction> const& varying() const { return varying_; }
    /// Slot of each output, in the order given.
    [[nodiscard]] std::size_t output(std::size_t k) const { return outputs_[k]; }
    [[nodiscard]] bool output_varies(std::size_t k) const { return output_varies_[k]; }
    [[nodiscard]] bool has_kinks() const { return has_kinks_; }

private:
    std::size_t slots_ = 0;
    std::vector<literal> literals_;
    std::vector<std::size_t> literal_slots_;
    std::vector<instruction> constant_;
    std::vector<instruction> varying_;
    std::vector<std::size_t> outputs_;
    std::vector<bool> output_varies_;
    bool has_kinks_ = false;
};

} // namespace sivid

#endif
