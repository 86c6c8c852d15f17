// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_RELATION_CONTRACTION_HPP
#define SIVID_PAVING_RELATION_RELATION_CONTRACTION_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/set_test.hpp>
#include <sivid/space/box.hpp>

#include <cstddef>
#include <functional>
#include <string>

namespace sivid {

struct relation_contraction_options {
    std::function<bool()> keep_going{}; ///< false ends it with what is proved until then
    std::size_t rounds = 12;            ///< of one box, at most
    std::size_t cells_per_gap = 6;      ///< cells between two samples
    /// Ends when a round narrows no side by so much.
    double gain = 0.05;
};

/// Contracts a prior by the state equations alone: no trajectory is integrated.
///   Over a window between two samples, \f$ x_i' = \phi_0(t, x, u) + \sum_j \theta_j
///   \phi_j(t, x, u) \f$ says \f$ x_i(t_b) - x_i(t_a) = a_0 + \sum_j \theta_j a_j \f$ with \f$
///   a_j = \int \phi_j dt \f$, linear in products of the constants. Between the samples the states
///   are enclosed from both sides, and their rates vary by no more than the model itself does over
///   the prior; that encloses the integrals, over any number of windows. Linear programs over all
///   windows of one equation enclose each \f$ \theta_j \f$, the constants follow. A smaller prior
///   has narrower motions, so it goes round again.
///   Constants that do not separate (a wind inside a root, a threshold) are further unknowns by the
///   mean value theorem. Sums of states in which rate laws cancel (`find_state_sums`) are equations
///   of their own: conserved ones need nothing between the samples. Where a prior is too wide for
///   an enclosure, states are still told by sides that they keep (`kept_sides`), by such sums, and
///   by their own equations from the samples after them.
/// @guarantee  no parameter that explains the data is removed; empty: proved, there is none.
///   Experiments with outliers, models with delays, and states of which nothing is known take no
///   part (`relation_obstacle`).
/// @cost  some tens of milliseconds a round for five records of a hundred samples
[[nodiscard]] SIVID_DECL box contract_by_relations(
    identification_problem const& problem, relation_contraction_options const& options = {});

/// Why equations tell nothing of a problem as a whole; empty where they may.
[[nodiscard]] SIVID_DECL std::string relation_obstacle(identification_problem const& problem);

/// Tests boxes of parameters in the same way, for `invert`. Smear: how much of what the windows
/// leave open is due to each.
class relation_test {
public:
    /// @param problem  outlives this; a model with delays is not for it
    relation_test(identification_problem const& problem,
                  relation_contraction_options const& options)
        : problem_(&problem), options_(options) {}

    [[nodiscard]] SIVID_DECL assessment<> operator()(box const& x) const;

private:
    identification_problem const* problem_;
    relation_contraction_options options_;
};

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/paving/relation/impl/relation_contraction.ipp>
#endif

#endif
