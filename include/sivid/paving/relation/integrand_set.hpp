// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_INTEGRAND_SET_HPP
#define SIVID_PAVING_RELATION_INTEGRAND_SET_HPP

#include <sivid/model/graph/differentiate.hpp>
#include <sivid/model/graph/graph.hpp>
#include <sivid/model/graph/rewrite.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <vector>

namespace sivid {

/// A state that is the exact derivative of another one: \f$ q' = r \f$.
struct derivative_pair {
    std::size_t r = 0, q = 0;
};

/// All pairs in the equations of motion, by q. Several states may have one rate: where a sum goes
/// over pairs, each r stands in it once.
[[nodiscard]] inline std::vector<derivative_pair> pairs_in(graph const& g,
                                                           std::vector<node_id> const& rates) {
    std::vector<derivative_pair> result;
    for (std::size_t q = 0; q < rates.size(); ++q) {
        auto const& n = g[rates[q]];
        auto const r = static_cast<std::size_t>(n.index);
        if (n.op == operation::state && r != q) result.push_back({r, q});
    }
    return result;
}

/// The first pair with this r.
[[nodiscard]] inline std::optional<derivative_pair>
pair_of_rate(std::vector<derivative_pair> const& pairs, std::size_t r) {
    auto const at = std::find_if(pairs.begin(), pairs.end(),
                                 [r](derivative_pair const& p) { return p.r == r; });
    return at == pairs.end() ? std::nullopt : std::optional(*at);
}

namespace paving_detail {

/// The same expression in which a product with 0 is 0 even where the other factor is not defined
/// everywhere; for derivatives, which are only used where their function is defined.
inline node_id without_zero_products(graph& g, node_id i, std::map<node_id, node_id>& done) {
    if (auto const found = done.find(i); found != done.end()) return found->second;
    auto const n = g[i]; // a copy: building moves the nodes
    auto result = i;
    if (!is_leaf(n.op)) {
        auto const a = without_zero_products(g, n.a, done);
        if (is_binary(n.op)) {
            auto const b = without_zero_products(g, n.b, done);
            bool const zero = n.op == operation::mul && (g.is(a, 0) || g.is(b, 0));
            bool const none = n.op == operation::div && g.is(a, 0);
            result = zero || none ? g.constant(0.0) : g.binary(n.op, a, b);
        } else {
            result = n.op == operation::pown ? g.pown(a, n.index) : g.unary(n.op, a);
        }
    }
    return done[i] = result;
}

} // namespace paving_detail

/// Functions of time, states and inputs with what their enclosures need: partial derivatives by
/// states, inputs and time, and which of them are differentiable in Clarke's sense (no jumps).
struct integrand_set {
    graph const* g = nullptr;
    std::vector<node_id> functions;
    std::vector<std::vector<node_id>> slopes; ///< [function][states, then inputs, then time]
    std::vector<bool> continuous;
    std::size_t states = 0, inputs = 0; ///< of the model

    /// Adds the derivatives to `g`, which must outlive the set.
    [[nodiscard]] static integrand_set of(graph& g, std::vector<node_id> const& functions,
                                          std::size_t states, std::size_t inputs) {
        integrand_set result;
        result.functions = functions;
        result.states = states;
        result.inputs = inputs;
        std::vector<node_id> x;
        for (std::size_t i = 0; i < states; ++i) x.push_back(g.leaf(operation::state, i));
        for (std::size_t i = 0; i < inputs; ++i) x.push_back(g.leaf(operation::input, i));
        x.push_back(g.leaf(operation::time, 0));
        for (auto const f : functions) {
            auto const needed = reachable(g, {f});
            bool jumps = false;
            for (std::size_t k = 0; k < needed.size(); ++k) {
                jumps = jumps || (needed[k] && g.nodes()[k].op == operation::sign);
            }
            result.continuous.push_back(!jumps);
        }
        result.slopes = differentiate(g, functions, x);
        std::map<node_id, node_id> done;
        for (auto& row : result.slopes) {
            for (auto& d : row) d = paving_detail::without_zero_products(g, d, done);
        }
        result.g = &g;
        return result;
    }
    [[nodiscard]] bool uses(std::size_t f, std::size_t state) const {
        return !g->is(slopes[f][state], 0);
    }
};

} // namespace sivid

#endif
