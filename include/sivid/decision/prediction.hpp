// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_PREDICTION_HPP
#define SIVID_DECISION_PREDICTION_HPP

#include <sivid/compiled.hpp>
#include <sivid/decision/prediction_problem.hpp>

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace sivid {

/// Bounds of one quantity over time, in segments: the instants of a grid, 2 k, and what lies
/// between them, 2 k + 1. Infinite where nothing is known.
struct predicted_tube {
    std::string name, unit;
    std::vector<double> low, high;
    std::string time_unit = "s"; ///< the model's
};

/// Every motion of a scenario for all parameters and starts of a prediction problem.
struct prediction {
    std::vector<double> times; ///< the grid
    std::vector<predicted_tube> states, channels;
    std::vector<predicted_tube> further; ///< of the expressions that were asked for
    double reached = 0;                  ///< instants up to here are bounded; time
    bool complete = false;               ///< every instant of the scenario is bounded
    /// The tubes at the instants are at most this much wider, as a share, than what the parameters
    /// and starts of the problem reach themselves; widths below a millionth of the largest value of
    /// a tube do not count. Infinite where it is not known what they reach
    /// (`prediction_problem::reached`).
    double excess = std::numeric_limits<double>::infinity();
    std::size_t parts = 0, integrations = 0;
    double seconds = 0;
};

/// Encloses all motions: tubes of states and channels, tight at the instants of a grid and valid
/// between them.
///   Parts of the sets are integrated side by side as polynomials in the unknowns, and split where
///   a
/// tube is wider than what is reached, those first that hold its bounds.
/// @param further  expressions to follow besides: nodes of the model's graph
/// @throws std::invalid_argument  what does not fit (`prediction_problem::require_valid`)
/// @guarantee  each motion runs within its tube at every instant; where `complete` is false, up to
///             where the bounds are finite
/// @cost  as of the experiments of an identification, for a grid of `cells` instants
[[nodiscard]] SIVID_DECL prediction predict(prediction_problem const& problem,
                                            prediction_options const& options = {},
                                            std::vector<node_id> const& further = {});

/// Withdraws all that is said from the first segment on in which a channel may reach +-limit: for
/// predictions that hold as long as it does not.
/// @throws std::invalid_argument for a name that is no channel
SIVID_DECL void end_where_reached(prediction& found, std::string const& channel, double limit);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/decision/impl/prediction.ipp>
#endif

#endif
