// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_GRAPH_TAPE_HPP
#define SIVID_MODEL_GRAPH_TAPE_HPP

#include <sivid/model/graph/graph.hpp>
#include <sivid/model/graph/rewrite.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace sivid {

/// One instruction: a node with its operands as slots.
struct instruction {
    operation op = operation::literal;
    std::size_t target = 0, a = 0, b = 0, companion = 0;
    int index = 0;
    bool a_varies = false; ///< the operand changes with time, state or input
    bool b_varies = false;
    /// Of a sum: its terms in the tape; empty for everything else.
    std::size_t first_term = 0, last_term = 0;
    /// It is the slope of a hyperbolic tangent: 1 - tanh^2 of this slot.
    std::optional<std::size_t> tanh_slope_at{};

    [[nodiscard]] bool is_sum() const { return first_term != last_term; }
};

/// + a, - a, + a b or - a b.
struct sum_term {
    std::size_t a = 0, b = 0;
    bool product = false;
    bool minus = false;
    bool a_varies = false, b_varies = false;
};

/// The part of a graph that some outputs need, as three straight-line programs: literals, what
/// depends on the parameters alone, and what varies along a trajectory. There, additions and the
/// products that only they use are gathered into sums of products, which are evaluated in one go.
class tape {
public:
    tape() = default;
    /// @param principal  so many of the outputs come first: what they need stands before what only
    ///                   the others need
    tape(graph const& g, std::vector<node_id> const& outputs,
         std::size_t principal = std::numeric_limits<std::size_t>::max()) {
        source const from(g, outputs);
        slots_ = from.slots;
        for (std::size_t k = 0; k < g.size(); ++k) {
            if (from.has_slot(k)) add_instruction(from, static_cast<node_id>(k));
        }
        auto const end =
            outputs.begin() + static_cast<std::ptrdiff_t>(std::min(principal, outputs.size()));
        put_first(from, reachable(g, {outputs.begin(), end}));
        for (auto const i : outputs) {
            outputs_.push_back(from.slot[i]);
            output_varies_.push_back(from.varies(i));
        }
        find_histories(principal >= outputs.size() ? 0 : principal);
    }

    [[nodiscard]] std::size_t slots() const { return slots_; }
    [[nodiscard]] std::vector<literal> const& literals() const { return literals_; }
    [[nodiscard]] std::vector<std::size_t> const& literal_slots() const { return literal_slots_; }
    [[nodiscard]] std::vector<instruction> const& constant() const { return constant_; }
    [[nodiscard]] std::vector<instruction> const& varying() const { return varying_; }
    /// Whether the recurrences need all coefficients of a slot; of the others only the last one is
    /// read. Outputs are kept, but for principal ones in front of others: they are read at once.
    [[nodiscard]] bool keeps_history(std::size_t slot) const { return history_[slot]; }
    /// Whether a slot's coefficients are convolved with others'.
    [[nodiscard]] bool convolved(std::size_t slot) const { return convolved_[slot]; }
    /// How many of `constant()` and of `varying()` the principal outputs need: the first ones.
    [[nodiscard]] std::size_t principal_constant() const { return principal_constant_; }
    [[nodiscard]] std::size_t principal_varying() const { return principal_varying_; }
    [[nodiscard]] sum_term const* terms(instruction const& i) const {
        return terms_.data() + i.first_term;
    }
    /// Slot of each output, in the order given.
    [[nodiscard]] std::size_t output(std::size_t k) const { return outputs_[k]; }
    [[nodiscard]] bool output_varies(std::size_t k) const { return output_varies_[k]; }

private:
    static bool is_additive(operation op) {
        return op == operation::add || op == operation::sub || op == operation::neg;
    }
    /// Additions and products whose value only one other addition needs.
    template <class Varies>
    static std::vector<bool> gathered_nodes(graph const& g, std::vector<bool> const& needed,
                                            std::vector<node_id> const& outputs,
                                            Varies const& varies) {
        std::vector<std::size_t> uses(g.size(), 0), additions(g.size(), 0);
        for (std::size_t k = 0; k < g.size(); ++k) {
            auto const& n = g[static_cast<node_id>(k)];
            if (!needed[k] || is_leaf(n.op)) continue;
            bool const sum = is_additive(n.op) && varies(static_cast<node_id>(k));
            auto const use = [&](node_id i) {
                ++uses[i];
                additions[i] += sum ? 1 : 0;
            };
            use(n.a);
            if (is_binary(n.op)) use(n.b);
            ++uses[n.companion];
        }
        for (auto const i : outputs) ++uses[i];
        std::vector<bool> result(g.size(), false);
        for (std::size_t k = 0; k < g.size(); ++k) {
            auto const i = static_cast<node_id>(k);
            auto const op = g[i].op;
            result[k] = needed[k] && varies(i) && uses[k] == 1 && additions[k] == 1 &&
                        (is_additive(op) || op == operation::mul);
        }
        return result;
    }

    /// A graph, and which of its nodes have slots.
    struct source {
        graph const& g;
        std::vector<bool> needed, gathered;
        std::vector<std::size_t> slot;
        std::size_t slots = 0;
        std::vector<std::optional<std::size_t>> tanh_slope_at;

