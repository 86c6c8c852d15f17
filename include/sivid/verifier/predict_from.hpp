// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_PREDICT_FROM_HPP
#define SIVID_VERIFIER_PREDICT_FROM_HPP

#include <sivid/compiled.hpp>
#include <sivid/io/result/stored_identification.hpp>
#include <sivid/io/result/stored_prediction.hpp>
#include <sivid/model/problem.hpp>

#include <filesystem>
#include <memory>
#include <vector>

namespace sivid {

/// @param data    the problem that was identified, with its outlier budgets
/// @param stored  its result
/// @param model   the model of `data`; its graph may hold further nodes, of requirements
/// @param margins those nodes: products are used only where they tell them, too
/// @param file    of the result, for messages
/// @throws input_error when the result contradicts itself, speaks of another problem (another
///         model, other data, effects, budgets of outliers), has no digests, or leaves no
///         parameter; std::invalid_argument for constants that cannot be set
/// @guarantee  the sets of the prediction hold every parameter that the result does not exclude;
///             that what it excludes is excluded is for `identification_check` to prove
/// @cost  reads and orders the boxes; proofs of feasible points are made when asked for
[[nodiscard]] SIVID_DECL std::unique_ptr<stored_prediction>
predict_from(identification_problem const& data, stored_identification const& stored,
             recorded_model const& model, std::vector<node_id> const& margins,
             prediction_request const& request, std::filesystem::path const& file);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/verifier/impl/predict_from.ipp>
#endif

#endif
