// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_RESULT_STORED_PREDICTION_HPP
#define SIVID_IO_RESULT_STORED_PREDICTION_HPP

#include <sivid/decision/prediction_problem.hpp>
#include <sivid/decision/verification.hpp>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace sivid {

/// What is to be predicted from a stored identification.
struct prediction_request {
    std::vector<signal> inputs;
    box initial;    ///< of the states, at time 0
    double end = 0; ///< [time]
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

} // namespace sivid

#endif
