// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_DESIGN_DESIGN_GOAL_HPP
#define SIVID_DECISION_DESIGN_DESIGN_GOAL_HPP

#include <sivid/compiled.hpp>
#include <sivid/decision/prediction_problem.hpp>
#include <sivid/model/bound_model.hpp>
#include <sivid/model/graph/graph.hpp>
#include <sivid/model/model.hpp>
#include <sivid/model/parameter_choice.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sivid {

/// A quantity that an experiment is to narrow down.
struct design_goal {
    std::string text;
    node_id value = 0; ///< in the model's graph
};

/// Reads an expression of the model's constants, such as "Sv", "L * Sg" or "m + dm", and enters it
/// into the graph.
/// @throws requirement_error  also for what depends on states, inputs or time
[[nodiscard]] SIVID_DECL design_goal parse_goal(std::string_view text, recorded_model& model);

/// What no experiment can tell of a goal, by the model's equations.
///   Parameters that enter only in products can be scaled with all products fixed, and no output
/// changes. A goal that is a product of parameters changes along, unless it is made of these.
/// @param choice  the parameters, and the values of the other constants: one that is 0 takes terms
///                with it
/// @returns the products that can be told instead; nothing when the equations do not forbid it, or
///          the goal is no product of powers
/// @throws std::invalid_argument  where all constants of the goal are known
/// @guarantee  proved from the structure of the equations, for any experiment and start. What is
///             known of the others bounds the goal all the same: `untold_share`
[[nodiscard]] SIVID_DECL std::optional<std::vector<std::string>>
hidden_behind(recorded_model const& model, parameter_choice const& choice, design_goal const& goal);

/// How much of its width a hidden goal keeps, whatever is measured.
///   A parameter is scaled along with others so that no product in the equations changes: as far as
/// the prior allows, all of these explain whatever data it explains.
/// @param left    what the data leave: its boxes bound the width that the goal has now
/// @param direct  the prior of the parameters themselves; its constants have the values of the data
/// @param point   of the prior, that explains the data
/// @returns a share, rounded down; 0 where nothing is known to be kept
[[nodiscard]] SIVID_DECL double untold_share(prediction_problem const& left,
                                             prediction_problem const& direct,
                                             std::vector<double> const& point,
                                             design_goal const& goal);

/// All that experiments can tell of the parameters: each that the equations do not hide, and of the
/// others the products that can be told instead. As goals they are the sides of a box.
/// @throws std::invalid_argument
[[nodiscard]] SIVID_DECL std::vector<design_goal> all_goals(recorded_model& model,
                                                            parameter_choice const& choice);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/decision/design/impl/design_goal.ipp>
#endif

#endif
