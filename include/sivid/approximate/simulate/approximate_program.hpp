// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_SIMULATE_APPROXIMATE_PROGRAM_HPP
#define SIVID_APPROXIMATE_SIMULATE_APPROXIMATE_PROGRAM_HPP

#include <sivid/model/graph/detail/grouped_steps.hpp>
#include <sivid/model/graph/graph.hpp>
#include <sivid/model/graph/program.hpp>
#include <sivid/model/graph/rewrite.hpp>

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace sivid {

/// Where a program in doubles finds its arguments: t, then the states, the inputs, the constants.
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
class approximate_program {
public:
    approximate_program() = default;
    approximate_program(graph const& g, std::vector<node_id> const& outputs, program_shape shape)
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
        auto steps = program(g, varying, place, size).steps();
        std::vector<bool> steady(size, false); // per slot
        for (std::size_t k = 0; k < g.size(); ++k)
            if (needed[k] && !varying[k] && !is_moving(g.nodes()[k].op)) steady[slots[k]] = true;
        size = multiply_by_reciprocals(steps, steady, size);
        fixed_ = program(g, fixed, place, size);
        varying_ = grouped_steps(steps, size);
        for (auto const i : outputs) outputs_.push_back(slots[i]);
    }

    [[nodiscard]] program_shape const& shape() const { return shape_; }
    [[nodiscard]] std::vector<double> memory() const { return fixed_.memory<arithmetic>(); }
    [[nodiscard]] std::size_t output_count() const { return outputs_.size(); }
    /// Slot of an output.
    [[nodiscard]] std::size_t output(std::size_t k) const { return outputs_[k]; }
    /// After the constants have been written.
    void prepare(std::vector<double>& memory) const {
        fixed_.run<arithmetic>(memory);
        memory[one_] = 1;
        for (auto const& [target, of] : reciprocals_) memory[target] = 1 / memory[of];
    }
    /// After t, states and inputs have been written.
    void run(std::vector<double>& memory) const { varying_.run(memory); }

private:
    using arithmetic = approximate_arithmetic;
    using slot = program::slot;

    [[nodiscard]] static bool is_moving(operation op) {
        return op == operation::time || op == operation::state || op == operation::input;
    }
    /// Divisions by what is steady, and by what several divide by, become products: a division
    /// takes as long as four of them.
    /// @returns  the size of the memory with the reciprocals
    [[nodiscard]] std::size_t multiply_by_reciprocals(std::vector<program::step>& steps,
                                                      std::vector<bool> const& steady,
                                                      std::size_t size) {
        std::map<slot, int> divided;
        for (auto const& s : steps)
            if (s.op == operation::div) ++divided[s.b];
        std::map<slot, slot> reciprocal;
        std::vector<program::step> result;
        one_ = static_cast<slot>(size);
        for (auto s : steps) {
            if (s.op == operation::div && (steady[s.b] || divided[s.b] > 1)) {
                auto const [at, is_new] = reciprocal.try_emplace(s.b, static_cast<slot>(size + 1));
                if (is_new) {
                    ++size;
                    if (steady[s.b]) {
                        reciprocals_.push_back({at->second, s.b});
                    } else {
                        result.push_back({operation::div, 0, at->second, one_, s.b});
                    }
                }
                s.op = operation::mul;
                s.b = at->second;
            }
            result.push_back(s);
        }
        steps = std::move(result);
        return size + 1;
    }

    program_shape shape_;
    program fixed_;
    slot one_ = 0;                                   ///< where 1 is
    std::vector<std::pair<slot, slot>> reciprocals_; ///< of what is fixed
    grouped_steps varying_;
    std::vector<std::size_t> outputs_;
};

} // namespace sivid

#endif
