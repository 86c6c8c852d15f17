// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_IMPLICIT_MODEL_HPP
#define SIVID_MODEL_IMPLICIT_MODEL_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/expression.hpp>
#include <sivid/model/model.hpp>

#include <algorithm>
#include <span>
#include <vector>

namespace sivid {

namespace model_detail {
/// Solves the equations of an implicit model.
/// @returns  the rates, then the algebraic unknowns
/// @throws std::invalid_argument  naming the model, where the matrix is singular by its structure
[[nodiscard]] SIVID_DECL std::vector<expression> solved_rates(recorded_model& model,
                                                              std::vector<expression> const& mass,
                                                              std::vector<expression> const& force,
                                                              std::span<quantity const> algebraic);
} // namespace model_detail

/// Runs the functors of an implicit model once on the recording scalar, and solves its equations.
/// @throws std::invalid_argument  as `described`; naming the model, where its matrix is singular by
///         its structure
/// @guarantee evaluating the graph with a sound interval type encloses the functor's real value.
template <dynamic_model M>
    requires implicit_model<M>
[[nodiscard]] recorded_model record_model(M const& model = {}) {
    auto result = model_detail::unrecorded<M>();
    model_detail::leaves_of_model<M> const at(result.g);
    std::vector<expression> mass, force;
    for (auto const& row : model.mass(at.t, at.x, at.c, at.u))
        mass.insert(mass.end(), row.begin(), row.end());
    for (auto const& e : model.force(at.t, at.x, at.c, at.u)) force.push_back(e);
    std::span<quantity const> further;
    if constexpr (requires { M::algebraic; }) further = M::algebraic;
    auto const solved = model_detail::solved_rates(result, mass, force, further);
    auto const rates = solved.begin() + state_count<M>;
    for (auto e = solved.begin(); e != rates; ++e) result.rate.push_back(e->in(result.g));
    algebraic_of<M, expression> z;
    std::copy(rates, solved.end(), z.begin());
    model_detail::record_outputs(model, at, z, result);
    return result;
}

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/model/impl/implicit_model.ipp>
#endif

#endif
