// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_STRUCTURE_IMPL_SYMMETRY_IPP
#define SIVID_MODEL_STRUCTURE_IMPL_SYMMETRY_IPP

#include <sivid/model/structure/symmetry.hpp>

#include <sivid/model/graph/detail/fraction_coefficients.hpp>
#include <sivid/model/graph/normal_form.hpp>
#include <sivid/model/graph/rewrite.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace sivid {

namespace model_detail {

/// Whether a function that jumps depends on something that moves.
SIVID_DECL bool jumps_along(bound_model const& model, model_motion const& motion) {
    auto const& g = model.g;
    auto outputs = model.rate;
    outputs.insert(outputs.end(), model.observe.begin(), model.observe.end());
    auto const needed = operands_of(g, outputs);
    std::vector<bool> moves(g.size(), false);
    for (std::size_t k = 0; k < g.size(); ++k) {
        if (!needed[k]) continue;
        auto const& n = g.nodes()[k];
        auto const index = static_cast<std::size_t>(n.index);
        if (n.op == operation::constant) moves[k] = motion.parameters[index] != 0;
        if (n.op == operation::state) moves[k] = motion.states[index] != 0;
        if (is_leaf(n.op)) continue;
        moves[k] = moves[n.a] || (is_binary(n.op) && moves[n.b]);
        if (n.op == operation::sign && moves[k]) return true;
    }
    return false;
}

} // namespace model_detail

SIVID_DECL bool is_symmetry(bound_model const& model, model_motion const& motion) {
    using namespace model_detail;
    if (jumps_along(model, motion)) return false;
    auto g = model.g;
    bool const scales = motion.kind == motion_kind::scaling;
    std::vector<node_id> x, p;
    for (std::size_t i = 0; i < model.state_count(); ++i) x.push_back(g.leaf(operation::state, i));
    for (std::size_t j = 0; j < model.parameter_count(); ++j) {
        p.push_back(g.leaf(operation::constant, j));
    }
    multiplied_out<fraction_coefficients> multiplied(fraction_coefficients(g), {200, 4000});
    using terms = multiplied_out<fraction_coefficients>::terms;
    // Adds w v(leaf) times the derivative.
    auto const along = [&](terms& sum, int w, node_id leaf, node_id derivative) {
        if (w == 0) return true;
        auto term = std::optional(multiplied(derivative));
        if (scales) term = multiplied.product(*term, multiplied(leaf));
        return term && multiplied.add(sum, *term, {w, 1});
    };
    auto const holds = [&](node_id f, std::vector<node_id> const& dx,
                           std::vector<node_id> const& dp, int weight) {
        terms sum;
        for (std::size_t j = 0; j < p.size(); ++j) {
            if (!along(sum, motion.parameters[j], p[j], dp[j])) return false;
        }
        for (std::size_t i = 0; i < x.size(); ++i) {
            if (!along(sum, motion.states[i], x[i], dx[i])) return false;
        }
        if (scales && weight != 0 && !multiplied.add(sum, multiplied(f), {-weight, 1})) {
            return false;
        }
        return sum.empty();
    };
    for (std::size_t i = 0; i < model.rate.size(); ++i) {
        if (!holds(model.rate[i], model.rate_dx[i], model.rate_dp[i], motion.states[i])) {
            return false;
        }
    }
    for (std::size_t y = 0; y < model.observe.size(); ++y) {
        if (!holds(model.observe[y], model.observe_dx[y], model.observe_dp[y], 0)) return false;
    }
    return true;
}

} // namespace sivid

#endif
