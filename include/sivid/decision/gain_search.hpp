// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_GAIN_SEARCH_HPP
#define SIVID_DECISION_GAIN_SEARCH_HPP

#include <sivid/compiled.hpp>
#include <sivid/decision/motion/detail/verification_types.hpp>
#include <sivid/decision/prediction_problem.hpp>
#include <sivid/decision/requirement.hpp>
#include <sivid/paving/inversion_options.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sivid {

struct gain_options {
    prediction_options motions{}; ///< `seconds`: of all
    std::size_t boxes = 20'000;   ///< of gains, at most
    /// A box of gains is left undecided when no side is wider than this share of its range.
    double accuracy = 1.0 / 256;
};

/// Which gains meet a requirement for every parameter and start.
struct gain_set {
    std::vector<std::string> names;
    /// inside: every gain in the box meets it for all parameters and starts; outside: each violates
    /// it for one of `against`.
    inversion paving;
    /// Motions that violate it, with the gain at which each was found; their parameters are proved
    /// feasible.
    std::vector<violating_motion> against{};
    /// Gains of few digits, of the best proved robustness that was met.
    std::optional<std::vector<double>> suggested{};
    truth found{};   ///< with these, for all parameters and starts
    box tolerance{}; ///< around these, all of it proved as well; empty where no box was
    /// Of some gains nothing can be known, as what the requirement is provided for does not hold.
    bool unknown = false;
    std::size_t parts = 0, integrations = 0;
    double seconds = 0;

    /// Some gains meet the requirement for every parameter and start.
    [[nodiscard]] bool some_proved() const;
    /// No gain in the ranges does.
    [[nodiscard]] bool none_exists() const;
};

/// Paves ranges of gains by what is proved of a requirement for all other unknowns of a prediction.
///   Set inversion over the gains. A box is inside once the requirement is proved for the parts of
/// (box x parameters x starts), which are halved along any of their sides; what is proved for a
/// part is not asked again for the box's halves. It is outside once one feasible parameter violates
/// it for all gains of the box: such parameters are collected on the way.
/// @param problem  with the gains among its unknowns; every set holds their whole ranges
/// @param gains    their names
/// @throws std::invalid_argument  for gains that are no unknowns, or sets that lack their ranges
/// @guarantee  as said of the boxes; what is undecided or pending is neither
/// @cost  a verification for each box of gains, which begins where that of the box around it ended
[[nodiscard]] SIVID_DECL gain_set find_gains(prediction_problem const& problem,
                                             std::vector<std::string> const& gains,
                                             requirement const& what,
                                             feasible_points const& feasible,
                                             gain_options const& options = {});

/// The same prediction with these gains.
[[nodiscard]] SIVID_DECL prediction_problem with_gains(prediction_problem problem,
                                                       std::vector<std::string> const& gains,
                                                       std::vector<double> const& values);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/decision/impl/gain_search.ipp>
#endif

#endif
