// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_SEPARATION_HPP
#define SIVID_DIAGNOSIS_SEPARATION_HPP

#include <sivid/diagnosis/graph_range.hpp>
#include <sivid/model/graph.hpp>

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// \f$ \theta = \prod_k a_k^{e_k} \f$: a product of powers of nodes that depend on unknown
/// constants only, in the order of the nodes; empty for 1.
using parameter_product = std::vector<std::pair<node_id, int>>;

/// The quotient of two products, in which common factors cancel.
[[nodiscard]] inline parameter_product quotient(parameter_product const& a,
                                                parameter_product const& b, int sign = -1) {
    std::map<node_id, int> powers;
    for (auto const& [atom, e] : a) powers[atom] += e;
    for (auto const& [atom, e] : b) powers[atom] += sign * e;
    parameter_product result;
    for (auto const& [atom, e] : powers) {
        if (e != 0) result.emplace_back(atom, e);
    }
    return result;
}

/// Encloses a product over the ranges of its factors; the whole line where it has poles.
[[nodiscard]] inline interval range_of(parameter_product const& theta, graph_range const& over) {
    using traits = interval_traits<interval>;
    bool undefined = false;
    auto above = traits::point(1.0);
    auto below = traits::point(1.0);
    for (auto const& [atom, e] : theta) {
        undefined = undefined || over.undefined(atom);
        auto& side = e > 0 ? above : below;
        side = traits::mul(side, traits::pown(over.value(atom), e > 0 ? e : -e, undefined));
    }
    auto const value = traits::div(above, below, undefined);
    return undefined ? traits::entire() : value;
}

/// \f$ \theta \phi \f$: an unknown coefficient times a known function of time, states and inputs.
struct separated_term {
    parameter_product theta;
    node_id function = 0;
};

/// \f$ f = \phi_0 + \sum_j \theta_j \phi_j \f$, an expression split by its unknown coefficients.
struct separated_expression {
    node_id rest = 0; ///< \f$ \phi_0 \f$
    std::vector<separated_term> terms;
    /// What would not separate: nodes that stay in some \f$ \phi \f$ and depend on unknown
    /// constants there. They have to be evaluated over the prior.
    bool complete = true;
};

namespace diagnosis_detail {

using term_map = std::map<parameter_product, node_id>;

/// Separates the nodes of one graph bottom up.
class separator {
public:
    separator(graph& g, std::size_t most_terms) : graph_(&g), most_terms_(most_terms) {}

    term_map separate(node_id root) {
        if (auto const found = done_.find(root); found != done_.end()) return found->second;
        auto const n = (*graph_)[root]; // a copy: building moves the nodes
        auto const flags = graph_->depends(root);
        term_map result;
        if ((flags & on_constant) == 0) {
            put(result, {}, root);
        } else if (n.op == operation::constant) {
            put(result, {{root, 1}}, graph_->constant(1.0));
        } else {
            result = operate(root, n, flags == on_constant);
        }
        return done_[root] = result;
    }

private:
    void put(term_map& terms, parameter_product const& theta, node_id f) {
        auto const [at, fresh] = terms.emplace(theta, f);
        if (!fresh) at->second = graph_->add(at->second, f);
        if (graph_->is(at->second, 0)) terms.erase(at);
    }
    term_map left_as_it_is(node_id i, bool parameters_only) {
        if (parameters_only) return {{{{i, 1}}, graph_->constant(1.0)}};
        return {{{}, i}};
    }

    term_map operate(node_id i, node const& n, bool parameters_only) {
        switch (n.op) {
        case operation::neg: {
            auto result = separate(n.a);
            for (auto& [theta, f] : result) f = graph_->neg(f);
            return result;
        }
        case operation::add:
        case operation::sub: {
            auto result = separate(n.a);
            for (auto const& [theta, f] : separate(n.b)) {
                put(result, theta, n.op == operation::add ? f : graph_->neg(f));
            }
            return result;
        }
        case operation::mul:
            return product(i, separate(n.a), separate(n.b), parameters_only);
        case operation::div:
            return ratio(n);
        case operation::sqr:
            return power(i, n.a, 2, parameters_only);
        case operation::pown:
            return power(i, n.a, n.index, parameters_only);
        default:
            return left_as_it_is(i, parameters_only);
        }
    }

    term_map product(node_id i, term_map const& a, term_map const& b, bool parameters_only) {
        if (a.size() * b.size() > most_terms_) return left_as_it_is(i, parameters_only);
        term_map result;
        for (auto const& [theta_a, f] : a) {
            for (auto const& [theta_b, h] : b) {
                put(result, quotient(theta_a, theta_b, 1), graph_->mul(f, h));
            }
        }
        return result;
    }

    /// Divides every term by the denominator if that is one term, a parameter-only factor, or else
    /// by the denominator as it is.
    term_map ratio(node const& n) {
        auto const below = separate(n.b);
        parameter_product theta_below;
        auto divisor = n.b;
        if (below.size() == 1) {
            theta_below = below.begin()->first;
            divisor = below.begin()->second;
        } else if (graph_->depends(n.b) == on_constant) {
            theta_below = {{n.b, 1}};
            divisor = graph_->constant(1.0);
        }
        term_map result;
        for (auto const& [theta, f] : separate(n.a)) {
            put(result, quotient(theta, theta_below), graph_->div(f, divisor));
        }
        return result;
    }

    term_map power(node_id i, node_id base, int e, bool parameters_only) {
        auto const terms = separate(base);
        if (e < 1) return left_as_it_is(i, parameters_only);
        if (terms.size() == 1) {
            auto theta = terms.begin()->first;
            for (auto& factor : theta) factor.second *= e;
            return {{theta, graph_->pown(terms.begin()->second, e)}};
        }
        auto result = terms;
        for (int k = 1; k < e; ++k) {
            if (result.size() * terms.size() > most_terms_)
                return left_as_it_is(i, parameters_only);
            result = product(i, result, terms, parameters_only);
        }
        return result;
    }

    graph* graph_;
    std::size_t most_terms_;
    std::map<node_id, term_map> done_;
};

} // namespace diagnosis_detail

/// Splits a node into terms that are linear in products of unknown constants: sums under products
/// are multiplied out, divisions by factors of constants only go into \f$ \theta \f$. What does not
/// separate (a constant inside a sine, say) stays in the functions.
///   New nodes are added to `g`.
/// @guarantee  \f$ \phi_0 + \sum \theta_j \phi_j \f$ equals the node's value wherever both are
///             defined; no two terms have the same \f$ \theta_j \f$
/// @cost  at most `most_terms` products for each node
[[nodiscard]] inline separated_expression separate(graph& g, node_id root,
                                                   std::size_t most_terms = 64) {
    separated_expression result;
    result.rest = g.constant(0.0);
    for (auto const& [theta, f] : diagnosis_detail::separator(g, most_terms).separate(root)) {
        result.complete = result.complete && (g.depends(f) & on_constant) == 0;
        if (theta.empty()) {
            result.rest = f;
        } else {
            result.terms.push_back({theta, f});
        }
    }
    return result;
}

} // namespace sivid

#endif
