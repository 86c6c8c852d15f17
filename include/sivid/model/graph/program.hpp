// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_GRAPH_PROGRAM_HPP
#define SIVID_MODEL_GRAPH_PROGRAM_HPP

#include <sivid/model/graph/graph.hpp>
#include <sivid/model/graph/rewrite.hpp>
#include <sivid/work_clock.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sivid {

/// Nodes of a graph as straight-line code on numbered values, for any arithmetic: intervals, packs
/// of them, Taylor models, doubles. The memory belongs to the caller: made once, then leaves are
/// written and the code is run as often as wanted. Programs of one graph may share a memory; no
/// program needs the graph any more.
/// @tparam A  the arithmetic, as in `apply`
/// @guarantee  that of the arithmetic
/// @cost  one operation of the arithmetic a step
class program {
public:
    using slot = std::uint32_t; ///< place in the memory

    struct step {
        operation op;
        std::int32_t index;
        slot target, a, b;
    };
    struct leaf {
        operation op; ///< time, state, constant or input
        std::uint32_t index;
        slot target;
    };

    program() = default;
    /// What outputs are computed from, and they; the slots are the nodes.
    program(graph const& g, std::vector<node_id> const& outputs)
        : program(marked(g, operands_of(g, outputs))) {}
    /// @param wanted  per node; the slots are the nodes
    [[nodiscard]] static program marked(graph const& g, std::vector<bool> const& wanted) {
        return {g, wanted, [](std::size_t node) { return static_cast<slot>(node); }, g.size()};
    }
    /// @param place  (node) -> its slot below `size`, asked for wanted nodes and their operands
    template <class Place>
    program(graph const& g, std::vector<bool> const& wanted, Place const& place, std::size_t size)
        : size_(size) {
        for (std::size_t k = 0; k < g.size(); ++k) {
            if (!wanted[k]) continue;
            auto const& n = g.nodes()[k];
            if (n.op == operation::literal) {
                literals_.push_back({place(k), g.value(n)});
            } else if (is_leaf(n.op)) {
                leaves_.push_back({n.op, static_cast<std::uint32_t>(n.index), place(k)});
            } else {
                steps_.push_back(
                    {n.op, n.index, place(k), place(n.a), place(is_binary(n.op) ? n.b : n.a)});
            }
        }
    }

    [[nodiscard]] std::vector<step> const& steps() const { return steps_; }
    [[nodiscard]] std::vector<leaf> const& leaves() const { return leaves_; }

    /// Zeros, and the literals in place.
    template <class A>
    [[nodiscard]] std::vector<typename A::value_type> memory() const {
        std::vector<typename A::value_type> m(size_, A::point(0.0));
        for (auto const& l : literals_) m[l.target] = A::enclose(l.value);
        return m;
    }
    /// Writes all leaves.
    /// @param value  (operation, index)
    template <class Memory, class Value>
    void read(Memory& m, Value const& value) const {
        for (auto const& l : leaves_) m[l.target] = value(l.op, std::size_t{l.index});
    }
    /// @returns where something is not defined
    template <class A>
    typename A::mask run(std::vector<typename A::value_type>& memory) const {
        work_clock::count(steps_.size(), A::lanes * work_clock::interval);
        typename A::mask undefined{};
        auto* const m = memory.data();
        for (auto const& s : steps_) {
            m[s.target] = apply<A>(s.op, m[s.a], m[s.b], s.index, undefined);
        }
        return undefined;
    }
    /// @param each  (step, where it is not defined), after each step
    template <class A, class Each>
    void run(std::vector<typename A::value_type>& m, Each const& each) const {
        work_clock::count(steps_.size(), A::lanes * work_clock::interval);
        for (auto const& s : steps_) {
            typename A::mask undefined{};
            m[s.target] = apply<A>(s.op, m[s.a], m[s.b], s.index, undefined);
            each(s, undefined);
        }
    }

private:
    struct known {
        slot target;
        literal value;
    };
    std::size_t size_ = 0;
    std::vector<known> literals_;
    std::vector<leaf> leaves_;
    std::vector<step> steps_;
};

} // namespace sivid

#endif
