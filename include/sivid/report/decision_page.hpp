// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DECISION_PAGE_HPP
#define SIVID_REPORT_DECISION_PAGE_HPP

#include <sivid/compiled.hpp>
#include <sivid/decision/experiment_design.hpp>
#include <sivid/decision/gain_search.hpp>
#include <sivid/decision/measurement_ranking.hpp>
#include <sivid/decision/prediction.hpp>
#include <sivid/decision/rank.hpp>
#include <sivid/decision/verification.hpp>
#include <sivid/io/result/stored_prediction.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/report/page.hpp>

#include <optional>
#include <string>
#include <vector>

namespace sivid::report {

/// One simulated motion, not validated: what it is, and its values over time.
struct simulated_line {
    std::vector<double> times{};
    std::vector<std::vector<double>> states{};   ///< [time][state]
    std::vector<std::vector<double>> channels{}; ///< [time][channel]
    std::vector<std::vector<double>> further{};  ///< [time][expression]
};

/// What pages of decisions say besides.
struct decision_page_options {
    std::string dataset{}, scenario{}, about{};
    std::string law{};              ///< "" for none
    std::vector<std::string> set{}; ///< "Ff in [0.286, 0.777] N"
    simulated_line least_squares{}, single{};
    std::string single_is = "witness, not validated";
    std::vector<std::string> footer{};
};

/// The answer in a sentence.
[[nodiscard]] SIVID_DECL std::string answer_sentence(stored_prediction const& about,
                                                     verification const& found);
/// What an answer rests on, in sentences.
[[nodiscard]] SIVID_DECL std::vector<std::string> decision_assumptions(stored_prediction const& s);

/// A page with the tubes of all channels.
[[nodiscard]] SIVID_DECL stored_page prediction_page(stored_prediction const& about,
                                                     prediction const& found,
                                                     decision_page_options const& options);

/// A page with the answer, the margins of all comparisons against zero, and the tubes.
/// @param tubes  of the same prediction, followed with `asked.margins`
[[nodiscard]] SIVID_DECL stored_page verification_page(stored_prediction const& about,
                                                       requirement const& asked,
                                                       verification const& found,
                                                       prediction const& tubes,
                                                       decision_page_options const& options);

/// What is known of the gains, in a sentence.
[[nodiscard]] SIVID_DECL std::string gain_sentence(gain_set const& found);

/// A page with the set of gains, and what the suggested ones do.
/// @param about  `with_gains`, if some are suggested
/// @param proof  of the suggested gains, and the tubes with them, followed with `asked.margins`;
///               may be empty
[[nodiscard]] SIVID_DECL stored_page control_page(stored_prediction const& about,
                                                  requirement const& asked, gain_set const& found,
                                                  std::optional<verification> const& proof,
                                                  std::optional<prediction> const& tubes,
                                                  decision_page_options const& options);

/// The answer in a few words, and in a sentence.
[[nodiscard]] SIVID_DECL std::string design_headline(design_answer const& a);
[[nodiscard]] SIVID_DECL std::string design_sentence(design_answer const& a);

/// A page with the manoeuvre, its promise, the motion it brings about, and what else was tried.
/// @param tubes  of the manoeuvre; may be empty
[[nodiscard]] SIVID_DECL stored_page design_page(stored_prediction const& about,
                                                 design_answer const& a,
                                                 std::optional<prediction> const& tubes,
                                                 decision_page_options const& options);

/// An effect in error bounds, rounded outward.
[[nodiscard]] SIVID_DECL std::string effect_text(parameter_effect const& e);

/// What a ranking proves, in sentences: what cannot matter, what alone moves little, what does not
/// count, and what acts in products only.
[[nodiscard]] SIVID_DECL std::vector<std::string>
ranking_sentences(identification_problem const& about, ranking const& found);

/// A group of measurements in words: "psi", "run 2", "psi of run 2, 1 to 2 s".
[[nodiscard]] SIVID_DECL std::string group_text(identification_problem const& about,
                                                measurement_group const& group);

/// A growth in words: "nothing changes", "2.05 to 2.26 times", "at least 1.2 times".
[[nodiscard]] SIVID_DECL std::string growth_text(interval const& growth);

/// A page with a bar for the effect of each parameter on each channel, full up to what is reached
/// and hatched up to what is not excluded; and such bars for groups of measurements.
/// @param measurements  what they are worth; empty: not asked
[[nodiscard]] SIVID_DECL stored_page ranking_page(
    identification_problem const& about, ranking const& found, decision_page_options const& options,
    std::optional<measurement_ranking> const& measurements = {});

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/impl/decision_page.ipp>
#endif

#endif
