// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_STORED_PREDICTION_HPP
#define SIVID_IO_STORED_PREDICTION_HPP

#include <sivid/compiled.hpp>
#include <sivid/decision/prediction_problem.hpp>
#include <sivid/decision/verification.hpp>
#include <sivid/io/detail/stored_identification.hpp>
#include <sivid/io/product_formula.hpp>
#include <sivid/model/problem.hpp>

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace sivid {

/// What is to be predicted from a stored identification.
struct prediction_request {
    std::vector<signal> inputs;
    box initial;    ///< of the states, at time 0
    double end = 0; ///< [s]
    /// Constants that have other values in the scenario than in the data, or are known less well.
    std::map<std::string, interval> set;
    double proof_seconds = 5; ///< to prove one parameter feasible
    /// What the data set itself says of outliers, by scenario: named where the result's differ.
    std::map<std::string, std::size_t> stated_outliers{};
};

/// The parameters that a stored identification leaves, for a scenario: in the products that the
/// data fix where those tell the motions, else in the parameters themselves.
struct stored_prediction {
    prediction_problem problem;     ///< over all that the result does not exclude
    prediction_problem direct;      ///< the same, the parameters and `set` themselves as sides
    std::vector<std::string> sides; ///< of `problem`: formulas
    bool in_products = false;
    std::string not_in_products; ///< why not, where the result has products
    /// What answers rest on: those of the identification, and what was set.
    std::vector<std::string> assumptions;
    /// Points of `direct` that may be feasible, and proofs that they are: from the data alone, by
    /// validated runs, whatever the result says of them.
    feasible_points feasible;
    std::string feasible_with; ///< the outliers that such a proof allows, in words; "" for none
    /// States that effects add start at values that the parameters decide; here they start anywhere
    /// in the hull of these. What is proved is proved; what is reached is not known to be, and no
    /// point is feasible.
    bool starts_follow = false;

    stored_prediction() = default;
    stored_prediction(stored_prediction const&) = delete;
    stored_prediction& operator=(stored_prediction const&) = delete;
};

/// @param data    the problem that was identified, with its outlier budgets
/// @param stored  its result
/// @param model   the model of `data`; its graph may hold further nodes, of requirements
/// @param margins those nodes: products are used only where they tell them, too
/// @param file    of the result, for messages
/// @throws input_error when the result contradicts itself, speaks of another problem (another
/// model,
///         other data, effects, budgets of outliers), has no digests, or leaves no parameter;
///         std::invalid_argument for constants that cannot be set
[[nodiscard]] SIVID_DECL std::unique_ptr<stored_prediction>
predict_from(identification_problem const& data, stored_identification const& stored,
             recorded_model const& model, std::vector<node_id> const& margins,
             prediction_request const& request, std::filesystem::path const& file);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/io/impl/stored_prediction.ipp>
#endif

#endif
