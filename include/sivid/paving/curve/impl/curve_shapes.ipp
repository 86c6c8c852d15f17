// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_CURVE_IMPL_CURVE_SHAPES_IPP
#define SIVID_PAVING_CURVE_IMPL_CURVE_SHAPES_IPP

#include <sivid/paving/curve/curve_shapes.hpp>

#include <cstddef>
#include <vector>

namespace sivid {

SIVID_DECL node_id curve_shapes::in(graph& g, node_id z, std::vector<node_id> const& theta) const {
    auto const x = g.binary(operation::mul, g.binary(operation::sub, z, g.constant(centre)),
                            g.constant(scale));
    std::vector<node_id> powers; // their coefficients
    for (std::size_t k = 0; k < mean.size(); ++k) {
        auto sum = g.constant(mean[k]);
        for (std::size_t j = 0; j < theta.size(); ++j) {
            if (shapes[j][k] == 0) continue;
            sum = g.binary(operation::add, sum,
                           g.binary(operation::mul, g.constant(shapes[j][k]), theta[j]));
        }
        powers.push_back(sum);
    }
    auto const none = [&](std::size_t first) {
        for (std::size_t k = first; k < powers.size(); k += 2) {
            if (!g.is(powers[k], 0)) return false;
        }
        return true;
    };
    bool const odd = none(0), even = none(1);
    auto const step = odd || even ? g.unary(operation::sqr, x) : x;
    auto sum = g.constant(0.0);
    for (std::size_t k = powers.size(); k-- > 0;) {
        if ((odd && k % 2 == 0) || (even && k % 2 == 1)) continue;
        sum = g.binary(operation::add, g.binary(operation::mul, sum, step), powers[k]);
    }
    return odd ? g.binary(operation::mul, sum, x) : sum;
}

} // namespace sivid

#endif
