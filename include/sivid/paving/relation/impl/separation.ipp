// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_IMPL_SEPARATION_IPP
#define SIVID_PAVING_RELATION_IMPL_SEPARATION_IPP

#include <sivid/paving/relation/detail/separation.hpp>

#include <limits>

namespace sivid {

SIVID_DECL interval range_of(parameter_product const& theta, graph_range const& over) {
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

SIVID_DECL separated_expression separate(graph& g, node_id root, std::size_t most_terms) {
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
