// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_PRODUCTS_DEPENDENCE_HPP
#define SIVID_PAVING_PRODUCTS_DEPENDENCE_HPP

#include <sivid/model/problem.hpp>
#include <sivid/model/structure/find_combinations.hpp>

#include <vector>

namespace sivid {

/// How the equations of all experiments depend on the unknown parameters.
[[nodiscard]] inline dependence_structure dependence_of(identification_problem const& problem) {
    std::vector<bound_model> bound;
    for (auto const& e : problem.experiments) {
        bound.push_back(bind(problem.model, problem.choice, e.inputs));
    }
    std::vector<bound_model const*> models;
    for (auto const& m : bound) models.push_back(&m);
    return find_combinations(models);
}

} // namespace sivid

#endif
