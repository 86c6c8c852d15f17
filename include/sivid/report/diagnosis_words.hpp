// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DIAGNOSIS_WORDS_HPP
#define SIVID_REPORT_DIAGNOSIS_WORDS_HPP

#include <sivid/compiled.hpp>
#include <sivid/report/diagnosis_view.hpp>
#include <sivid/report/draw/candidate_chart.hpp>
#include <sivid/report/number_text.hpp>
#include <sivid/report/words/detail/place_words.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// The sentences of a diagnosis's page. What is proved is called so; all else is called an
/// estimate.
namespace sivid::report {

/// An effect's name, with where it acts if not everywhere and always: "payload in S1, S2" of
/// "payload@S1+S2", "payload from a time on" of "payload@S1>=0.69563+S2".
[[nodiscard]] SIVID_DECL std::string name_of(std::string effect);

/// "rudder_lag + wind"; without effects "the model as it is".
[[nodiscard]] SIVID_DECL std::string names_of(std::vector<std::string> const& effects);

/// In words where there are any: "a first-order lag of the rudder and a steady wind".
[[nodiscard]] SIVID_DECL std::string words_of(diagnosis_view const& v,
                                              std::vector<std::string> const& effects);

/// "98 to 100 %"; an upper end above 100 is impossible, a missing lower one is said.
[[nodiscard]] SIVID_DECL std::string shrink_text(range const& share);

/// Proved bounds of a number, outward, but not beyond what was allowed: "0.16 to 0.18"; "not
/// narrowed" where they are the prior; empty where nothing is known.
[[nodiscard]] SIVID_DECL std::string hull_text(named_estimate const& e);

/// "8 of 36 candidates tried, no pair"; empty when none was planned.
[[nodiscard]] SIVID_DECL std::string tried_text(tried_candidates const& t);

/// "k sits at the upper end of its prior [1, 2] (with wind): widen it"
[[nodiscard]] SIVID_DECL std::string end_words(constant_at_end const& e);

/// "tau = 0.169 s (0.16 to 0.18, proved)"
/// @param verified  the value is that of a witness that explains the data
[[nodiscard]] SIVID_DECL std::string estimate_words(named_estimate const& e, bool verified);

/// What is drawn beside the model as it is: "with rudder_lag".
[[nodiscard]] SIVID_DECL std::string after_words(diagnosis_view const& v);

/// The inflation of the best fit of the model as it is; 0 when there is none.
[[nodiscard]] SIVID_DECL double base_fitted(diagnosis_view const& v);

/// The factor in the words of a sentence: "3.1 to 3.2 times the measurement bounds (proved)".
[[nodiscard]] SIVID_DECL std::string gap_clause(diagnosis_view const& v);

/// "a first-order lag of the rudder, tau = 0.169 s (0.16 to 0.18, proved), explains all data"
[[nodiscard]] SIVID_DECL std::string answer_clause(diagnosis_view const& v);

/// What else it may be, and what would tell; empty when nothing is.
[[nodiscard]] SIVID_DECL std::string alternatives_clause(diagnosis_view const& v);

/// False for a range that says nothing: no lower bound, and an upper one of all of the gap.
[[nodiscard]] SIVID_DECL bool says_shrink(range const& share);

[[nodiscard]] SIVID_DECL std::string shrink_clause(range const& share, std::string_view data);
/// Whether what is removed on held-out data is bounded for every parameter that explains the
/// others.
[[nodiscard]] SIVID_DECL bool says_shrink_over_fits(diagnosis_view const& v);
/// The same of held-out data: for every parameter that explains the others where that is known,
/// else at the witness.
[[nodiscard]] SIVID_DECL std::string holdout_clause(diagnosis_view const& v);

/// "with overflow an unexplained remainder of 3.1 to 3.2 times the measurement bounds is left
/// (proved)"; empty when nothing is said of one.
[[nodiscard]] SIVID_DECL std::string remainder_clause(diagnosis_view const& v);

/// What was tried in vain, and what comes closest by now; of an answer that is open.
[[nodiscard]] SIVID_DECL std::string open_clause(diagnosis_view const& v);

[[nodiscard]] SIVID_DECL std::string headline(diagnosis_view const& v);

/// The sign of the banner: proved and the only answer, or something is open, or nothing explains.
[[nodiscard]] SIVID_DECL outcome banner_outcome(diagnosis_view const& v);

/// The whole answer in one sentence.
[[nodiscard]] SIVID_DECL std::string banner_sentence(diagnosis_view const& v);

/// What to measure next, in one sentence; empty when nothing is proposed.
[[nodiscard]] SIVID_DECL std::string next_words(diagnosis_view const& v);

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/impl/diagnosis_words.ipp>
#endif

#endif
