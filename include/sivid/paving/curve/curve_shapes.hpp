// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_CURVE_CURVE_SHAPES_HPP
#define SIVID_PAVING_CURVE_CURVE_SHAPES_HPP

#include <sivid/model/expression.hpp>
#include <sivid/model/graph/graph.hpp>
#include <sivid/paving/curve/detail/principal_shapes.hpp>
#include <sivid/space/box.hpp>

#include <cstddef>
#include <vector>

namespace sivid {

/// Curves g(z, p) of a family as a sum of a few shapes, linear in its coefficients:
///   \f[ g(z, p) \in m(x) + \sum_j \theta_j(p) \, s_j(x) + [-e, e], \quad x = (z - a) b \f]
/// for all p of the family and all z in its range. m and s_j are polynomials, \f$ \theta_j \f$ is a
/// sum of values of g at nodes. `curve_family` finds and proves them.
struct curve_shapes {
    double centre = 0, scale = 1;            ///< a, b
    std::vector<double> mean;                ///< coefficients of powers of x
    std::vector<std::vector<double>> shapes; ///< likewise
    double error = 0;                        ///< e
    box coefficients;                        ///< contains all \f$ \theta(p) \f$
    /// \f$ \theta_j = \sum_i weight_{ji} (g(node_i, p) - middle_i) \f$.
    std::vector<double> nodes, middles;
    std::vector<std::vector<double>> weights;

    [[nodiscard]] std::size_t count() const { return shapes.size(); }
    /// m(x) + sum of theta_j s_j(x) in a graph.
    [[nodiscard]] node_id in(graph& g, node_id z, std::vector<node_id> const& theta) const {
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
};

} // namespace sivid

#endif
