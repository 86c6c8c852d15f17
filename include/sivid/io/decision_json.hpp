// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_DECISION_JSON_HPP
#define SIVID_IO_DECISION_JSON_HPP

#include <sivid/compiled.hpp>
#include <sivid/decision/experiment_design.hpp>
#include <sivid/decision/gain_search.hpp>
#include <sivid/decision/measurement_ranking.hpp>
#include <sivid/decision/prediction.hpp>
#include <sivid/decision/rank.hpp>
#include <sivid/decision/verification.hpp>
#include <sivid/io/result/stored_prediction.hpp>

#include <map>
#include <string>

namespace sivid {

/// What files of predictions and verifications say besides.
struct decision_json_options {
    std::string dataset{};        ///< id
    std::string source_folder{};  ///< of the identification, seen from the file's folder
    std::string source_digest{};  ///< SHA-256 of its result.json
    std::string against_digest{}; ///< of a second result, of another model
    std::string scenario{};
    std::map<std::string, interval> set{};   ///< constants of the scenario, gains of the law
    std::string law{};                       ///< "" for none
    std::map<std::string, double> sensors{}; ///< error bounds of what the law reads
    double sampled = 0, delay = 0;           ///< of the law [time]; 0: it acts at every instant
};

/// `prediction.json` in the format sivid-prediction-1: tubes, outward.
[[nodiscard]] SIVID_DECL std::string prediction_json(stored_prediction const& about,
                                                     prediction const& found,
                                                     decision_json_options const& options);

/// `tubes.csv`: from, to and the bounds of each channel and state; instants have from = to.
[[nodiscard]] SIVID_DECL std::string tubes_csv(prediction const& found);

/// `verification.json` in the format sivid-verification-1: answer, robustness, witness or open
/// boxes.
[[nodiscard]] SIVID_DECL std::string verification_json(stored_prediction const& about,
                                                       requirement const& asked,
                                                       verification const& found,
                                                       decision_json_options const& options);

/// `design.json` in the format sivid-design-1: the manoeuvre, what its data promise, what else was
/// tried. The manoeuvre is in `scenario.json`, too.
[[nodiscard]] SIVID_DECL std::string design_json(stored_prediction const& about,
                                                 design_answer const& found,
                                                 decision_json_options const& options);

/// `control.json` in the format sivid-control-1: how much of the ranges of the gains is proved and
/// excluded, what excludes them, and the suggested gains. The boxes are in `gains.csv`.
/// @param about  of all gains
/// @param proof  of the suggested gains; null for none
[[nodiscard]] SIVID_DECL std::string control_json(stored_prediction const& about,
                                                  requirement const& asked, gain_set const& found,
                                                  verification const* proof,
                                                  decision_json_options const& options);

/// `gains.csv`: one row for each box of gains that is not excluded, as in `boxes.csv`.
[[nodiscard]] SIVID_DECL std::string gains_csv(gain_set const& found);

/// `ranking.json` in the format sivid-ranking-1: effects in error bounds, outward; of each measured
/// channel the strongest first.
/// @param measurements  what groups of them are worth; null: not asked
[[nodiscard]] SIVID_DECL std::string
ranking_json(identification_problem const& about, ranking const& found,
             decision_json_options const& options,
             measurement_ranking const* measurements = nullptr);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/io/impl/decision_json.ipp>
#endif

#endif
