// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_PRODUCTS_DEPENDENCE_HPP
#define SIVID_PAVING_PRODUCTS_DEPENDENCE_HPP

#include <sivid/model/problem.hpp>
#include <sivid/model/structure/find_combinations.hpp>
#include <sivid/paving/products/reduction.hpp>

#include <optional>
#include <vector>

namespace sivid {

namespace paving_detail {

/// The problem's model, bound to the inputs of each experiment.
template <class Find>
[[nodiscard]] auto about_models(identification_problem const& problem, Find const& find) {
    std::vector<bound_model> bound;
    for (auto const& e : problem.experiments) {
        bound.push_back(bind(problem.model, problem.choice, e.inputs));
    }
    std::vector<bound_model const*> models;
    for (auto const& m : bound) models.push_back(&m);
    return find(models);
}

} // namespace paving_detail

/// How the equations of all experiments depend on the unknown parameters.
[[nodiscard]] inline dependence_structure dependence_of(identification_problem const& problem) {
    return paving_detail::about_models(problem, find_combinations);
}
/// Sums through which alone the equations of all experiments see their terms.
[[nodiscard]] inline std::vector<combination> sums_in(identification_problem const& problem) {
    return paving_detail::about_models(problem, find_sums);
}
/// The coordinates in which a problem is searched: products and sums of parameters, where equations
/// see parameters through them alone; nothing where they are the parameters.
[[nodiscard]] inline std::optional<reduction>
coordinates_of(identification_problem const& problem) {
    return reduction::find(problem, dependence_of(problem), sums_in(problem));
}

} // namespace sivid

#endif
