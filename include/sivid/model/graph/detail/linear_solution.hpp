// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_GRAPH_DETAIL_LINEAR_SOLUTION_HPP
#define SIVID_MODEL_GRAPH_DETAIL_LINEAR_SOLUTION_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/graph/graph.hpp>

#include <string>
#include <vector>

namespace sivid {

/// Linear equations \f$ A y = b \f$ between nodes of a graph; literal zeros are structure.
struct linear_equations {
    std::vector<std::vector<node_id>> matrix; ///< rows of A
    std::vector<node_id> right;               ///< b
    std::vector<std::string> unknowns{};      ///< what y is called, for errors; or empty
};

/// The solution y as nodes of the graph.
///   Equations that can be solved one after the other are. A block of at most four that belong
///   together is solved by Cramer's rule, so that it divides by its determinant alone: y is defined
///   wherever A is regular. The determinant is multiplied out where that makes it narrower over a
///   fifth about the nominal values, since the products that cancel are what makes it wide.
///   Larger blocks are reduced by pivots first, which must not vanish either; those of a positive
///   definite matrix do not.
/// @param nominal  of the constants, where forms of a determinant are compared
/// @guarantee  wherever the nodes are defined, they are the solution
/// @throws std::invalid_argument  if A is not square, or singular whatever its entries are
[[nodiscard]] SIVID_DECL std::vector<node_id> solve_linear(graph& g, linear_equations equations,
                                                           std::vector<literal> const& nominal);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/model/graph/impl/linear_solution.ipp>
#endif

#endif
