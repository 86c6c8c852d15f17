// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_GRAPH_NORMAL_FORM_HPP
#define SIVID_MODEL_GRAPH_NORMAL_FORM_HPP

#include <sivid/model/graph/graph.hpp>
#include <sivid/model/graph/rewrite.hpp>

#include <cstddef>
#include <cstdlib>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace sivid {

/// \f$ \prod_k a_k^{e_k} \f$: powers of nodes in the order of the nodes, none of them 0; empty for
/// 1.
using node_product = std::vector<std::pair<node_id, int>>;

/// \f$ a b^{sign} \f$, in which common factors cancel.
/// @given  powers up to `most_power`
[[nodiscard]] inline node_product quotient(node_product const& a, node_product const& b,
                                           int sign = -1) {
    std::map<node_id, int> powers(a.begin(), a.end());
    for (auto const& [node, e] : b) powers[node] += sign * e;
    node_product result;
    for (auto const& factor : powers) {
        if (factor.second != 0) result.push_back(factor);
    }
    return result;
}

/// The nodes of a graph as sums of products: those under products are multiplied out, terms with
/// the same factors are one. What is no sum, product, quotient by a single term or power, or would
/// have too many terms, is indivisible.
/// @tparam Coefficients  what stands before the products, and which nodes are the factors:
///   - `value`, `g()` the graph
///   - `known(node)`  the coefficient that a node is, if it is one
///   - `is_variable(node)`, `whole(node)`: an indivisible node is a factor, or else a coefficient
///   - `one()`, `is_zero(v)`, `neg(v)`, `sum(v, w)`, `product(v, w)`, `quotient(v, w)`, `power(v,
///     n)`, which may have no result
/// @guarantee  each sum equals its node wherever both are defined
/// @cost  at most so many products a node, no recursion
template <class Coefficients>
class multiplied_out {
public:
    using value = typename Coefficients::value;
    using terms = std::map<node_product, value>;

    struct limits {
        std::size_t terms, products; ///< of one node
    };
    multiplied_out(Coefficients coefficients, limits most)
        : c_(std::move(coefficients)), most_(most) {}

    /// The terms of a node, which stay where they are.
    terms const& operator()(node_id root) {
        if (auto const known = done_.find(root); known != done_.end()) return known->second;
        auto const needed = operands_of(c_.g(), {root}); // the graph may grow meanwhile
        for (std::size_t k = 0; k <= root; ++k) {
            auto const i = static_cast<node_id>(k);
            if (!needed[k] || done_.count(i) > 0) continue;
            auto found = expand(i);
            if (!found || found->size() > most_.terms) {
                if (!is_leaf(c_.g()[i].op)) opaque_.insert(i), indivisible_.insert(i);
                found = whole(i);
            }
            done_[i] = std::move(*found);
        }
        return done_.at(root);
    }
    /// Nodes that were taken as a whole, as factor or coefficient: functions, long sums, divisors
    /// of several terms.
    [[nodiscard]] std::set<node_id> const& opaque() const { return opaque_; }
    /// Whether a node has no terms but itself.
    [[nodiscard]] bool indivisible(node_id i) const { return indivisible_.count(i) > 0; }

    /// Adds a multiple. @returns false when a coefficient has no result (`to` is meaningless then)
    [[nodiscard]] bool add(terms& to, terms const& more, value const& factor) {
        for (auto const& [product, v] : more) {
            auto const scaled = c_.product(v, factor);
            if (!scaled || !put(to, product, *scaled)) return false;
        }
        return true;
    }
    [[nodiscard]] std::optional<terms> product(terms const& a, terms const& b) {
        if (a.size() * b.size() > most_.products) return std::nullopt;
        terms result;
        for (auto const& [left, v] : a) {
            for (auto const& [right, w] : b) {
                auto const both = c_.product(v, w);
                auto const factors = quotient(left, right, 1);
                if (!both || !is_small(factors) || !put(result, factors, *both))
                    return std::nullopt;
            }
        }
        return result;
    }

private:
    static bool is_small(node_product const& p) {
        for (auto const& factor : p) {
            if (std::abs(factor.second) > most_power) return false;
        }
        return true;
    }
    [[nodiscard]] bool put(terms& to, node_product const& product, value const& v) {
        auto const [at, fresh] = to.try_emplace(product, v);
        if (!fresh) {
            auto const both = c_.sum(at->second, v);
            if (!both) return false;
            at->second = *both;
        }
        if (c_.is_zero(at->second)) to.erase(at);
        return true;
    }
    [[nodiscard]] terms whole(node_id i) {
        if (c_.is_variable(i)) return {{{{i, 1}}, c_.one()}};
        return {{{}, c_.whole(i)}};
    }

