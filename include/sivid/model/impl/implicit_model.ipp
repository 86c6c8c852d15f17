// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_IMPL_IMPLICIT_MODEL_IPP
#define SIVID_MODEL_IMPL_IMPLICIT_MODEL_IPP

#include <sivid/model/graph/detail/linear_solution.hpp>
#include <sivid/model/implicit_model.hpp>

#include <stdexcept>
#include <string>
#include <utility>

namespace sivid {

SIVID_DECL std::vector<expression> model_detail::solved_rates(recorded_model& model,
                                                              std::vector<expression> const& mass,
                                                              std::vector<expression> const& force,
                                                              std::span<quantity const> algebraic) {
    auto& g = model.g;
    linear_equations equations;
    auto const n = force.size();
    for (std::size_t i = 0; i < n; ++i) {
        auto& row = equations.matrix.emplace_back();
        for (std::size_t j = 0; j < n; ++j) row.push_back(mass[i * n + j].in(g));
        equations.right.push_back(force[i].in(g));
    }
    for (auto const& s : model.about.states) equations.unknowns.push_back(s.name + "'");
    for (auto const& z : algebraic) equations.unknowns.emplace_back(z.name);
    std::vector<literal> nominal;
    for (auto const& c : model.about.constants) nominal.push_back(c.nominal);
    std::vector<expression> result;
    try {
        model.stated = stated_equations{equations.matrix, equations.right};
        for (auto const y : solve_linear(g, std::move(equations), nominal))
            result.emplace_back(g, y);
    } catch (std::invalid_argument const& error) {
        throw std::invalid_argument("model '" + model.about.name + "': " + error.what());
    }
    return result;
}

} // namespace sivid

#endif
