// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_CURVE_IMPL_CURVE_SHAPES_IPP
#define SIVID_PAVING_CURVE_IMPL_CURVE_SHAPES_IPP

#include <sivid/paving/curve/curve_shapes.hpp>

#include <sivid/model/expression.hpp>
#include <sivid/paving/curve/detail/principal_shapes.hpp>

#include <cstddef>
#include <vector>

namespace sivid {

SIVID_DECL node_id curve_shapes::in(graph& g, node_id z, std::vector<node_id> const& theta) const {
    std::vector<expression> powers; // their coefficients
    for (std::size_t k = 0; k < mean.size(); ++k) {
        expression sum(g, g.constant(mean[k]));
        for (std::size_t j = 0; j < theta.size(); ++j) {
            if (shapes[j][k] != 0) sum = sum + shapes[j][k] * expression(g, theta[j]);
        }
        powers.push_back(sum);
    }
    auto const x = (expression(g, z) - centre) * scale;
    auto const none = [&](std::size_t k) { return g.is(powers[k].in(g), 0); };
    return paving_detail::horner(powers, none, x).in(g);
}

} // namespace sivid

#endif