    [[nodiscard]] std::optional<terms> expand(node_id i) {
        if (auto const v = c_.known(i)) {
            return c_.is_zero(*v) ? terms{} : terms{{{}, *v}};
        }
        auto const n = c_.g()[i]; // a copy: building moves the nodes
        if (is_leaf(n.op)) return whole(i);
        auto const& a = done_.at(n.a);
        switch (n.op) {
        case operation::neg:
            return sum({}, a, true);
        case operation::add:
            return sum(a, done_.at(n.b), false);
        case operation::sub:
            return sum(a, done_.at(n.b), true);
        case operation::mul:
            return product(a, done_.at(n.b));
        case operation::div:
            return divided(a, n.b);
        case operation::sqr:
            return power(a, 2);
        case operation::pown:
            return power(a, n.index);
        default:
            return std::nullopt;
        }
    }
    [[nodiscard]] std::optional<terms> sum(terms to, terms const& more, bool minus) {
        for (auto const& [product, v] : more) {
            auto const own = minus ? c_.neg(v) : std::optional(v);
            if (!own || !put(to, product, *own)) return std::nullopt;
        }
        return to;
    }
    [[nodiscard]] std::optional<terms> divided(terms const& above, node_id divisor) {
        auto below = done_.at(divisor);
        if (below.empty()) return std::nullopt;
        if (below.size() > 1) {
            opaque_.insert(divisor);
            below = whole(divisor);
        }
        auto const& [factors_below, w] = *below.begin();
        terms result;
        for (auto const& [product, v] : above) {
            auto const ratio = c_.quotient(v, w);
            auto const factors = quotient(product, factors_below);
            if (!ratio || !is_small(factors) || !put(result, factors, *ratio)) return std::nullopt;
        }
        return result;
    }
    [[nodiscard]] std::optional<terms> power(terms const& base, int e) {
        if (e < 1 || e > most_power) return std::nullopt;
        if (base.size() == 1) {
            auto factors = base.begin()->first;
            for (auto& factor : factors) {
                if (std::abs(factor.second) > most_power / e) return std::nullopt;
                factor.second *= e;
            }
            auto const own = c_.power(base.begin()->second, e);
            return own ? std::optional(terms{{std::move(factors), *own}}) : std::nullopt;
        }
        auto result = std::optional(base);
        for (int k = 1; k < e && result; ++k) {
            result = product(*result, base);
            if (result && result->size() > most_.terms) return std::nullopt;
        }
        return result;
    }

    Coefficients c_;
    limits most_;
    std::map<node_id, terms> done_;
    std::set<node_id> opaque_, indivisible_;
};

/// Nodes of the same graph as coefficients: products of what depends on unknown constants alone,
/// times functions of everything else, in which constants are left where they do not separate.
class function_coefficients {
public:
    using value = node_id;

    /// @param g  to which nodes are added
    explicit function_coefficients(graph& g) : g_(&g) {}

    [[nodiscard]] graph const& g() const { return *g_; }
    [[nodiscard]] std::optional<node_id> known(node_id i) const {
        return (g_->depends(i) & on_constant) == 0 ? std::optional(i) : std::nullopt;
    }
    [[nodiscard]] bool is_variable(node_id i) const { return g_->depends(i) == on_constant; }
    [[nodiscard]] node_id whole(node_id i) const { return i; }
    [[nodiscard]] node_id one() { return g_->constant(1.0); }
    [[nodiscard]] bool is_zero(node_id i) const { return g_->is(i, 0); }
    [[nodiscard]] std::optional<node_id> neg(node_id i) { return g_->neg(i); }
    [[nodiscard]] std::optional<node_id> sum(node_id i, node_id j) { return g_->add(i, j); }
    [[nodiscard]] std::optional<node_id> product(node_id i, node_id j) { return g_->mul(i, j); }
    [[nodiscard]] std::optional<node_id> quotient(node_id i, node_id j) { return g_->div(i, j); }
    [[nodiscard]] std::optional<node_id> power(node_id i, int n) { return g_->pown(i, n); }

private:
    graph* g_;
};

} // namespace sivid

#endif
