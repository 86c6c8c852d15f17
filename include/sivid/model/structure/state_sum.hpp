// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_STRUCTURE_STATE_SUM_HPP
#define SIVID_MODEL_STRUCTURE_STATE_SUM_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/graph/graph.hpp>
#include <sivid/model/graph/normal_form.hpp>

#include <cstddef>
#include <vector>

namespace sivid {

/// \f$ (x_i + \sum_k a_k x_k)' = r \f$: a sum of states that changes by less than its states do.
/// Its weights are functions of the constants alone, r is affine in the states. A conserved sum has
/// r = 0.
struct state_sum {
    /// \f$ factor \cdot product \f$, a term of the weight of a state.
    struct weight {
        std::size_t state = 0;
        node_product product; ///< of nodes that depend on constants alone
        node_id factor = 0;   ///< a literal
        node_id value = 0;    ///< of both

        friend bool operator==(weight const&, weight const&) = default;
    };
    std::size_t first = 0;       ///< i
    std::vector<weight> weights; ///< of the others, by states
    node_id rate = 0;            ///< r
};

/// Finds sums of states in which what is no affine function of the states cancels whatever it is:
/// rate laws and flows that several equations share.
///   Rates are multiplied out into products of constants times functions; those are the columns of
///   a matrix over the Laurent polynomials of the constants, which is brought to echelon form in
///   exact fractions, by entries that are single products. Each state comes first once, so that
///   short sums are found, and not a basis alone.
/// @param g  of the rates, to which nodes are added
/// @guarantee  each sum that is returned changes by its rate along every motion, for all values of
///   the constants for which both are defined. Not every sum need be found.
/// @cost  O(n^3) products of entries for each of n <= 24 states; more are not looked at
[[nodiscard]] SIVID_DECL std::vector<state_sum> find_state_sums(graph& g,
                                                                std::vector<node_id> const& rates);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/model/structure/impl/state_sum.ipp>
#endif

#endif