        source(graph const& from, std::vector<node_id> const& outputs)
            : g(from),
              needed(reachable(from, outputs)),
              slot(from.size(), 0),
              tanh_slope_at(from.size()) {
            gathered = gathered_nodes(g, needed, outputs, [this](node_id i) { return varies(i); });
            for (std::size_t k = 0; k < g.size(); ++k) {
                if (has_slot(k)) slot[k] = slots++;
            }
            for (std::size_t k = 0; k < g.size(); ++k) {
                auto const& n = g[static_cast<node_id>(k)];
                if (needed[k] && n.op == operation::tanh) tanh_slope_at[n.companion] = slot[n.a];
            }
        }
        [[nodiscard]] bool varies(node_id i) const { return (g.depends(i) & ~on_constant) != 0; }
        [[nodiscard]] bool has_slot(std::size_t k) const { return needed[k] && !gathered[k]; }
    };

    void add_instruction(source const& from, node_id i) {
        auto const& n = from.g[i];
        instruction c;
        c.tanh_slope_at = from.tanh_slope_at[i];
        c.op = n.op;
        c.target = from.slot[i];
        c.index = n.index;
        if (!is_leaf(n.op)) {
            c.a = from.slot[n.a];
            c.b = from.slot[n.b];
            c.companion = from.slot[n.companion];
            c.a_varies = from.varies(n.a);
            c.b_varies = from.varies(n.b);
        }
        if (is_additive(n.op) && from.varies(i)) {
            c.first_term = terms_.size();
            gather(from, i, false);
            c.last_term = terms_.size();
        }
        if (n.op == operation::literal) {
            literals_.push_back(from.g.value(n));
            literal_slots_.push_back(c.target);
        } else if (from.varies(i)) {
            varying_.push_back(c);
        } else {
            constant_.push_back(c);
        }
    }
    /// The terms of a sum, or a product that is one.
    void gather(source const& from, node_id i, bool minus) {
        auto const& n = from.g[i];
        auto const add = [&](node_id child, bool flipped) {
            if (from.gathered[child]) return gather(from, child, flipped);
            terms_.push_back({from.slot[child], 0, false, flipped, from.varies(child), false});
        };
        switch (n.op) {
        case operation::neg:
            return add(n.a, !minus);
        case operation::add:
        case operation::sub:
            add(n.a, minus);
            return add(n.b, minus != (n.op == operation::sub));
        default: // a product
            terms_.push_back(
                {from.slot[n.a], from.slot[n.b], true, minus, from.varies(n.a), from.varies(n.b)});
        }
    }
    /// What the principal outputs need goes in front of the rest.
    void put_first(source const& from, std::vector<bool> const& first) {
        std::vector<bool> early(slots_, false);
        for (std::size_t k = 0; k < first.size(); ++k) {
            if (from.has_slot(k)) early[from.slot[k]] = first[k];
        }
        auto const is_early = [&](instruction const& i) { return early[i.target]; };
        for (auto* part : {&constant_, &varying_}) {
            auto const middle = std::stable_partition(part->begin(), part->end(), is_early);
            (part == &constant_ ? principal_constant_ : principal_varying_) =
                static_cast<std::size_t>(middle - part->begin());
        }
    }

    void find_histories(std::size_t first_kept_output) {
        history_.assign(slots_, false);
        auto const keep = [this](std::size_t slot) { history_[slot] = true; };
        for (std::size_t k = first_kept_output; k < outputs_.size(); ++k) keep(outputs_[k]);
        convolved_.assign(slots_, false);
        auto const convolve = [&](std::size_t slot) {
            keep(slot);
            convolved_[slot] = true;
        };
        for (auto const& t : terms_) {
            if (!t.a_varies || !t.b_varies) continue;
            convolve(t.a);
            convolve(t.b);
        }
        // What comes later is evaluated when the principal part has gone on to higher orders.
        std::vector<bool> principal(slots_, false);
        for (std::size_t k = 0; k < varying_.size(); ++k) {
            auto const& i = varying_[k];
            if (k < principal_varying_) {
                principal[i.target] = true;
                continue;
            }
            auto const read = [&](std::size_t slot) {
                if (principal[slot]) keep(slot);
            };
            for (auto n = i.first_term; n < i.last_term; ++n) {
                read(terms_[n].a);
                if (terms_[n].product) read(terms_[n].b);
            }
            if (is_leaf(i.op) || i.is_sum()) continue;
            read(i.a);
            if (is_binary(i.op)) read(i.b);
            read(i.companion);
        }
        for (auto const& i : varying_) {
            if (is_leaf(i.op) || i.is_sum()) continue;
            bool const convolved = i.op != operation::mul || (i.a_varies && i.b_varies);
            bool const divided = i.op == operation::div || i.op == operation::sqrt;
            if (convolved && !divided) convolve(i.a);
            if (convolved && is_binary(i.op)) convolve(i.b);
            if (convolved) convolve(i.companion);
            if (i.op != operation::mul && i.op != operation::sqr) convolve(i.target);
        }
    }

    std::size_t slots_ = 0;
    std::vector<bool> history_, convolved_;
    std::size_t principal_constant_ = 0, principal_varying_ = 0;
    std::vector<literal> literals_;
    std::vector<std::size_t> literal_slots_;
    std::vector<instruction> constant_;
    std::vector<instruction> varying_;
    std::vector<sum_term> terms_;
    std::vector<std::size_t> outputs_;
    std::vector<bool> output_varies_;
};

} // namespace sivid

#endif
