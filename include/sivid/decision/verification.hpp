// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_VERIFICATION_HPP
#define SIVID_DECISION_VERIFICATION_HPP

#include <sivid/compiled.hpp>
#include <sivid/decision/motion/detail/verification_types.hpp>
#include <sivid/decision/prediction_problem.hpp>
#include <sivid/decision/requirement.hpp>
#include <sivid/decision/requirement/robustness.hpp>
#include <sivid/space/box.hpp>

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace sivid {

enum class requirement_answer {
    proved,  ///< the requirement holds for every parameter and start
    refuted, ///< a parameter that is proved feasible violates it
    open     ///< neither: the open boxes say where
};
[[nodiscard]] constexpr std::string_view to_string(requirement_answer a) {
    return a == requirement_answer::proved    ? "proved"
           : a == requirement_answer::refuted ? "refuted"
                                              : "open";
}

/// Why a box is open.
enum class open_reason {
    undecided,    ///< its bounds hold both; more time, smaller boxes
    not_enclosed, ///< its motions were not enclosed up to the end
    infeasible,   ///< all of it violates, but none of its parameters was proved feasible
    /// What the requirement is provided for is not shown to hold, and so nothing is known.
    not_kept
};
[[nodiscard]] constexpr std::string_view to_string(open_reason r) {
    return r == open_reason::undecided      ? "not decided within the budget"
           : r == open_reason::not_enclosed ? "not enclosed up to the end"
           : r == open_reason::not_kept
               ? "unknown, since what it is provided for is not kept, such as the slew limit"
               : "violated, and no parameter in it is proved feasible";
}

/// A box of parameters and starts that is neither proved nor refuted.
struct open_box {
    box parameters, initial;
    truth found;
    open_reason why = open_reason::undecided;
    double reached = 0; ///< its motions are enclosed up to this time
};

/// A requirement over a set of parameters and starts.
struct verification {
    requirement_answer answer = requirement_answer::open;
    /// The robustness of every motion is at least `low` and at most `high`.
    truth found;
    std::optional<violating_motion> witness; ///< when refuted
    std::vector<open_box> open;              ///< largest first; empty when proved
    double reached = 0;                      ///< all motions are enclosed up to this time
    std::vector<double> times;               ///< the last grid
    std::size_t parts = 0, integrations = 0;
    double seconds = 0;
};

/// Decides a requirement for all parameters in the sets of a problem and all its starts.
///   The parts of least proved robustness come first: they are halved, integrated anew where
/// remainders weigh, and the grid in time is refined where a verdict hangs on what lies between two
/// instants. For a refutation single motions are enclosed, at points that the bounds suggest, and
/// their parameters are proved feasible.
/// @param what  read for `problem.model` (and for `direct->model`, which is the same)
/// @throws std::invalid_argument  for a problem without sets, or a requirement of another model
/// @cost  one integration over all sets, and one for every two parts that are halved
/// @guarantee  `proved`: at every instant, for every parameter in the sets. `refuted`: the witness
///             violates it and is feasible, both proved. Else the answer is open.
[[nodiscard]] SIVID_DECL verification verify(prediction_problem const& problem,
                                             requirement const& what,
                                             feasible_points const& feasible,
                                             prediction_options const& options = {});

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/decision/impl/verification.ipp>
#endif

#endif
