// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_CHANGE_DETAIL_WITH_EQUATIONS_HPP
#define SIVID_MODEL_CHANGE_DETAIL_WITH_EQUATIONS_HPP

#include <sivid/model/graph/rewrite.hpp>
#include <sivid/model/model.hpp>

#include <utility>
#include <vector>

namespace sivid {

/// A model with these rates and outputs.
/// @param g  their nodes
[[nodiscard]] inline recorded_model with_equations(recorded_model model, graph g,
                                                   std::vector<node_id> const& rates,
                                                   std::vector<node_id> const& outputs) {
    for (auto& a : model.added_states)
        a.at_begin = copy_into(g, model.g, {a.at_begin}, same_leaf{}).front();
    for (auto& d : model.derived) d.value = copy_into(g, model.g, {d.value}, same_leaf{}).front();
    model.rate = rates;
    model.observe = outputs;
    model.g = std::move(g);
    model.stated.reset();
    return model;
}

} // namespace sivid

#endif
