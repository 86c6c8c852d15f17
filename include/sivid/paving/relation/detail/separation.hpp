// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_DETAIL_SEPARATION_HPP
#define SIVID_PAVING_RELATION_DETAIL_SEPARATION_HPP

#include <sivid/model/graph/graph.hpp>
#include <sivid/model/graph/graph_range.hpp>
#include <sivid/model/graph/normal_form.hpp>

#include <cstddef>
#include <limits>
#include <vector>

namespace sivid {

/// \f$ \theta \f$: a product of powers of nodes that depend on unknown constants only.
using parameter_product = node_product;

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
    multiplied_out<function_coefficients> multiplied(
        function_coefficients(g), {std::numeric_limits<std::size_t>::max(), most_terms});
    for (auto const& [theta, f] : multiplied(root)) {
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
