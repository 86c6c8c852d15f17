// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_STRUCTURE_FIND_COMBINATIONS_HPP
#define SIVID_MODEL_STRUCTURE_FIND_COMBINATIONS_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/bound_model.hpp>
#include <sivid/model/structure/combination.hpp>

#include <set>
#include <string>
#include <vector>

namespace sivid {

namespace model_detail {

using monomial_set = std::set<std::vector<int>>; ///< exponents, one per unknown parameter

/// Monomials of the parameters through which all rates and outputs depend on them, added to
/// `found`: those of the terms that they multiply out to, and of what is inside of nodes that do
/// not.
SIVID_DECL void collect_monomials(bound_model const& model, monomial_set& found);

/// A product of powers, for instance "L*Sg/(Iz^2*m)".
SIVID_DECL std::string product_text(std::vector<std::string> const& names,
                                    std::vector<int> const& exponents);

/// A sum, for instance "m + dm".
SIVID_DECL std::string sum_text(std::vector<std::string> const& names,
                                std::vector<int> const& signs);

} // namespace model_detail

/// Finds the products of parameters through which all rates and outputs depend on them.
///   The equations contain the parameters only in the monomials collected here; where those span
///   fewer dimensions than there are parameters (in logarithms), some parameters are entangled.
/// @param models  the same model bound to the inputs of each experiment, since an input that
/// vanishes
///                takes terms with it
/// @guarantee  `entangled` is a theorem about the equations: ranks are counted exactly
///   (`integer_span`). Parameters that are not listed may still be left open by the data, or be
///   tied by sums (`find_sums`).
[[nodiscard]] SIVID_DECL dependence_structure
find_combinations(std::vector<bound_model const*> const& models);

/// Finds sums of parameters through which alone all rates and outputs depend on their terms, for
/// instance a mass and a payload, m + dm.
/// @param models  as above; a sum has to be one in all of them
/// @guarantee  changing the terms with the sum fixed changes no trajectory and no output: each term
///   is an operand of one node, within one tree of sums and differences
/// @cost  linear in the nodes
[[nodiscard]] SIVID_DECL std::vector<combination>
find_sums(std::vector<bound_model const*> const& models);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/model/structure/impl/find_combinations.ipp>
#endif

#endif
